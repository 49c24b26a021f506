// Camera rays of a coarse picture go through the pixels that it takes, in this frame and in the last one, and
// surfaces of the last frame are found in the block that holds them.
#include <gtest/gtest.h>

#include <filesystem>
#include <span>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/shader_folder.h"
#include "passes/indirect/coarse.h"
#include "platform/context.h"

namespace tarn {
namespace {

// What is tested, pixel by pixel: the directions of both frames, and where the last frame saw a point that
// lies before its own ray.
constexpr const char* SHADER = R"(
    #define TARN_PREVIOUS_FRAME
    #include "shared/interface/constants/shade.h"
    #include "lib/scene_buffers.glsl"
    #include "lib/frame.glsl"
    #include "lib/gbuffer.glsl"
    #include "lib/receiver.glsl"
    #include "lib/neighbour_test.glsl"
    #include "lib/previous.glsl"
    layout(local_size_x = 1) in;
    layout(std430, binding = 0) writeonly buffer Found { vec4 found[]; };
    void main() {
        ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
        PixelRay before = previous_pixel_ray(pixel);
        ivec2 seen = project_to_previous(before.origin + 3.0f * before.direction);
        uint row = 2u * pixel_index(pixel);
        found[row] = vec4(pixel_ray(pixel).direction, float(seen.x));
        found[row + 1u] = vec4(before.direction, float(seen.y));
    })";

struct View {
    glm::vec3 right;
    glm::vec3 up;
    glm::vec3 forward;
};

// Axes at right angles, as those of a camera.
const View NOW{{0.8f, 0.0f, 0.0f}, {0.0f, 0.5f, 0.0f}, {0.0f, 0.0f, -1.0f}};
const View BEFORE{{0.56f, 0.0f, 0.42f}, {0.0f, 0.6f, 0.0f}, {0.6f, 0.0f, -0.8f}};
constexpr glm::vec2 JITTER_NOW(0.3f, -0.2f);
constexpr glm::vec2 JITTER_BEFORE(-0.4f, 0.1f);

struct Case {
    glm::ivec2 size_px;
    int step_px;
    std::uint32_t frame;
};

// Of the pixel that a coarse picture takes, by elementary means.
glm::ivec2 taken_pixel(const glm::ivec2& coarse, const Case& c, std::uint32_t frame) {
    return glm::min(coarse * c.step_px + glm::ivec2(pick_offset(frame, c.step_px)), c.size_px - 1);
}

glm::dvec3 direction_of(const View& view, const glm::ivec2& pixel, const glm::vec2& jitter, const Case& c) {
    const glm::dvec2 place = (glm::dvec2(pixel) + 0.5 + glm::dvec2(jitter)) / glm::dvec2(c.size_px);
    return glm::normalize(glm::dvec3(view.forward) + (2.0 * place.x - 1.0) * glm::dvec3(view.right) +
                          (1.0 - 2.0 * place.y) * glm::dvec3(view.up));
}

FrameBlock make_block(const Case& c) {
    FrameBlock block{};
    block.frame_camera_right = glm::vec4(NOW.right, 0.0f);
    block.frame_camera_up = glm::vec4(NOW.up, 0.0f);
    block.frame_camera_forward = glm::vec4(NOW.forward, 0.0f);
    block.frame_previous_right = glm::vec4(BEFORE.right, 0.0f);
    block.frame_previous_up = glm::vec4(BEFORE.up, 0.0f);
    block.frame_previous_forward = glm::vec4(BEFORE.forward, 0.0f);
    block.frame_jitter = glm::vec4(JITTER_NOW, JITTER_BEFORE);
    block.frame_size = glm::uvec4(c.size_px, c.frame, 0u);
    block.frame_full = glm::uvec4(c.size_px, 1u, 0u);
    return make_coarse_block(block, c.step_px);
}

// What all pixels of a case get wrong.
struct Errors {
    double now = 0.0;  // greatest distance of the directions
    double before = 0.0;
    int lost = 0;  // points that the last frame saw in another block
};

class CoarseRays : public testing::Test {
  protected:
    CoarseRays() {
        const std::filesystem::path shaders = std::filesystem::path(TARN_SOURCE_DIR) / "shaders";
        for (const char* part : {"shared", "lib"}) {
            std::filesystem::create_directory_symlink(shaders / part, folder_.root() / part);
        }
        folder_.write("rays.comp", SHADER);
    }

