// What has changed in a table, for any number of readers, each of which looks when it likes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace tarn {

// A half-open range of indices; empty where both are the same.
struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t last = 0;

    friend bool operator==(const IndexRange&, const IndexRange&) = default;
};

// Ranges in any order, which may touch, overlap or be empty, as ascending ones that do neither. Gaps of up to
// `gap` indices are filled, for those to whom a range of its own costs more.
std::vector<IndexRange> merge_ranges(std::vector<IndexRange> ranges, std::uint32_t gap = 0);

// What a reader has not seen yet.
struct Changes {
    bool everything = false;         // the whole table may have changed; `ranges` is empty then
    std::vector<IndexRange> ranges;  // as from merge_ranges

    bool empty() const { return !everything && ranges.empty(); }
};

// Whoever owns the table appends what each update wrote. Whoever reads it keeps a cursor and asks what has
// changed since it last looked. Memory is bounded: the oldest updates are forgotten, and a reader that has
// not seen them is told that everything changed.
class ChangeLog {
  public:
    // How far a reader has read; a new one has seen nothing. It belongs to one log, or to copies of it.
    class Cursor {
        friend class ChangeLog;
        std::uint64_t revision_ = UINT64_MAX;
    };

    ChangeLog() = default;
    // `capacity`: ranges and updates that are remembered, the latest update whatever its size.
    explicit ChangeLog(std::size_t capacity) : capacity_(capacity) {}

    // An update that wrote these ranges, in any order; empty ones do not count, but the update does.
    void append(std::vector<IndexRange> ranges);
    // An update after which nothing is what it was: the table may have another length or order.
    void append_everything();

    // Updates so far.
    std::uint64_t revision() const { return revision_; }
    bool has_news(const Cursor& reader) const { return reader.revision_ != revision_; }

    // What has changed since this reader read last; costs what the updates since then wrote.
    Changes read(Cursor& reader) const;

  private:
    // Half a megabyte.
    static constexpr std::size_t DEFAULT_CAPACITY = std::size_t(1) << 16;

    static std::size_t cost_of(const std::vector<IndexRange>& update) { return update.size() + 1; }

    std::size_t capacity_ = DEFAULT_CAPACITY;
    std::uint64_t revision_ = 0;
    std::deque<std::vector<IndexRange>> updates_;  // the latest ones, up to revision_
    std::size_t cost_ = 0;                         // of all of them
};

}  // namespace tarn
