// GL textures: a screen-sized image, a stack of them, and a buffer read as texels.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "gl/buffer.h"
#include "gl/handle.h"
#include "gl/pixel_format.h"

namespace tarn {

namespace detail {
inline void delete_texture(GLuint id) {
    glDeleteTextures(1, &id);
}
}  // namespace detail

// Images of one size and format that shaders read through a single texture unit (sampler2DArray): GL 4.5
// promises only 16 units. Each layer is written and downloaded as a Texture2D.
class TextureArray {
  public:
    // Undefined texels; Error for empty images or beyond the driver's limits.
    TextureArray(std::string name, int width_px, int height_px, int layers, GLenum internal_format);

    void bind(unsigned unit) const { glBindTextureUnit(unit, id()); }

    const std::string& name() const { return name_; }
    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    int layers() const { return layers_; }
    const PixelFormat& format() const { return format_; }
    std::size_t size_bytes() const {
        return std::size_t(width_px_) * std::size_t(height_px_) * std::size_t(layers_) * format_.bytes;
    }
    GLuint id() const { return handle_.id(); }

  private:
    std::string name_;
    int width_px_;
    int height_px_;
    int layers_;
    PixelFormat format_;
    Handle<detail::delete_texture> handle_;
};

// A 2D image of one level, read with nearest filtering and clamped at its edges.
class Texture2D {
  public:
    // An image of width x height px with undefined texels; Error for an empty one or one beyond the driver's
    // limit.
    Texture2D(std::string name, int width_px, int height_px, GLenum internal_format);

    // Layer `layer` of a stack of images, over the same memory.
    Texture2D(std::string name, const TextureArray& stack, int layer);

    // Sets every texel: the first for float and normalized formats (depth: x), the others for integer
    // formats.
    void clear(const glm::vec4& value);
    void clear(const glm::uvec4& value);
    void clear(const glm::ivec4& value);

    // Replaces all texels, row 0 first; `texels` holds exactly width * height texels in the format's own
    // layout.
    template <class T>
    void upload(std::span<const T> texels) {
        static_assert(std::is_trivially_copyable_v<T>);
        upload_bytes(texels.data(), texels.size_bytes());
    }
    template <class T>
    void upload(const std::vector<T>& texels) {
        upload(std::span<const T>(texels));
    }

    // Waits for the device and returns all texels, row 0 first. sizeof(T) divides the size of a texel: T may
    // be a texel (vec4 of RGBA32F) or a channel (float of RGBA32F).
    template <class T>
    std::vector<T> download() const {
        static_assert(std::is_trivially_copyable_v<T>);
        TARN_ASSERT(format_.bytes % sizeof(T) == 0,
                    "texture '{}' has {} bytes per texel, read in parts of {}", name_, format_.bytes,
                    sizeof(T));
        std::vector<T> texels(size_bytes() / sizeof(T));
        download_bytes(texels.data());
        return texels;
    }

    // Binds to texture unit `unit` (sampler2D, usampler2D).
    void bind(unsigned unit) const { glBindTextureUnit(unit, id()); }
    // Binds to image unit `unit` with `access` GL_READ_ONLY, GL_WRITE_ONLY or GL_READ_WRITE.
    void bind_image(unsigned unit, GLenum access) const;

    const std::string& name() const { return name_; }
    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    const PixelFormat& format() const { return format_; }
    std::size_t size_bytes() const {
        return std::size_t(width_px_) * std::size_t(height_px_) * format_.bytes;
    }
    GLuint id() const { return handle_.id(); }

  private:
    void upload_bytes(const void* bytes, std::size_t count_bytes);
    void download_bytes(void* bytes) const;

    std::string name_;
    int width_px_;
    int height_px_;
    PixelFormat format_;
    Handle<detail::delete_texture> handle_;
};

// The memory of a buffer read as texels (samplerBuffer): on llvmpipe loads cost 5-20 times less than
// storage-buffer loads. The buffer must outlive the texture.
class BufferTexture {
  public:
    // The whole of `buffer` as texels of `format` (GL_RGBA32F, ...); Error beyond GL_MAX_TEXTURE_BUFFER_SIZE
    // texels.
    BufferTexture(std::string name, const Buffer& buffer, GLenum format);

    // Binds to texture unit `unit` (samplerBuffer, usamplerBuffer).
    void bind(unsigned unit) const { glBindTextureUnit(unit, id()); }
    // Binds to image unit `unit` (imageBuffer, uimageBuffer) with `access` as of a Texture2D.
    void bind_image(unsigned unit, GLenum access) const;

    const std::string& name() const { return name_; }
    GLuint id() const { return handle_.id(); }

  private:
    std::string name_;
    GLenum format_;
    Handle<detail::delete_texture> handle_;
};

}  // namespace tarn
