// The point in the command stream that the CPU can wait for.
#pragma once

#include <glad/gl.h>

#include <utility>

namespace tarn {

class Fence {
  public:
    // Marks the end of all commands issued so far.
    Fence();
    ~Fence();
    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        std::swap(sync_, other.sync_);
        return *this;
    }

    // Flushes and blocks until those commands are done; Error when the driver fails to wait.
    void wait() const;

  private:
    GLsync sync_;
};

}  // namespace tarn
