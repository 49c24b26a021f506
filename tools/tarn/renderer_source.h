// The renderer as the benchmark's source of frames: one renderer a method, so that each keeps its own
// history.
#pragma once

#include <memory>
#include <vector>

#include "bench/sequence.h"
#include "renderer/renderer.h"

namespace tarn {

class RendererSource : public FrameSource {
  public:
    // `world` and `tracer` must outlive it; needs a current GL context.
    RendererSource(World& world, const RayTracer& tracer, int width_px, int height_px,
                   std::size_t method_count);

    // What the next frames look at.
    void set_camera(const CameraRecord& camera) { camera_ = camera; }
    // Uploads what moved in the world to all renderers.
    void update();

    RenderedFrame render(std::size_t method, const RenderSettings& settings, std::uint32_t seed,
                         std::uint32_t frame, bool starts) override;
    std::map<std::string, std::uint64_t> read_counters(std::size_t method) override;

    Renderer& renderer(std::size_t method) { return *renderers_[method]; }

  private:
    std::vector<std::unique_ptr<Renderer>> renderers_;
    CameraRecord camera_{};
};

}  // namespace tarn
