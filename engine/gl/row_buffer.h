// A table of rows that shaders write as a storage block and read through a buffer texture over the same
// memory.
#pragma once

#include <string>

#include "gl/buffer.h"
#include "gl/texture.h"

namespace tarn {

class RowBuffer {
  public:
    // `size_bytes` of zeros, read as texels of `format` (GL_RGBA32UI: a row a texel). Errors: Buffer,
    // BufferTexture.
    RowBuffer(const std::string& name, std::size_t size_bytes, BufferUse use, GLenum format)
        : buffer_(name, size_bytes, use), texture_(name, buffer_, format) {}

    Buffer& buffer() { return buffer_; }
    const Buffer& buffer() const { return buffer_; }
    const BufferTexture& texture() const { return texture_; }

  private:
    Buffer buffer_;
    BufferTexture texture_;
};

}  // namespace tarn
