// How a vertex shader's inputs are read from buffers.
#pragma once

#include <cstddef>
#include <string>

#include "gl/buffer.h"
#include "gl/handle.h"

namespace tarn {

class VertexArray {
  public:
    // Without attributes: for shaders that fetch their own vertices by gl_VertexID.
    explicit VertexArray(const std::string& name);

    // Input `location` of `component_count` floats read from `buffer`; `divisor` 1: one per instance.
    void add_float_attribute(unsigned location, int component_count, const Buffer& buffer,
                             std::size_t offset_bytes, std::size_t stride_bytes, unsigned divisor = 0);
    // Input `location` of `component_count` uints read from `buffer`; `divisor` 1: one per instance.
    void add_uint_attribute(unsigned location, int component_count, const Buffer& buffer,
                            std::size_t offset_bytes, std::size_t stride_bytes, unsigned divisor = 0);

    // Indexed draws read `buffer`, which must outlive this object.
    void set_index_buffer(const Buffer& buffer);

    void bind() const { glBindVertexArray(id()); }
    GLuint id() const { return handle_.id(); }

  private:
    static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }

    void attach(unsigned location, const Buffer& buffer, std::size_t offset_bytes, std::size_t stride_bytes,
                unsigned divisor);

    Handle<destroy> handle_;
};

}  // namespace tarn
