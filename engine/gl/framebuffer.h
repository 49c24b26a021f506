// A set of textures to draw into.
#pragma once

#include <initializer_list>
#include <string>

#include "gl/handle.h"
#include "gl/texture.h"

namespace tarn {

class Framebuffer {
  public:
    // Draws fragment output i into colours[i]; `depth` may be null. All of one size, and alive as long as
    // this is. Error when the driver cannot draw into this combination.
    Framebuffer(std::string name, std::initializer_list<const Texture2D*> colours, const Texture2D* depth);

    // Makes it the target of draws and sets the viewport to its whole size.
    void bind() const;

    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    GLuint id() const { return handle_.id(); }

  private:
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }

    void attach(GLenum attachment, const Texture2D& texture);

    std::string name_;
    int width_px_ = 0;
    int height_px_ = 0;
    Handle<destroy> handle_;
};

}  // namespace tarn
