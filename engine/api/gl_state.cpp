#include "api/gl_state.h"

namespace tarn::api {
namespace {

GLint get(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

void turn(GLenum name, bool on) {
    (on ? glEnable : glDisable)(name);
}

}  // namespace

GlStateGuard::GlStateGuard() {
    for (std::size_t i = 0; i < SWITCHES.size(); ++i) {
        switches_[i] = glIsEnabled(SWITCHES[i]);
        glDisable(SWITCHES[i]);
    }
    program_ = get(GL_CURRENT_PROGRAM);
    vertex_array_ = get(GL_VERTEX_ARRAY_BINDING);
    draw_framebuffer_ = get(GL_DRAW_FRAMEBUFFER_BINDING);
    read_framebuffer_ = get(GL_READ_FRAMEBUFFER_BINDING);
    active_texture_ = get(GL_ACTIVE_TEXTURE);
    pack_buffer_ = get(GL_PIXEL_PACK_BUFFER_BINDING);
    unpack_buffer_ = get(GL_PIXEL_UNPACK_BUFFER_BINDING);
    pack_alignment_ = get(GL_PACK_ALIGNMENT);
    unpack_alignment_ = get(GL_UNPACK_ALIGNMENT);
    depth_function_ = get(GL_DEPTH_FUNC);
    front_face_ = get(GL_FRONT_FACE);
    cull_face_ = get(GL_CULL_FACE_MODE);
    glGetIntegerv(GL_POLYGON_MODE, polygon_mode_.data());
    clip_origin_ = get(GL_CLIP_ORIGIN);
    clip_depth_ = get(GL_CLIP_DEPTH_MODE);
    glGetIntegerv(GL_VIEWPORT, viewport_.data());
    glGetBooleanv(GL_COLOR_WRITEMASK, colour_mask_.data());
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

GlStateGuard::~GlStateGuard() {
    for (std::size_t i = 0; i < SWITCHES.size(); ++i) turn(SWITCHES[i], switches_[i] == GL_TRUE);
    glUseProgram(GLuint(program_));
    glBindVertexArray(GLuint(vertex_array_));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(draw_framebuffer_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(read_framebuffer_));
    glActiveTexture(GLenum(active_texture_));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(pack_buffer_));
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(unpack_buffer_));
    glPixelStorei(GL_PACK_ALIGNMENT, pack_alignment_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, unpack_alignment_);
    glDepthFunc(GLenum(depth_function_));
    glFrontFace(GLenum(front_face_));
    glCullFace(GLenum(cull_face_));
    glPolygonMode(GL_FRONT_AND_BACK, GLenum(polygon_mode_[0]));
    glClipControl(GLenum(clip_origin_), GLenum(clip_depth_));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    glColorMask(colour_mask_[0], colour_mask_[1], colour_mask_[2], colour_mask_[3]);
    glDepthMask(depth_mask_);
}

}  // namespace tarn::api
