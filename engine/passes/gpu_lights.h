// The lights in GL memory: this frame's, the last frame's, and which of them are the same.
//
// Reuse over time asks what a light was like in the last frame. One table holds both: the rows of
// WorldLights, from `previous_first_row()` on those of the last frame, and, where lights came, went or
// changed places, one row an index: (index in the last frame of light i, index now of the last frame's light
// i), INVALID_INDEX for none.
//
// Behind them, for rays that meet triangles: WorldLights::instance_first and light_of_primitive, four words a
// row.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "frame/frame_recorder.h"
#include "gl/row_buffer.h"
#include "shared/math/light.h"
#include "world/world.h"

namespace tarn {

class GpuLights {
  public:
    explicit GpuLights(const WorldLights& lights);

    // Uploads what changed since the last call.
    void update(const WorldLights& lights);

    // Ends a frame: its lights become the last frame's.
    void advance();

    // Binds the rows and the tables for drawing to their texture units.
    void bind(FrameRecorder& recorder) const;

    std::uint32_t previous_first_row() const { return std::uint32_t(capacity_); }
    // INVALID_INDEX where every light has the index that it had.
    std::uint32_t remap_first_row() const;
    // Where the lookup of lights begins, by instance and by slot.
    std::uint32_t instance_lookup_first_row() const { return std::uint32_t(first_lookup_row()); }
    std::uint32_t slot_lookup_first_row() const { return std::uint32_t(first_lookup_row() + instance_rows_); }
    // Whether any light ever changed: only then do shaders tell the two frames apart.
    bool have_changed() const { return have_changed_; }
    // Whether any is not what it was in the last frame.
    bool are_changing() const { return remapped_ || !changed_rows_.empty(); }

  private:
    void allocate(const WorldLights& lights);
    bool has_room_for(const WorldLights& lights) const;
    void upload_all(const WorldLights& lights);
    void upload_lookup(const WorldLights& lights);
    void upload_rows(const WorldLights& lights, const IndexRange& rows);
    void copy_rows(std::size_t from_row, std::size_t to_row, std::size_t count);
    std::size_t first_remap_row() const { return 2 * capacity_; }
    // The remap has a row for each light that there is room for.
    std::size_t first_lookup_row() const { return first_remap_row() + capacity_ / LIGHT_ROWS + 1; }

    std::optional<RowBuffer> rows_;
    std::optional<RowBuffer> alias_;
    std::size_t capacity_ = 0;  // rows for the lights of one frame
    std::size_t row_count_ = 0;
    std::size_t lookup_capacity_ = 0;                 // rows
    std::size_t instance_rows_ = 0;                   // of the lookup
    std::vector<std::uint64_t> identities_;           // of the lights in rows_
    std::vector<std::uint64_t> previous_identities_;  // of the last frame's
    ChangeLog::Cursor seen_;
    std::uint64_t structure_revision_ = 0;
    std::uint64_t order_revision_ = 0;
    std::vector<IndexRange> changed_rows_;  // where the two frames' rows may differ
    bool remapped_ = false;
    bool have_changed_ = false;
};

}  // namespace tarn
