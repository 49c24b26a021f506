// The KHR_debug callback and groups.
#include "gl/debug_output.h"

#include <glad/gl.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "gl/handle.h"

namespace tarn {

// Locked: a driver may call back from a thread of its own.
struct DebugOutput::Messages {
    std::mutex mutex;
    std::vector<std::string> errors;
};

namespace {

constexpr std::size_t MAX_KEPT_MESSAGES = 100;

void GLAD_API_PTR receive(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                          const void* user) {
    const bool wrong = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (!wrong && severity != GL_DEBUG_SEVERITY_HIGH) return;
    auto& messages = *static_cast<DebugOutput::Messages*>(const_cast<void*>(user));
    // The callback is C: nothing may be thrown through the driver, and a lost message is better than a crash.
    try {
        const std::lock_guard lock(messages.mutex);
        if (messages.errors.size() < MAX_KEPT_MESSAGES)
            messages.errors.emplace_back(
                text, length < 0 ? std::char_traits<char>::length(text) : std::size_t(length));
    } catch (...) {
    }
}

}  // namespace

DebugOutput::DebugOutput() : messages_(std::make_unique<Messages>()) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(receive, messages_.get());
}

DebugOutput::~DebugOutput() = default;

std::vector<std::string> take_debug_errors() {
    void* user = nullptr;
    glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &user);
    if (user == nullptr) return {};
    auto& messages = *static_cast<DebugOutput::Messages*>(user);
    const std::lock_guard lock(messages.mutex);
    return std::exchange(messages.errors, {});
}

DebugGroup::DebugGroup(const std::string& name) {
    const std::size_t limit = std::size_t(get_gl_limit(GL_MAX_DEBUG_MESSAGE_LENGTH)) - 1;
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, GLsizei(std::min(name.size(), limit)), name.c_str());
}

DebugGroup::~DebugGroup() {
    glPopDebugGroup();
}

}  // namespace tarn
