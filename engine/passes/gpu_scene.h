// The world's tables in GL memory, and the uniform block of the frame.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/texture.h"
#include "shared/interface/frame_block.h"
#include "world/world.h"

namespace tarn {

// A table as shaders read it: a buffer and the texture through which its rows are fetched.
class Table {
  public:
    template <class Row>
    Table(const std::string& name, const std::vector<Row>& rows, GLenum format)
        : buffer_(name, rows.size() * sizeof(Row), BufferUse::DYNAMIC), texture_(name, buffer_, format) {
        upload(rows);
    }

    // Replaces the first rows; there must be room for them.
    template <class Row>
    void upload(const std::vector<Row>& rows) {
        if (!rows.empty()) buffer_.upload(0, rows);
    }
    // Replaces rows from `first_row` on.
    template <class Row>
    void upload_range(std::size_t first_row, std::span<const Row> rows) {
        buffer_.upload(first_row * sizeof(Row), rows);
    }
    bool holds(std::size_t size_bytes) const { return size_bytes <= buffer_.size_bytes(); }
    void bind(unsigned unit) const { texture_.bind(unit); }
    const Buffer& buffer() const { return buffer_; }

  private:
    Buffer buffer_;
    BufferTexture texture_;
};

class GpuScene {
  public:
    explicit GpuScene(const World& world);

    // Uploads what has moved since the last call.
    void update(const World& world);

    // Binds all tables to their texture units (shared/interface/bindings.h).
    void bind() const;

    const Buffer& vertex_buffer() const { return vertices_.buffer(); }
    const Buffer& triangle_buffer() const { return triangles_.buffer(); }

  private:
    std::vector<std::uint64_t> mesh_revisions_;
    std::vector<std::uint64_t> instance_revisions_;
    std::uint64_t light_revision_ = 0;
    Table vertices_;
    Table triangles_;
    Table instances_;
    Table materials_;
    Table texels_;
    std::optional<Table> light_rows_;
    std::optional<Table> light_alias_;
    Table environment_texels_;
    Table environment_alias_;

    void upload_lights(const WorldLights& lights);
};

}  // namespace tarn
