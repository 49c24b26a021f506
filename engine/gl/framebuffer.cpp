// Attachments and completeness of framebuffers.
#include "gl/framebuffer.h"

#include <vector>

namespace tarn {
namespace {

GLuint create_framebuffer() {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    return id;
}

}  // namespace

Framebuffer::Framebuffer(std::string name, std::initializer_list<const Texture2D*> colours,
                         const Texture2D* depth)
    : name_(std::move(name)), handle_(create_framebuffer()) {
    set_label(GL_FRAMEBUFFER, id(), name_);
    std::vector<GLenum> draw_buffers;
    for (const Texture2D* colour : colours) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + GLenum(draw_buffers.size());
        attach(attachment, *colour);
        draw_buffers.push_back(attachment);
    }
    if (depth != nullptr) attach(GL_DEPTH_ATTACHMENT, *depth);
    glNamedFramebufferDrawBuffers(id(), GLsizei(draw_buffers.size()), draw_buffers.data());
    const GLenum status = glCheckNamedFramebufferStatus(id(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Error("framebuffer '{}' with {} colour targets is incomplete: status 0x{:04x}", name_,
                    draw_buffers.size(), status);
}

void Framebuffer::attach(GLenum attachment, const Texture2D& texture) {
    TARN_ASSERT(width_px_ == 0 || (width_px_ == texture.width_px() && height_px_ == texture.height_px()),
                "framebuffer '{}' is {}x{} px, '{}' is {}x{}", name_, width_px_, height_px_, texture.name(),
                texture.width_px(), texture.height_px());
    width_px_ = texture.width_px();
    height_px_ = texture.height_px();
    glNamedFramebufferTexture(id(), attachment, texture.id(), 0);
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, id());
    glViewport(0, 0, width_px_, height_px_);
}

}  // namespace tarn
