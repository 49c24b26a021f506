// What a pass needs around it, for tests of single passes: no scene, no renderer.
#pragma once

#include <memory>
#include <string>

#include "passes/frame_context.h"
#include "platform/context.h"
#include "shared/interface/frame_block.h"

namespace tarn::test {

// The cameras of this frame and of the last one, perspective both; nothing else.
inline FrameBlock make_camera_block(const CameraRecord& camera, const CameraRecord& previous) {
    FrameBlock block{};
    block.frame_camera_position = glm::vec4(camera.position, 0.0f);
    block.frame_camera_right = glm::vec4(camera.right, 0.0f);
    block.frame_camera_up = glm::vec4(camera.up, 0.0f);
    block.frame_camera_forward = glm::vec4(camera.forward, 0.0f);
    block.frame_previous_position = glm::vec4(previous.position, 0.0f);
    block.frame_previous_right = glm::vec4(previous.right, 0.0f);
    block.frame_previous_up = glm::vec4(previous.up, 0.0f);
    block.frame_previous_forward = glm::vec4(previous.forward, 0.0f);
    return block;
}

class PassContext {
  public:
    PassContext()
        : context_(create_context({})),
          recorder_(std::make_unique<FrameRecorder>()),
          tracer_(create_brute_force_tracer(world_)),
          counters_(std::make_unique<Buffer>("test/counters", COUNTER_COUNT * sizeof(std::uint32_t),
                                             BufferUse::DEVICE)) {}

    FrameRecorder& recorder() { return *recorder_; }
    const Buffer& counters() const { return *counters_; }

    // Mistakes for the shaders of passes that follow.
    void plant(const Defines& defines) { defines_ = defines; }

    FrameContext frame(const glm::ivec2& size_px, const glm::ivec2& output_px) {
        return {*recorder_, programs_, *tracer_, *counters_, rays_,
                plan_,      settings_, defines_, size_px,    output_px};
    }

    // A picture as if an earlier pass of this frame had written these texels.
    template <class Texel>
    Picture write_picture(const std::string& name, const glm::ivec2& size_px, GLenum format,
                          const std::vector<Texel>& texels) {
        const Picture picture = recorder_->take_picture(name, size_px, format);
        picture->upload(texels);
        recorder_->pass("test/write").write_image(0, *picture);
        return picture;
    }

  private:
    std::unique_ptr<Context> context_;
    std::unique_ptr<FrameRecorder> recorder_;
    ProgramLibrary programs_;
    World world_;
    std::unique_ptr<RayTracer> tracer_;
    std::unique_ptr<Buffer> counters_;
    RayCounts rays_;
    FramePlan plan_;
    RenderSettings settings_;
    Defines defines_;
};

}  // namespace tarn::test
