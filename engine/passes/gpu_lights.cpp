#include "passes/gpu_lights.h"

#include <algorithm>
#include <unordered_map>

#include "shared/interface/bindings.h"
#include "shared/math/light.h"

namespace tarn {
namespace {

constexpr std::size_t ROW_BYTES = sizeof(glm::uvec4);

// Lights that stand still between two that moved cost less to write again than a call of their own.
constexpr std::uint32_t GAP = 32;

// The rows of lights, in few ranges.
std::vector<IndexRange> list_rows(std::vector<IndexRange> lights) {
    std::vector<IndexRange> ranges = merge_ranges(std::move(lights), GAP);
    for (IndexRange& range : ranges) range = {range.first * LIGHT_ROWS, range.last * LIGHT_ROWS};
    return ranges;
}

std::size_t count_word_rows(const std::vector<std::uint32_t>& words) {
    return (words.size() + 3) / 4;
}

// Rows of what finds the light of a triangle.
std::size_t count_lookup_rows(const WorldLights& lights) {
    return count_word_rows(lights.instance_first) + count_word_rows(lights.light_of_primitive);
}

// Pairs of (index in the last frame, index now); see the head of gpu_lights.h.
std::vector<glm::uvec4> make_remap(const std::vector<std::uint64_t>& previous,
                                   const std::vector<std::uint64_t>& current) {
    std::vector<glm::uvec4> rows(std::max(previous.size(), current.size()),
                                 glm::uvec4(INVALID_INDEX, INVALID_INDEX, 0u, 0u));
    std::unordered_map<std::uint64_t, std::uint32_t> place;
    place.reserve(previous.size());
    for (std::uint32_t i = 0; i < previous.size(); ++i) place.emplace(previous[i], i);
    for (std::uint32_t i = 0; i < current.size(); ++i) {
        const auto found = place.find(current[i]);
        if (found == place.end()) continue;
        rows[i].x = found->second;
        rows[found->second].y = i;
    }
    return rows;
}

}  // namespace

GpuLights::GpuLights(const WorldLights& lights) {
    lights.changes.read(seen_);
    allocate(lights);
    upload_all(lights);
    copy_rows(0, capacity_, row_count_);
    previous_identities_ = identities_;
}

bool GpuLights::has_room_for(const WorldLights& lights) const {
    return lights.rows.size() <= capacity_ && count_lookup_rows(lights) <= lookup_capacity_;
}

// Room for the lights of two frames, their remap and the lookup; never less for the lights than there was,
// since the last frame's may be more than this one's.
void GpuLights::allocate(const WorldLights& lights) {
    const auto with_reserve = [](std::size_t rows) { return rows + rows / 4; };
    capacity_ = std::max({capacity_, with_reserve(lights.rows.size()), std::size_t(LIGHT_ROWS)});
    lookup_capacity_ = with_reserve(count_lookup_rows(lights));
    const std::size_t rows = first_lookup_row() + lookup_capacity_;
    rows_.emplace("scene/light_rows", rows * ROW_BYTES, BufferUse::DYNAMIC, GL_RGBA32UI);
}

void GpuLights::upload_all(const WorldLights& lights) {
    rows_->buffer().upload(0, lights.rows);
    const std::size_t alias_bytes = lights.alias_rows.size() * ROW_BYTES;
    if (!alias_ || alias_->buffer().size_bytes() < alias_bytes) {
        alias_.emplace("scene/light_alias", alias_bytes, BufferUse::DYNAMIC, GL_RGBA32UI);
    }
    alias_->buffer().upload(0, lights.alias_rows);
    row_count_ = lights.rows.size();
    identities_ = lights.identities;
    structure_revision_ = lights.structure_revision;
    if (order_revision_ != lights.order_revision) upload_lookup(lights);
    order_revision_ = lights.order_revision;
}

void GpuLights::upload_lookup(const WorldLights& lights) {
    instance_rows_ = count_word_rows(lights.instance_first);
    rows_->buffer().upload(instance_lookup_first_row() * ROW_BYTES, lights.instance_first);
    rows_->buffer().upload(slot_lookup_first_row() * ROW_BYTES, lights.light_of_primitive);
}

void GpuLights::upload_rows(const WorldLights& lights, const IndexRange& rows) {
    rows_->buffer().upload(rows.first * ROW_BYTES,
                           std::span(lights.rows).subspan(rows.first, rows.last - rows.first));
}

void GpuLights::copy_rows(std::size_t from_row, std::size_t to_row, std::size_t count) {
    rows_->buffer().copy(from_row * ROW_BYTES, to_row * ROW_BYTES, count * ROW_BYTES);
}

void GpuLights::update(const WorldLights& lights) {
    if (!lights.changes.has_news(seen_)) return;
    have_changed_ = true;
    Changes changes = lights.changes.read(seen_);
    if (!changes.everything && lights.structure_revision == structure_revision_) {
        // Rows moved, no light came or went: they alone.
        for (const IndexRange& rows : list_rows(std::move(changes.ranges))) {
            upload_rows(lights, rows);
            changed_rows_.push_back(rows);
        }
        // Many updates may pass before a frame is drawn.
        changed_rows_ = merge_ranges(std::move(changed_rows_));
        return;
    }
    if (!has_room_for(lights)) {
        const RowBuffer old = std::move(*rows_);
        const std::size_t old_capacity = capacity_;
        allocate(lights);
        rows_->buffer().copy(old.buffer(), old_capacity * ROW_BYTES, capacity_ * ROW_BYTES,
                             old_capacity * ROW_BYTES);
    }
    upload_all(lights);
    changed_rows_.assign(1, {0u, std::uint32_t(row_count_)});
    remapped_ = identities_ != previous_identities_;
    if (remapped_)
        rows_->buffer().upload(first_remap_row() * ROW_BYTES, make_remap(previous_identities_, identities_));
}

void GpuLights::advance() {
    for (const IndexRange& rows : changed_rows_)
        copy_rows(rows.first, capacity_ + rows.first, rows.last - rows.first);
    if (remapped_) previous_identities_ = identities_;
    changed_rows_.clear();
    remapped_ = false;
}

std::uint32_t GpuLights::remap_first_row() const {
    return remapped_ ? std::uint32_t(first_remap_row()) : INVALID_INDEX;
}

void GpuLights::bind(FrameRecorder& recorder) const {
    recorder.bind_table(UNIT_LIGHT_ROWS, *rows_);
    recorder.bind_table(UNIT_LIGHT_ALIAS, *alias_);
}

}  // namespace tarn
