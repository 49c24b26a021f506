// A GL buffer with immutable storage: on the device, updated now and then, or shared with the CPU without a
// copy.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "gl/handle.h"

namespace tarn {

enum class BufferUse {
    DEVICE,   // written by shaders (or at construction), never by the CPU
    DYNAMIC,  // the CPU uploads ranges now and then
    SHARED,   // persistent coherent mapping: CPU and shaders read and write the same bytes
};

class Buffer {
  public:
    static constexpr std::size_t MIN_SIZE_BYTES = 16;

    // A buffer of `size_bytes` (at least MIN_SIZE_BYTES), filled with zeros; Error when the driver cannot
    // hold it.
    Buffer(std::string name, std::size_t size_bytes, BufferUse use);

    // A buffer that starts with the bytes of `rows`.
    template <class T>
    static Buffer from(std::string name, std::span<const T> rows, BufferUse use = BufferUse::DEVICE) {
        static_assert(std::is_trivially_copyable_v<T>);
        return Buffer(std::move(name), rows.data(), rows.size_bytes(), use);
    }
    template <class T>
    static Buffer from(std::string name, const std::vector<T>& rows, BufferUse use = BufferUse::DEVICE) {
        return from(std::move(name), std::span<const T>(rows), use);
    }

    // Copies `rows` to byte `offset_bytes`. DYNAMIC: ordered with the GL commands around it. SHARED: at once,
    // so that the caller waits for a Fence first if shaders still read the range. Not for DEVICE.
    template <class T>
    void upload(std::size_t offset_bytes, std::span<const T> rows) {
        static_assert(std::is_trivially_copyable_v<T>);
        upload_bytes(offset_bytes, rows.data(), rows.size_bytes());
    }
    template <class T>
    void upload(std::size_t offset_bytes, const std::vector<T>& rows) {
        upload(offset_bytes, std::span<const T>(rows));
    }

    // Copies bytes on the device, from `source` (or this buffer, where the two ranges must not overlap),
    // ordered with the GL commands around it.
    void copy(std::size_t from_bytes, std::size_t to_bytes, std::size_t count_bytes) {
        copy(*this, from_bytes, to_bytes, count_bytes);
    }
    void copy(const Buffer& source, std::size_t from_bytes, std::size_t to_bytes, std::size_t count_bytes);

    // Waits for the device and returns the whole buffer (for tests and reports; any use).
    template <class T>
    std::vector<T> download() const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> rows(size_bytes_ / sizeof(T));
        download_bytes(rows.data(), rows.size() * sizeof(T));
        return rows;
    }

    // The memory of a SHARED buffer as rows of T, valid until the buffer dies. Shader writes are seen after
    // glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT) and a Fence; CPU writes by commands issued later.
    template <class T>
    std::span<T> mapped() const {
        static_assert(std::is_trivially_copyable_v<T>);
        TARN_ASSERT(mapping_ != nullptr, "buffer '{}' is not SHARED: it has no mapping", name_);
        return {static_cast<T*>(mapping_), size_bytes_ / sizeof(T)};
    }

    // Fills the buffer with zeros, ordered with the GL commands around it.
    void clear();

    // Binds the whole buffer as storage block `binding`; Error beyond GL_MAX_SHADER_STORAGE_BLOCK_SIZE.
    void bind_storage(unsigned binding) const;

    // Binds the whole buffer as uniform block `binding`; Error beyond GL_MAX_UNIFORM_BLOCK_SIZE.
    void bind_uniform(unsigned binding) const;

    const std::string& name() const { return name_; }
    std::size_t size_bytes() const { return size_bytes_; }
    BufferUse use() const { return use_; }
    GLuint id() const { return handle_.id(); }

  private:
    static void destroy(GLuint id) { glDeleteBuffers(1, &id); }

    Buffer(std::string name, const void* bytes, std::size_t size_bytes, BufferUse use);
    void upload_bytes(std::size_t offset_bytes, const void* bytes, std::size_t count_bytes);
    void download_bytes(void* bytes, std::size_t count_bytes) const;
    void bind_block(GLenum target, GLenum limit, const char* limit_name, unsigned binding) const;

    std::string name_;
    std::size_t size_bytes_;
    BufferUse use_;
    Handle<destroy> handle_;
    void* mapping_ = nullptr;
};

}  // namespace tarn
