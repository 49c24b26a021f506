// The constants of all passes of a frame, one after the other in memory that GL shares.
#pragma once

#include <cstddef>
#include <vector>

#include "gl/buffer.h"

namespace tarn {

class ConstantsBuffer {
  public:
    ConstantsBuffer();

    // Starts again from the front. The device must have done with the last frame.
    void clear();

    // Copies `size_bytes` and binds them as the uniform block BLOCK_PASS.
    void bind(const void* bytes, std::size_t size_bytes);

  private:
    std::size_t alignment_bytes_;
    std::size_t used_bytes_ = 0;  // of the current block
    std::size_t current_ = 0;
    std::vector<Buffer> blocks_;
};

}  // namespace tarn
