#include "passes/gpu_lights.h"

#include <algorithm>
#include <unordered_map>

#include "shared/interface/bindings.h"
#include "shared/math/light.h"

namespace tarn {
namespace {

constexpr std::size_t ROW_BYTES = sizeof(glm::uvec4);

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
    allocate(lights);
    upload_all(lights);
    copy_rows(0, capacity_, row_count_);
    previous_identities_ = identities_;
}

// Room for the lights of two frames and their remap.
void GpuLights::allocate(const WorldLights& lights) {
    capacity_ = std::max<std::size_t>(lights.rows.size() + lights.rows.size() / 4, LIGHT_ROWS);
    const std::size_t rows = 2 * capacity_ + capacity_ / LIGHT_ROWS + 1;
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
    revision_ = lights.revision;
    structure_revision_ = lights.structure_revision;
}

void GpuLights::copy_rows(std::size_t from_row, std::size_t to_row, std::size_t count) {
    rows_->buffer().copy(from_row * ROW_BYTES, to_row * ROW_BYTES, count * ROW_BYTES);
}

void GpuLights::update(const WorldLights& lights) {
    if (lights.revision == revision_) return;
    have_changed_ = true;
    differs_ = true;
    // `first_changed` is about the latest update alone: after two of them all rows are uploaded.
    if (lights.structure_revision == structure_revision_ && lights.revision == revision_ + 1) {
        // Rows moved, no light came or went: their range alone.
        const std::size_t first = std::size_t(lights.first_changed) * LIGHT_ROWS;
        const std::size_t last = std::size_t(lights.last_changed) * LIGHT_ROWS;
        rows_->buffer().upload(first * ROW_BYTES, std::span(lights.rows).subspan(first, last - first));
        changed_first_row_ = std::min(changed_first_row_, first);
        changed_last_row_ = std::max(changed_last_row_, last);
        revision_ = lights.revision;
        return;
    }
    if (lights.rows.size() > capacity_) {
        const RowBuffer old = std::move(*rows_);
        const std::size_t old_capacity = capacity_;
        allocate(lights);
        rows_->buffer().copy(old.buffer(), old_capacity * ROW_BYTES, capacity_ * ROW_BYTES,
                             old_capacity * ROW_BYTES);
    }
    upload_all(lights);
    changed_first_row_ = 0;
    changed_last_row_ = row_count_;
    remapped_ = identities_ != previous_identities_;
    if (remapped_)
        rows_->buffer().upload(2 * capacity_ * ROW_BYTES, make_remap(previous_identities_, identities_));
}

void GpuLights::advance() {
    if (!differs_) return;
    copy_rows(changed_first_row_, capacity_ + changed_first_row_, changed_last_row_ - changed_first_row_);
    if (remapped_) previous_identities_ = identities_;
    changed_first_row_ = SIZE_MAX;
    changed_last_row_ = 0;
    differs_ = false;
    remapped_ = false;
}

std::uint32_t GpuLights::remap_first_row() const {
    return remapped_ ? std::uint32_t(2 * capacity_) : INVALID_INDEX;
}

void GpuLights::bind() const {
    rows_->texture().bind(UNIT_LIGHT_ROWS);
    alias_->texture().bind(UNIT_LIGHT_ALIAS);
}

}  // namespace tarn
