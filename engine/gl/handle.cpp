// Labels, error checks and limits that all GL objects share.
#include "gl/handle.h"

#include <algorithm>

#include "core/error.h"

namespace tarn {
namespace {

const char* error_name(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE:
            return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION:
            return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY:
            return "GL_OUT_OF_MEMORY";
        case GL_CONTEXT_LOST:
            return "GL_CONTEXT_LOST";
        default:
            return "unknown GL error";
    }
}

}  // namespace

void set_label(GLenum kind, GLuint id, const std::string& name) {
    // The limit counts the terminating zero.
    const std::size_t limit = std::size_t(get_gl_limit(GL_MAX_LABEL_LENGTH)) - 1;
    glObjectLabel(kind, id, GLsizei(std::min(name.size(), limit)), name.c_str());
}

void check_gl(const std::string& what) {
    const GLenum first = glGetError();
    if (first == GL_NO_ERROR) return;
    // A lost context reports its loss for ever: never loop on it.
    if (first != GL_CONTEXT_LOST) {
        for (GLenum next = glGetError(); next != GL_NO_ERROR && next != GL_CONTEXT_LOST;
             next = glGetError()) {
        }
    }
    throw Error("{}: {}", what, error_name(first));
}

GLint64 get_gl_limit(GLenum limit) {
    GLint64 value = 0;
    glGetInteger64v(limit, &value);
    return value;
}

}  // namespace tarn
