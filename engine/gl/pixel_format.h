// What the texels of an internal format look like in memory.
#pragma once

#include <glad/gl.h>

#include <cstddef>

namespace tarn {

// The client format and type that copy an internal format bit for bit, and its size in bytes per texel.
struct PixelFormat {
    GLenum internal_format;
    const char* name;
    GLenum format;
    GLenum type;
    std::size_t bytes;
    int channels;

    bool is_integer() const;
    bool is_depth() const { return format == GL_DEPTH_COMPONENT; }
};

// The row of `internal_format`; Error when Tarn does not use that format.
const PixelFormat& get_pixel_format(GLenum internal_format);

}  // namespace tarn
