// The owner of one GL object: move-only, deletes the object at the end of its life, names it for debuggers.
#pragma once

#include <glad/gl.h>

#include <string>
#include <utility>

namespace tarn {

// Owns the GL object `id`; `DESTROY(id)` deletes it. 0 means: owns nothing. The context must be current.
template <void (*DESTROY)(GLuint)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0);
        }
        return *this;
    }

    GLuint id() const { return id_; }

  private:
    void reset() {
        if (id_ != 0) DESTROY(std::exchange(id_, 0));
    }
    GLuint id_ = 0;
};

// Gives the object the name that debuggers and driver messages show; names longer than the driver's limit are
// cut.
void set_label(GLenum kind, GLuint id, const std::string& name);

// Throws Error("WHAT: GL_OUT_OF_MEMORY") and the like when a GL error is pending; clears all pending errors.
void check_gl(const std::string& what);

// One integer of glGetInteger64v: a limit of the driver.
GLint64 get_gl_limit(GLenum limit);

}  // namespace tarn
