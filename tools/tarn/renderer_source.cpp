#include "renderer_source.h"

namespace tarn {

RendererSource::RendererSource(World& world, const RayTracer& tracer, int width_px, int height_px,
                               std::size_t method_count) {
    for (std::size_t i = 0; i < method_count; ++i) {
        renderers_.push_back(std::make_unique<Renderer>(world, tracer, width_px, height_px));
    }
}

void RendererSource::update() {
    for (const auto& renderer : renderers_) renderer->update();
}

RenderedFrame RendererSource::render(std::size_t method, const RenderSettings& settings, std::uint32_t seed,
                                     std::uint32_t frame, bool starts) {
    if (starts) renderers_[method]->reset_history();
    FrameInput input;
    input.camera = camera_;
    input.frame = frame;
    input.seed = seed;
    input.settings = settings;
    const FrameOutput output = renderers_[method]->render(input);
    return {renderers_[method]->read_radiance(output.radiance), output.timings, output.shadow_rays.traced};
}

std::map<std::string, std::uint64_t> RendererSource::read_counters(std::size_t method) {
    return renderers_[method]->read_counters();
}

}  // namespace tarn
