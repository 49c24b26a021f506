#include "renderer_source.h"

#include <glm/gtc/matrix_transform.hpp>

namespace tarn {

CameraRecord camera_before(const CameraRecord& arrived, const CameraMotion& motion, int lead) {
    CameraRecord camera = arrived;
    camera.position -= glm::normalize(arrived.right) * float(motion.walk_m * lead);
    const glm::mat3 turn(
        glm::rotate(glm::dmat4(1.0), glm::radians(-motion.turn_deg * lead), glm::dvec3(arrived.up)));
    camera.right = turn * arrived.right;
    camera.forward = turn * arrived.forward;
    return camera;
}

RendererSource::RendererSource(World& world, const RayTracer& tracer, int width_px, int height_px,
                               std::size_t method_count) {
    for (std::size_t i = 0; i < method_count; ++i) {
        renderers_.push_back(std::make_unique<Renderer>(world, tracer, width_px, height_px));
    }
}

void RendererSource::update() {
    for (const auto& renderer : renderers_) renderer->update();
}

void RendererSource::set_camera(const CameraRecord& camera, const CameraMotion& motion) {
    camera_ = camera;
    motion_ = motion;
}

RenderedFrame RendererSource::render(const FrameRequest& request) {
    Renderer& renderer = *renderers_[request.method];
    if (request.starts) renderer.reset_history();
    FrameInput input;
    input.camera = camera_before(camera_, motion_, request.lead);
    input.frame = request.frame;
    input.seed = request.seed;
    input.settings = request.settings;
    const FrameOutput output = renderer.render(input);
    return {renderer.read_radiance(output.radiance), output.timings, output.shadow_rays.traced};
}

std::map<std::string, std::uint64_t> RendererSource::read_counters(std::size_t method) {
    return renderers_[method]->read_counters();
}

}  // namespace tarn
