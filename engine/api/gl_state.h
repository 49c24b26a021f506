// The caller's GL state, put aside while the engine draws in a borrowed context.
#pragma once

#include <glad/gl.h>

#include <array>

namespace tarn::api {

// Remembers what a host usually relies on and sets what the engine's passes expect; restores it when it dies.
class GlStateGuard {
  public:
    GlStateGuard();
    ~GlStateGuard();
    GlStateGuard(const GlStateGuard&) = delete;
    GlStateGuard& operator=(const GlStateGuard&) = delete;

    // The caller's draw framebuffer.
    GLuint draw_framebuffer() const { return GLuint(draw_framebuffer_); }

  private:
    static constexpr std::array<GLenum, 9> SWITCHES = {
        GL_BLEND,          GL_CULL_FACE,   GL_DEPTH_TEST,       GL_SCISSOR_TEST,      GL_STENCIL_TEST,
        GL_COLOR_LOGIC_OP, GL_DEPTH_CLAMP, GL_FRAMEBUFFER_SRGB, GL_RASTERIZER_DISCARD};

    std::array<GLboolean, SWITCHES.size()> switches_ = {};
    GLint program_ = 0, vertex_array_ = 0, draw_framebuffer_ = 0, read_framebuffer_ = 0, active_texture_ = 0;
    GLint pack_buffer_ = 0, unpack_buffer_ = 0, pack_alignment_ = 0, unpack_alignment_ = 0;
    GLint depth_function_ = 0, front_face_ = 0, cull_face_ = 0;
    GLint clip_origin_ = 0, clip_depth_ = 0;
    std::array<GLint, 2> polygon_mode_ = {};  // front and back: drivers give both
    std::array<GLint, 4> viewport_ = {};
    std::array<GLboolean, 4> colour_mask_ = {};
    GLboolean depth_mask_ = GL_TRUE;
};

}  // namespace tarn::api
