// The renderer as the benchmark's source of frames: one renderer for each method, so that each keeps its own
// history.
#pragma once

#include <map>
#include <memory>

#include "bench/sequence.h"
#include "renderer/renderer.h"

namespace tarn {

// How a camera moves from frame to frame.
struct CameraMotion {
    double walk_m = 0.0;    // along its right
    double turn_deg = 0.0;  // to the left, about its up

    bool is_still() const { return walk_m == 0.0 && turn_deg == 0.0; }
};

// The camera turned to the left about its up.
CameraRecord turn_camera(const CameraRecord& camera, double turn_deg);

// Where a camera that moves so is `lead` frames before it arrives.
CameraRecord camera_before(const CameraRecord& arrived, const CameraMotion& motion, int lead);

class RendererSource : public FrameSource {
  public:
    // `world` and `tracer` must outlive it; needs a current GL context.
    RendererSource(const World& world, const RayTracer& tracer, int width_px, int height_px);

    // What the next frames look at; a moving camera arrives there with the first frame that counts.
    void set_camera(const CameraRecord& camera, const CameraMotion& motion = {});
    // Uploads what moved in the world to all renderers.
    void update();

    RenderedFrame render(const FrameRequest& request) override;
    std::map<std::string, std::uint64_t> read_counters(std::size_t method) override;

    Renderer& renderer(std::size_t method) { return find_renderer(method); }

  private:
    // Made when it is first asked for, and with it its history.
    Renderer& find_renderer(std::size_t method);

    const World& world_;
    const RayTracer& tracer_;
    int width_px_;
    int height_px_;
    std::map<std::size_t, std::unique_ptr<Renderer>> renderers_;  // by method
    CameraRecord camera_{};
    CameraMotion motion_;
};

}  // namespace tarn