    Errors find_errors(const Case& c, const std::vector<std::string>& planted = {}) const {
        const glm::ivec2 coarse_px = coarse_size_px(c.size_px, c.step_px);
        const std::vector<glm::vec4> found = run(make_block(c), coarse_px, planted);
        Errors errors;
        for (int i = 0; i < coarse_px.x * coarse_px.y; ++i) {
            const glm::ivec2 coarse(i % coarse_px.x, i / coarse_px.x);
            const glm::vec4& now = found[std::size_t(2 * i)];
            const glm::vec4& before = found[std::size_t(2 * i + 1)];
            const auto expected = direction_of(NOW, taken_pixel(coarse, c, c.frame), JITTER_NOW, c);
            const auto expected_before =
                direction_of(BEFORE, taken_pixel(coarse, c, c.frame - 1u), JITTER_BEFORE, c);
            errors.now = std::max(errors.now, glm::length(glm::dvec3(now) - expected));
            errors.before = std::max(errors.before, glm::length(glm::dvec3(before) - expected_before));
            errors.lost += glm::ivec2(int(now.w), int(before.w)) != coarse;
        }
        return errors;
    }

  private:
    std::vector<glm::vec4> run(const FrameBlock& block, const glm::ivec2& size_px,
                               const std::vector<std::string>& defines) const {
        const ShaderStage stage{GL_COMPUTE_SHADER, load_shader_source(folder_.root(), "rays.comp", defines)};
        const Program program("rays", std::span(&stage, 1));
        Buffer frame("frame", sizeof(FrameBlock), BufferUse::DYNAMIC);
        frame.upload(0, std::span<const FrameBlock>(&block, 1));
        frame.bind_uniform(BLOCK_FRAME);
        const Buffer found("found", std::size_t(size_px.x * size_px.y) * 2 * sizeof(glm::vec4),
                           BufferUse::DEVICE);
        found.bind_storage(0);
        program.use();
        glDispatchCompute(GLuint(size_px.x), GLuint(size_px.y), 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        return found.download<glm::vec4>();
    }

    std::unique_ptr<Context> context_ = create_context({});
    ShaderFolder folder_;
};

// Sizes that divide and that do not; the step 1 is the picture itself.
TEST_F(CoarseRays, GoThroughThePixelsThatTheCoarsePictureTakes) {
    for (const glm::ivec2& size_px : {glm::ivec2(16, 8), glm::ivec2(13, 7), glm::ivec2(1, 1)}) {
        for (const int step_px : {1, 2, 4}) {
            for (const std::uint32_t frame : {16u, 1u, 2u, 7u, 13u}) {
                const Errors errors = find_errors({size_px, step_px, frame});
                SCOPED_TRACE(testing::Message() << size_px.x << " x " << size_px.y << ", step " << step_px
                                                << ", frame " << frame);
                EXPECT_LT(errors.now, 1e-6);
                EXPECT_LT(errors.before, 1e-6);
                EXPECT_EQ(errors.lost, 0);
            }
        }
    }
}

// A pixel more or less is 1 / 16 of the picture's width here.
TEST_F(CoarseRays, MistakesOfTheOffsetAreFound) {
    for (const int step_px : {2, 4}) {
        const Case c{{16, 8}, step_px, 1};
        EXPECT_GT(find_errors(c, {"TARN_PLANT_FORGET_OFFSET"}).now, 0.03) << step_px;
        EXPECT_GT(find_errors(c, {"TARN_PLANT_PRESENT_OFFSET"}).before, 0.03) << step_px;
    }
}

}  // namespace
}  // namespace tarn
