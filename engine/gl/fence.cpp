// Waiting for the device.
#include "gl/fence.h"

#include "core/error.h"

namespace tarn {

Fence::Fence() : sync_(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {
    if (sync_ == nullptr) throw Error("glFenceSync failed with GL error 0x{:04x}", glGetError());
}

Fence::~Fence() {
    if (sync_ != nullptr) glDeleteSync(sync_);
}

void Fence::wait() const {
    constexpr GLuint64 ONE_SECOND_NS = 1'000'000'000;
    GLenum status = GL_TIMEOUT_EXPIRED;
    while (status == GL_TIMEOUT_EXPIRED)
        status = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, ONE_SECOND_NS);
    if (status == GL_WAIT_FAILED) throw Error("glClientWaitSync failed with GL error 0x{:04x}", glGetError());
}

}  // namespace tarn
