#include "frame/constants_buffer.h"

#include <span>

#include "gl/handle.h"
#include "shared/interface/bindings.h"

namespace tarn {
namespace {

constexpr std::size_t BLOCK_BYTES = 64 * 1024;

}  // namespace

ConstantsBuffer::ConstantsBuffer()
    : alignment_bytes_(std::size_t(get_gl_limit(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT))) {}

void ConstantsBuffer::clear() {
    used_bytes_ = 0;
    current_ = 0;
}

void ConstantsBuffer::bind(const void* bytes, std::size_t size_bytes) {
    const std::size_t place_bytes = (size_bytes + alignment_bytes_ - 1) / alignment_bytes_ * alignment_bytes_;
    TARN_ASSERT(place_bytes <= BLOCK_BYTES, "{} bytes of constants, a block holds {}", size_bytes,
                BLOCK_BYTES);
    if (used_bytes_ + place_bytes > BLOCK_BYTES) {
        ++current_;
        used_bytes_ = 0;
    }
    if (current_ == blocks_.size()) blocks_.emplace_back("frame/constants", BLOCK_BYTES, BufferUse::SHARED);
    Buffer& block = blocks_[current_];
    block.upload(used_bytes_, std::span(static_cast<const std::byte*>(bytes), size_bytes));
    glBindBufferRange(GL_UNIFORM_BUFFER, BLOCK_PASS, block.id(), GLintptr(used_bytes_),
                      GLsizeiptr(place_bytes));
    used_bytes_ += place_bytes;
}

}  // namespace tarn
