// The world's tables in GL memory: as they are, and what of them the last frame saw elsewhere.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "gl/row_buffer.h"
#include "passes/gpu_lights.h"
#include "shared/interface/frame_block.h"
#include "world/world.h"

namespace tarn {

// A table that the CPU fills and shaders fetch from, row by row.
class Table {
  public:
    template <class Row>
    Table(const std::string& name, const std::vector<Row>& rows, GLenum format)
        : row_bytes_(sizeof(Row)), rows_(name, rows.size() * sizeof(Row), BufferUse::DYNAMIC, format) {
        upload(rows);
    }

    // Replaces the first rows; there must be room for them.
    template <class Row>
    void upload(const std::vector<Row>& rows) {
        if (!rows.empty()) rows_.buffer().upload(0, rows);
    }
    // Replaces rows from `first_row` on.
    template <class Row>
    void upload_range(std::size_t first_row, std::span<const Row> rows) {
        if (!rows.empty()) rows_.buffer().upload(first_row * sizeof(Row), rows);
    }
    void copy_rows(std::size_t from_row, std::size_t to_row, std::size_t count) {
        rows_.buffer().copy(from_row * row_bytes_, to_row * row_bytes_, count * row_bytes_);
    }
    const RowBuffer& rows() const { return rows_; }
    const Buffer& buffer() const { return rows_.buffer(); }

  private:
    std::size_t row_bytes_;
    RowBuffer rows_;
};

class GpuScene {
  public:
    explicit GpuScene(const World& world);

    // Uploads what has moved since the last call.
    void update(const World& world);

    // Ends a frame: where things are now becomes where they were.
    void advance(const World& world);

    // Binds all tables to their texture units for a frame (shared/interface/bindings.h).
    void bind(FrameRecorder& recorder) const;

    const Buffer& vertex_buffer() const { return vertices_.buffer(); }
    const Buffer& triangle_buffer() const { return triangles_.buffer(); }
    const GpuLights& lights() const { return lights_; }
    // Where the last frame's instances begin in the table of instances.
    std::uint32_t previous_first_instance() const { return std::uint32_t(instance_revisions_.size()); }
    // Whether anything ever moved: only then do shaders ask where it was.
    bool has_moved() const { return has_moved_; }
    // Whether anything, lights included, is not what it was in the last frame.
    bool is_changing() const {
        return moved_instances_ || !moved_meshes_.empty() || edited_materials_ || lights_.are_changing();
    }
    // Whether materials are not what they were in the last frame.
    bool have_materials_changed() const { return edited_materials_; }
    // Whether any light ever changed, or a material, which may say how much of a light is there.
    bool have_lights_changed() const { return has_edited_materials_ || lights_.have_changed(); }

  private:
    void update_vertices(const World& world);

    std::vector<std::uint64_t> mesh_revisions_;
    std::vector<std::uint64_t> instance_revisions_;
    std::uint64_t material_revision_;
    // Meshes that deform keep the last frame's vertices behind all others; INVALID_INDEX for the rest.
    std::vector<std::uint32_t> previous_first_vertex_;
    std::vector<std::uint32_t> moved_meshes_;  // since the last frame
    bool moved_instances_ = false;
    bool has_moved_ = false;
    bool edited_materials_ = false;  // since the last frame
    bool has_edited_materials_ = false;
    Table vertices_;
    Table triangles_;
    Table instances_;
    Table materials_;
    Table texels_;
    GpuLights lights_;
    Table environment_texels_;
    Table environment_alias_;
};

}  // namespace tarn
