// Texture storage, uploads and clears.
#include "gl/texture.h"

#include <algorithm>

namespace tarn {
namespace {

GLuint create_texture(GLenum target) {
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    return id;
}

GLuint generate_texture() {
    GLuint id = 0;
    glGenTextures(1, &id);
    return id;
}

void check_extent(const std::string& name, int width_px, int height_px) {
    const GLint64 limit = get_gl_limit(GL_MAX_TEXTURE_SIZE);
    if (width_px < 1 || height_px < 1 || width_px > limit || height_px > limit)
        throw Error("texture '{}' is {}x{} px, each side must be 1..{}", name, width_px, height_px, limit);
}

void set_sampling(GLuint id, GLint filter, GLint wrap) {
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, wrap);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, wrap);
}

// Rows are tightly packed in client memory, whatever the size of a texel.
void set_tight_rows() {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

// The base format without the order of channels: clears give all four, as GL drops those that do not exist.
void clear_texture(const Texture2D& texture, GLenum format, GLenum type, const void* value) {
    glClearTexImage(texture.id(), 0, texture.format().is_depth() ? GLenum(GL_DEPTH_COMPONENT) : format, type,
                    value);
}

}  // namespace

TextureArray::TextureArray(std::string name, int width_px, int height_px, int layers, GLenum internal_format)
    : name_(std::move(name)),
      width_px_(width_px),
      height_px_(height_px),
      layers_(layers),
      format_(get_pixel_format(internal_format)),
      handle_(create_texture(GL_TEXTURE_2D_ARRAY)) {
    set_label(GL_TEXTURE, id(), name_);
    check_extent(name_, width_px, height_px);
    const GLint64 limit = get_gl_limit(GL_MAX_ARRAY_TEXTURE_LAYERS);
    if (layers < 1 || layers > limit)
        throw Error("texture '{}' has {} layers, there must be 1..{}", name_, layers, limit);
    glTextureStorage3D(id(), 1, internal_format, width_px, height_px, layers);
    check_gl(fmt::format("texture '{}' of {}x{}x{} px {}", name_, width_px, height_px, layers, format_.name));
    set_sampling(id(), GL_NEAREST, GL_CLAMP_TO_EDGE);
}

Texture2D::Texture2D(std::string name, int width_px, int height_px, GLenum internal_format)
    : name_(std::move(name)),
      width_px_(width_px),
      height_px_(height_px),
      format_(get_pixel_format(internal_format)),
      handle_(create_texture(GL_TEXTURE_2D)) {
    set_label(GL_TEXTURE, id(), name_);
    check_extent(name_, width_px, height_px);
    glTextureStorage2D(id(), 1, internal_format, width_px, height_px);
    check_gl(fmt::format("texture '{}' of {}x{} px {}", name_, width_px, height_px, format_.name));
    set_sampling(id(), GL_NEAREST, GL_CLAMP_TO_EDGE);
}

Texture2D::Texture2D(std::string name, const TextureArray& stack, int layer)
    : name_(std::move(name)),
      width_px_(stack.width_px()),
      height_px_(stack.height_px()),
      format_(stack.format()),
      handle_(generate_texture()) {
    TARN_ASSERT(layer >= 0 && layer < stack.layers(), "texture '{}' has {} layers, not {}", stack.name(),
                stack.layers(), layer);
    // A view takes a name without storage or target.
    glTextureView(id(), GL_TEXTURE_2D, stack.id(), format_.internal_format, 0, 1, GLuint(layer), 1);
    set_label(GL_TEXTURE, id(), name_);
    check_gl(fmt::format("layer {} of texture '{}'", layer, stack.name()));
    set_sampling(id(), GL_NEAREST, GL_CLAMP_TO_EDGE);
}

void Texture2D::clear(const glm::vec4& value) {
    TARN_ASSERT(!format_.is_integer(), "texture '{}' has integer texels: clear it with integers", name_);
    clear_texture(*this, GL_RGBA, GL_FLOAT, &value.x);
}

void Texture2D::clear(const glm::uvec4& value) {
    TARN_ASSERT(format_.is_integer(), "texture '{}' has no integer texels: clear it with floats", name_);
    clear_texture(*this, GL_RGBA_INTEGER, GL_UNSIGNED_INT, &value.x);
}

void Texture2D::clear(const glm::ivec4& value) {
    TARN_ASSERT(format_.is_integer(), "texture '{}' has no integer texels: clear it with floats", name_);
    clear_texture(*this, GL_RGBA_INTEGER, GL_INT, &value.x);
}

void Texture2D::upload_bytes(const void* bytes, std::size_t count_bytes) {
    TARN_ASSERT(count_bytes == size_bytes(), "texture '{}' holds {} bytes, got {}", name_, size_bytes(),
                count_bytes);
    set_tight_rows();
    glTextureSubImage2D(id(), 0, 0, 0, width_px_, height_px_, format_.format, format_.type, bytes);
}

void Texture2D::download_bytes(void* bytes) const {
    set_tight_rows();
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(id(), 0, format_.format, format_.type, GLsizei(size_bytes()), bytes);
}

void Texture2D::bind_image(unsigned unit, GLenum access) const {
    glBindImageTexture(unit, id(), 0, GL_FALSE, 0, access, format_.internal_format);
}

void BufferTexture::bind_image(unsigned unit, GLenum access) const {
    glBindImageTexture(unit, id(), 0, GL_FALSE, 0, access, format_);
}

BufferTexture::BufferTexture(std::string name, const Buffer& buffer, GLenum format)
    : name_(std::move(name)), format_(format), handle_(create_texture(GL_TEXTURE_BUFFER)) {
    set_label(GL_TEXTURE, id(), name_);
    const std::size_t texel_count = buffer.size_bytes() / get_pixel_format(format).bytes;
    const GLint64 limit = get_gl_limit(GL_MAX_TEXTURE_BUFFER_SIZE);
    if (GLint64(texel_count) > limit)
        throw Error("buffer texture '{}' has {} texels, GL_MAX_TEXTURE_BUFFER_SIZE is {}", name_, texel_count,
                    limit);
    glTextureBuffer(id(), format, buffer.id());
    check_gl(fmt::format("buffer texture '{}' of format {}", name_, get_pixel_format(format).name));
}

}  // namespace tarn
