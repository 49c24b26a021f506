#include "renderer_source.h"

#include <glm/gtc/matrix_transform.hpp>

namespace tarn {

CameraRecord turn_camera(const CameraRecord& camera, double turn_deg) {
    CameraRecord turned = camera;
    const glm::mat3 turn(glm::rotate(glm::dmat4(1.0), glm::radians(turn_deg), glm::dvec3(camera.up)));
    turned.right = turn * camera.right;
    turned.forward = turn * camera.forward;
    return turned;
}

CameraRecord camera_before(const CameraRecord& arrived, const CameraMotion& motion, int lead) {
    CameraRecord camera = arrived;
    camera.position -= glm::normalize(arrived.right) * float(motion.walk_m * lead);
    return turn_camera(camera, -motion.turn_deg * lead);
}

RendererSource::RendererSource(const World& world, const RayTracer& tracer, int width_px, int height_px)
    : world_(world), tracer_(tracer), width_px_(width_px), height_px_(height_px) {}

Renderer& RendererSource::find_renderer(std::size_t method) {
    std::unique_ptr<Renderer>& renderer = renderers_[method];
    if (!renderer) renderer = std::make_unique<Renderer>(world_, tracer_, width_px_, height_px_);
    return *renderer;
}

void RendererSource::update() {
    for (const auto& [key, renderer] : renderers_) renderer->update();
}

void RendererSource::set_camera(const CameraRecord& camera, const CameraMotion& motion) {
    camera_ = camera;
    motion_ = motion;
}

RenderedFrame RendererSource::render(const FrameRequest& request) {
    Renderer& renderer = find_renderer(request.method);
    if (request.starts) renderer.reset_history();
    FrameInput input;
    input.camera = camera_before(camera_, motion_, request.lead);
    input.frame = request.frame;
    input.seed = request.seed;
    input.settings = request.settings;
    input.settings.antialias.scale *= request.resolution;
    const FrameOutput output = renderer.render(input);
    return {renderer.read_radiance(output.radiance), output.timings, output.shadow_rays.traced};
}

std::map<std::string, std::uint64_t> RendererSource::read_counters(std::size_t method) {
    return find_renderer(method).read_counters();
}

}  // namespace tarn
