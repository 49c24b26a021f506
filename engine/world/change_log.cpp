#include "world/change_log.h"

#include <algorithm>

namespace tarn {

std::vector<IndexRange> merge_ranges(std::vector<IndexRange> ranges, std::uint32_t gap) {
    std::erase_if(ranges, [](const IndexRange& range) { return range.first == range.last; });
    const auto comes_first = [](const IndexRange& a, const IndexRange& b) { return a.first < b.first; };
    // Most writers go through their table in order.
    if (!std::is_sorted(ranges.begin(), ranges.end(), comes_first)) {
        std::sort(ranges.begin(), ranges.end(), comes_first);
    }
    std::size_t count = 0;  // of merged ones, at the front
    for (const IndexRange& range : ranges) {
        if (count > 0 && range.first <= std::uint64_t(ranges[count - 1].last) + gap) {
            ranges[count - 1].last = std::max(ranges[count - 1].last, range.last);
        } else {
            ranges[count++] = range;
        }
    }
    ranges.resize(count);
    return ranges;
}

void ChangeLog::append(std::vector<IndexRange> ranges) {
    updates_.push_back(merge_ranges(std::move(ranges)));
    cost_ += cost_of(updates_.back());
    ++revision_;
    while (cost_ > capacity_ && updates_.size() > 1) {
        cost_ -= cost_of(updates_.front());
        updates_.pop_front();
    }
}

void ChangeLog::append_everything() {
    updates_.clear();
    cost_ = 0;
    ++revision_;
}

Changes ChangeLog::read(Cursor& reader) const {
    const std::uint64_t seen = reader.revision_;
    reader.revision_ = revision_;
    if (seen > revision_ || revision_ - seen > updates_.size()) return {true, {}};
    const auto first_unseen = updates_.end() - std::ptrdiff_t(revision_ - seen);
    std::vector<IndexRange> ranges;
    for (auto update = first_unseen; update != updates_.end(); ++update) {
        ranges.insert(ranges.end(), update->begin(), update->end());
    }
    return {false, merge_ranges(std::move(ranges))};
}

}  // namespace tarn
