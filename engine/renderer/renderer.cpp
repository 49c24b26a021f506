#include "renderer/renderer.h"

#include <algorithm>

#include "shared/interface/bindings.h"
#include "shared/interface/frame_block.h"
#include "shared/math/random.h"

namespace tarn {
namespace {

std::vector<std::string> join(std::vector<std::string> first, std::vector<std::string> second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

double scene_diameter(const World& world) {
    return world.bounds.empty() ? 1.0 : std::max(1e-6, glm::length(world.bounds.extent()));
}

bool is_same_view(const CameraRecord& a, const CameraRecord& b) {
    return a.position == b.position && a.right == b.right && a.up == b.up && a.forward == b.forward &&
           a.orthographic == b.orthographic;
}

// Near plane of a perspective camera or depth range of an orthographic one, metres. Depth is reversed and
// floating, near / distance: a near plane at 1e-9 of the scene costs no precision, and lets one stand on
// ground that reaches to the horizon.
float depth_parameter(const World& world, const CameraRecord& camera) {
    const double diameter = scene_diameter(world);
    if (!camera.orthographic) return float(1e-9 * diameter);
    const glm::dvec3 centre = world.bounds.empty() ? glm::dvec3(0.0) : world.bounds.centre();
    return float(4.0 * (diameter + glm::length(glm::dvec3(camera.position) - centre)));
}

}  // namespace

Renderer::Renderer(const World& world, const RayTracer& tracer, int width_px, int height_px,
                   std::vector<std::string> extra_defines)
    : world_(world),
      tracer_(tracer),
      width_px_(width_px),
      height_px_(height_px),
      planned_history_{world.is_animated, world.is_animated},
      plan_(make_plan(world, planned_history_)),
      extra_defines_(std::move(extra_defines)),
      defines_(join(plan_.defines(), extra_defines_)),
      planned_lights_(world.lights.order_revision),
      planned_materials_(world.material_revision),
      gpu_scene_(world),
      frame_block_("frame/block", sizeof(FrameBlock), BufferUse::DYNAMIC),
      counters_("frame/counters", COUNTER_COUNT * sizeof(std::uint32_t), BufferUse::DEVICE),
      gbuffer_(programs_, gpu_scene_, width_px, height_px),
      direct_light_(programs_, width_px, height_px) {
    counters_.clear();
}

void Renderer::update() {
    gpu_scene_.update(world_);
    update_plan();
}

// A light may have come or gone, a thing have begun to move, and with it what the shaders need.
void Renderer::update_plan() {
    const PlanHistory history{world_.is_animated || gpu_scene_.has_moved(),
                              world_.is_animated || gpu_scene_.have_lights_changed()};
    if (world_.lights.order_revision == planned_lights_ && world_.material_revision == planned_materials_ &&
        history == planned_history_)
        return;
    planned_lights_ = world_.lights.order_revision;
    planned_materials_ = world_.material_revision;
    planned_history_ = history;
    plan_ = make_plan(world_, history);
    defines_ = join(plan_.defines(), extra_defines_);
}

void Renderer::update_light_tree_for(const RenderSettings& settings) {
    if (settings.selection() != LightSelection::TREE) return;
    frame_.pass("lights/tree").run_on_cpu([&] { update_light_tree(light_tree_, world_.lights); });
    gpu_light_tree_.update(light_tree_);
}

void Renderer::upload_frame_block(const FrameInput& input) {
    const CameraRecord& camera = input.camera;
    FrameBlock block;
    block.frame_camera_position = glm::vec4(camera.position, camera.orthographic ? 1.0f : 0.0f);
    block.frame_camera_right = glm::vec4(camera.right, 0.0f);
    block.frame_camera_up = glm::vec4(camera.up, 0.0f);
    block.frame_camera_forward = glm::vec4(camera.forward, depth_parameter(world_, camera));
    block.frame_size = glm::uvec4(width_px_, height_px_, input.frame, input.seed);
    block.frame_lights =
        glm::uvec4(world_.lights.count, world_.environment.width, world_.environment.height, 0u);
    block.frame_previous_position = glm::vec4(last_camera_.position, last_camera_.orthographic ? 1.0f : 0.0f);
    block.frame_previous_right = glm::vec4(last_camera_.right, 0.0f);
    block.frame_previous_up = glm::vec4(last_camera_.up, 0.0f);
    block.frame_previous_forward = glm::vec4(last_camera_.forward, 0.0f);
    block.frame_history =
        glm::uvec4(gpu_scene_.previous_first_instance(), gpu_scene_.lights().previous_first_row(),
                   gpu_scene_.lights().remap_first_row(), 0u);
    block.frame_tables =
        glm::uvec4(gpu_light_tree_.node_count(), gpu_scene_.lights().instance_lookup_first_row(),
                   gpu_scene_.lights().slot_lookup_first_row(), 0u);
    frame_block_.upload(0, std::span<const FrameBlock>(&block, 1));
    frame_block_.bind_uniform(BLOCK_FRAME);
}

FrameOutput Renderer::render(const FrameInput& input) {
    const CoverageKey shadow_key{input.frame, input.seed, RAY_SHADOW};

    frame_.begin();
    update_light_tree_for(input.settings);
    upload_frame_block(input);
    gpu_scene_.bind();

    const GBuffer gbuffer = gbuffer_.record(frame_, world_, input.camera, defines_);
    const bool has_moved = gpu_scene_.is_changing() || !is_same_view(input.camera, last_camera_);
    const bool follows = last_frame_ && input.frame == last_frame_->key.frame + 1;
    const Texture2D& radiance =
        direct_light_.record({frame_, tracer_, gbuffer, input.settings, glm::vec3(0.0f), counters_, defines_,
                              shadow_key, follows ? last_frame_ : std::nullopt, has_moved},
                             gpu_light_tree_.rows());

    const DirectLight::Rays rays = direct_light_.take_rays();
    rejected_rays_ += rays.shadow.rejected;
    const FrameTimings timings = frame_.end();
    advance(input);
    return {radiance, gbuffer, timings, rays.shadow, rays.closest, gbuffer_.statistics()};
}

// What this frame saw becomes the past.
void Renderer::advance(const FrameInput& input) {
    gbuffer_.advance();
    gpu_scene_.advance(world_);
    direct_light_.advance();
    last_camera_ = input.camera;
    last_frame_ = PreviousRays{tracer_.geometry_revision(), {input.frame, input.seed, RAY_SHADOW}};
}

Image Renderer::read_radiance(const Texture2D& radiance) const {
    const std::vector<glm::vec4> texels = radiance.download<glm::vec4>();
    Image image(width_px_, height_px_, 3);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) image.values[3 * i + channel] = texels[i][channel];
    }
    return image;
}

std::map<std::string, std::uint64_t> Renderer::read_counters() const {
    const std::vector<std::uint32_t> values = counters_.download<std::uint32_t>();
    return {{"bad_weights", values[COUNTER_BAD_WEIGHT]},
            {"bad_radiance", values[COUNTER_BAD_RADIANCE]},
            {"bad_reservoirs", values[COUNTER_BAD_RESERVOIR]},
            {"bad_history", values[COUNTER_BAD_HISTORY]},
            {"mis_sums", values[COUNTER_MIS_SUM]},
            {"rejected_rays", rejected_rays_}};
}

}  // namespace tarn
