// The library in a GL context that is not its own: same pictures, and the host's state stays.
#include <EGL/egl.h>
#include <glad/gl.h>
#include <gtest/gtest.h>

#include <array>

#include "platform/context.h"
// After the engine's own headers: it makes their names ambiguous inside of namespace tarn.
#include <tarn/tarn.h>

namespace {

constexpr int SIZE_PX = 16;

tarn::api::Frame first_frame(const tarn::api::Scene& scene) {
    tarn::api::Frame frame;
    frame.camera = scene.default_camera(1.0);
    frame.settings.set("direct", "ris");
    frame.display.exposure_ev = 0.0f;
    return frame;
}

std::vector<float> render_with_own_context(const tarn::api::Scene& scene) {
    const tarn::api::Engine engine;
    return tarn::api::View(engine, scene, SIZE_PX, SIZE_PX).render(first_frame(scene)).rgb;
}

// A host's framebuffer with odd state around it.
class Host {
  public:
    Host() : context_(tarn::create_context({})) {
        glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
        glTextureStorage2D(texture_, 1, GL_RGBA8, SIZE_PX, SIZE_PX);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        for (const GLenum name : {GL_BLEND, GL_SCISSOR_TEST, GL_CULL_FACE, GL_STENCIL_TEST}) glEnable(name);
        glBlendFunc(GL_ZERO, GL_ZERO);
        glScissor(0, 0, 1, 1);
        glViewport(3, 4, 5, 6);
        glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
        glDepthFunc(GL_NEVER);
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        glPixelStorei(GL_PACK_ALIGNMENT, 8);
    }

    std::array<int, 14> state() const {
        std::array<int, 14> s = {glIsEnabled(GL_BLEND), glIsEnabled(GL_SCISSOR_TEST),
                                 glIsEnabled(GL_CULL_FACE), glIsEnabled(GL_STENCIL_TEST),
                                 glIsEnabled(GL_DEPTH_TEST)};
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s[5]);
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &s[6]);
        glGetIntegerv(GL_VIEWPORT, &s[7]);
        glGetIntegerv(GL_DEPTH_FUNC, &s[11]);
        glGetIntegerv(GL_PACK_ALIGNMENT, &s[12]);
        glGetIntegerv(GL_CURRENT_PROGRAM, &s[13]);
        return s;
    }

    // Sum of all channels of all pixels.
    int picture_sum() const {
        std::array<unsigned char, 4 * SIZE_PX* SIZE_PX> bytes = {};
        glGetTextureImage(texture_, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(bytes.size()), bytes.data());
        int sum = 0;
        for (const unsigned char byte : bytes) sum += byte;
        return sum;
    }

  private:
    std::unique_ptr<tarn::Context> context_;
    GLuint texture_ = 0;
    GLuint framebuffer_ = 0;
};

TEST(LibraryInHost, DrawsTheSameAndLeavesTheStateAsItWas) {
    const tarn::api::Scene scene = tarn::api::Scene::load(TARN_BUILD_DIR "/content/cornell.glb");
    const std::vector<float> expected = render_with_own_context(scene);
    const Host host;
    const auto before = host.state();
    tarn::api::EngineOptions options;
    options.gl_loader = eglGetProcAddress;
    {
        const tarn::api::Engine engine(options);
        tarn::api::View view(engine, scene, SIZE_PX, SIZE_PX);
        EXPECT_EQ(host.state(), before);
        view.draw(first_frame(scene));
        EXPECT_EQ(host.state(), before);
        EXPECT_EQ(view.read().rgb, expected);
        view.present(SIZE_PX, SIZE_PX);
        EXPECT_EQ(host.state(), before);
        EXPECT_GT(host.picture_sum(), 255 * SIZE_PX * SIZE_PX + 1000);
    }
    EXPECT_EQ(host.state(), before);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

}  // namespace
