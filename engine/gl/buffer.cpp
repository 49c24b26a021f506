// Buffer storage, mapping and copies.
#include "gl/buffer.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace tarn {
namespace {

constexpr GLbitfield MAPPING_FLAGS =
    GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

GLbitfield storage_flags(BufferUse use) {
    switch (use) {
        case BufferUse::DEVICE:
            return 0;
        case BufferUse::DYNAMIC:
            return GL_DYNAMIC_STORAGE_BIT;
        case BufferUse::SHARED:
            return MAPPING_FLAGS;
    }
    return 0;
}

GLuint create_buffer() {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    return id;
}

}  // namespace

Buffer::Buffer(std::string name, std::size_t size_bytes, BufferUse use)
    : Buffer(std::move(name), nullptr, size_bytes, use) {}

Buffer::Buffer(std::string name, const void* bytes, std::size_t size_bytes, BufferUse use)
    : name_(std::move(name)),
      size_bytes_(std::max(size_bytes, MIN_SIZE_BYTES)),
      use_(use),
      handle_(create_buffer()) {
    set_label(GL_BUFFER, id(), name_);
    if (size_bytes_ > std::size_t(std::numeric_limits<GLsizeiptr>::max()))
        throw Error("buffer '{}' of {} bytes exceeds what GL can address", name_, size_bytes_);
    // A request below the minimum has fewer bytes than the storage: it is cleared, then filled.
    const bool whole = bytes != nullptr && size_bytes == size_bytes_;
    const GLbitfield fill = bytes != nullptr && !whole ? GLbitfield(GL_DYNAMIC_STORAGE_BIT) : 0;
    glNamedBufferStorage(id(), GLsizeiptr(size_bytes_), whole ? bytes : nullptr, storage_flags(use) | fill);
    check_gl(fmt::format("buffer '{}' of {} bytes", name_, size_bytes_));
    if (!whole) clear();
    if (fill != 0 && size_bytes > 0) glNamedBufferSubData(id(), 0, GLsizeiptr(size_bytes), bytes);
    if (use == BufferUse::SHARED) {
        mapping_ = glMapNamedBufferRange(id(), 0, GLsizeiptr(size_bytes_), MAPPING_FLAGS);
        check_gl(fmt::format("mapping buffer '{}' of {} bytes", name_, size_bytes_));
        if (mapping_ == nullptr) throw Error("buffer '{}' of {} bytes cannot be mapped", name_, size_bytes_);
    }
}

void Buffer::upload_bytes(std::size_t offset_bytes, const void* bytes, std::size_t count_bytes) {
    TARN_ASSERT(use_ != BufferUse::DEVICE, "buffer '{}' is DEVICE: the CPU cannot write it", name_);
    TARN_ASSERT(offset_bytes <= size_bytes_ && count_bytes <= size_bytes_ - offset_bytes,
                "bytes {}+{} are outside of buffer '{}' of {} bytes", offset_bytes, count_bytes, name_,
                size_bytes_);
    if (count_bytes == 0) return;
    if (use_ == BufferUse::SHARED)
        std::memcpy(static_cast<std::byte*>(mapping_) + offset_bytes, bytes, count_bytes);
    else
        glNamedBufferSubData(id(), GLintptr(offset_bytes), GLsizeiptr(count_bytes), bytes);
}

void Buffer::copy(const Buffer& source, std::size_t from_bytes, std::size_t to_bytes,
                  std::size_t count_bytes) {
    if (count_bytes == 0) return;
    glCopyNamedBufferSubData(source.id(), id(), GLintptr(from_bytes), GLintptr(to_bytes),
                             GLsizeiptr(count_bytes));
}

void Buffer::download_bytes(void* bytes, std::size_t count_bytes) const {
    if (count_bytes == 0) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(id(), 0, GLsizeiptr(count_bytes), bytes);
}

void Buffer::clear() {
    glClearNamedBufferData(id(), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr);
}

void Buffer::bind_storage(unsigned binding) const {
    bind_block(GL_SHADER_STORAGE_BUFFER, GL_MAX_SHADER_STORAGE_BLOCK_SIZE, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE",
               binding);
}

void Buffer::bind_uniform(unsigned binding) const {
    bind_block(GL_UNIFORM_BUFFER, GL_MAX_UNIFORM_BLOCK_SIZE, "GL_MAX_UNIFORM_BLOCK_SIZE", binding);
}

void Buffer::bind_block(GLenum target, GLenum limit, const char* limit_name, unsigned binding) const {
    const GLint64 limit_bytes = get_gl_limit(limit);
    if (GLint64(size_bytes_) > limit_bytes)
        throw Error("buffer '{}' of {} bytes is beyond {} of {} bytes", name_, size_bytes_, limit_name,
                    limit_bytes);
    glBindBufferBase(target, binding, id());
}

}  // namespace tarn
