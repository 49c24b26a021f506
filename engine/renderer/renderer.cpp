#include "renderer/renderer.h"

#include <algorithm>

#include "noise/blue_noise.h"
#include "passes/antialias/jitter.h"
#include "passes/indirect/coarse.h"
#include "shared/math/random.h"

namespace tarn {
namespace {

Defines join(Defines first, const Defines& second) {
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
                   Defines extra_defines)
    : world_(world),
      tracer_(tracer),
      output_px_(width_px, height_px),
      size_px_(output_px_),
      extra_defines_(std::move(extra_defines)),
      changes_{world.is_animated, world.is_animated},
      surveyed_lights_(world.lights.order_revision),
      surveyed_materials_(world.material_revision),
      gpu_scene_(world),
      frame_block_("frame/block", sizeof(FrameBlock), BufferUse::DYNAMIC),
      coarse_frame_block_("frame/coarse_block", sizeof(FrameBlock), BufferUse::DYNAMIC),
      counters_("frame/counters", COUNTER_COUNT * sizeof(std::uint32_t), BufferUse::DEVICE),
      gbuffer_(gpu_scene_) {
    counters_.clear();
    survey();
    plan_ = make_plan(survey_, {});
}

void Renderer::update() {
    gpu_scene_.update(world_);
    // A light may have come or gone, a thing have begun to move, and with it what the shaders need.
    const ChangeHistory changes{world_.is_animated || gpu_scene_.has_moved(),
                                world_.is_animated || gpu_scene_.have_lights_changed()};
    if (world_.lights.order_revision == surveyed_lights_ && world_.material_revision == surveyed_materials_ &&
        changes == changes_)
        return;
    surveyed_lights_ = world_.lights.order_revision;
    surveyed_materials_ = world_.material_revision;
    changes_ = changes;
    survey();
}

void Renderer::survey() {
    survey_ = survey_features(world_, changes_);
    scene_defines_ = join(survey_.features.defines(), extra_defines_);
}

void Renderer::fit_light_tree() {
    recorder_.pass("lights/tree").run_on_cpu([&] { update_light_tree(light_tree_, world_.lights); });
    gpu_light_tree_.update(light_tree_);
}

const RowBuffer* Renderer::find_blue_noise() {
    if (plan_.indirect.noise != NoiseKind::BLUE) return nullptr;
    if (!blue_noise_) blue_noise_.emplace("noise/blue", load_blue_noise().texels, GL_R32UI);
    return &blue_noise_->rows();
}

bool Renderer::has_moved(const CameraRecord& camera) const {
    return gpu_scene_.is_changing() || !is_same_view(camera, history_.camera);
}

FrameBlock Renderer::make_frame_block(const FrameInput& input) const {
    const CameraRecord& camera = input.camera;
    FrameBlock block;
    block.frame_camera_position = glm::vec4(camera.position, camera.orthographic ? 1.0f : 0.0f);
    block.frame_camera_right = glm::vec4(camera.right, 0.0f);
    block.frame_camera_up = glm::vec4(camera.up, 0.0f);
    block.frame_camera_forward = glm::vec4(camera.forward, depth_parameter(world_, camera));
    block.frame_size = glm::uvec4(size_px_, input.frame, input.seed);
    block.frame_lights =
        glm::uvec4(world_.lights.count, world_.environment.width, world_.environment.height, 0u);
    block.frame_previous_position =
        glm::vec4(history_.camera.position, history_.camera.orthographic ? 1.0f : 0.0f);
    block.frame_previous_right = glm::vec4(history_.camera.right, 0.0f);
    block.frame_previous_up = glm::vec4(history_.camera.up, 0.0f);
    block.frame_previous_forward = glm::vec4(history_.camera.forward, 0.0f);
    block.frame_history =
        glm::uvec4(gpu_scene_.previous_first_instance(), gpu_scene_.lights().previous_first_row(),
                   gpu_scene_.lights().remap_first_row(), gpu_scene_.have_materials_changed() ? 1u : 0u);
    block.frame_jitter = glm::vec4(find_jitter_px(input), history_.jitter_px);
    block.frame_tables =
        glm::uvec4(gpu_light_tree_.node_count(), gpu_scene_.lights().instance_lookup_first_row(),
                   gpu_scene_.lights().slot_lookup_first_row(), 0u);
    block.frame_full = glm::uvec4(size_px_, 1u, 0u);
    block.frame_offset = glm::uvec4(0u);
    return block;
}

// Whatever has the size of the frame is no history for one of another size; the picture is.
void Renderer::choose_size(const RenderSettings& settings) {
    const glm::dvec2 wanted = glm::round(glm::dvec2(output_px_) * settings.antialias.scale);
    const glm::ivec2 size_px = glm::max(glm::ivec2(wanted), glm::ivec2(1));
    if (size_px == size_px_) return;
    size_px_ = size_px;
    history_.forget_frame();
}

glm::vec2 Renderer::find_jitter_px(const FrameInput& input) const {
    // Views of surfaces show single frames, whose edges would tremble.
    if (input.display && !shows_light(input.display->choice.view)) return input.jitter_px;
    return input.jitter_px + find_jitter(input.frame, plan_.antialias.jitter_count);
}

void Renderer::upload_frame_blocks(const FrameInput& input) {
    const FrameBlock block = make_frame_block(input);
    const FrameBlock coarse = make_coarse_block(block, plan_.indirect.step_px);
    frame_block_.upload(0, std::span<const FrameBlock>(&block, 1));
    coarse_frame_block_.upload(0, std::span<const FrameBlock>(&coarse, 1));
    recorder_.bind_frame_block(frame_block_);
}

FrameOutput Renderer::render(const FrameInput& input) {
    choose_size(input.settings);
    plan_ = make_plan(survey_, input.settings, {pixel_count(), recorder_.quirks().slow_triangles});
    recorder_.begin();
    if (plan_.has_light_tree()) fit_light_tree();  // before the frame block, which counts its nodes
    upload_frame_blocks(input);
    gpu_scene_.bind(recorder_);

    RayCounts rays;
    FrameContext frame{recorder_, programs_,      tracer_,        counters_, rays,
                       plan_,     input.settings, scene_defines_, size_px_,  output_px_};
    frame.jitter_px = find_jitter_px(input);
    frame.frame = input.frame;
    frame.seed = input.seed;
    const bool follows = history_.rays && input.frame == history_.rays->key.frame + 1;
    if (follows) frame.previous = history_.rays;
    frame.has_moved = has_moved(input.camera);
    frame.scene_changed = gpu_scene_.is_changing();
    history_.paths_may_be_stale |= frame.scene_changed;
    frame.paths_may_be_stale = history_.paths_may_be_stale;

    const Values values = record_frame(frame, input);
    rejected_rays_ += rays.shadow.rejected;
    const FrameTimings timings = recorder_.end();
    radiance_ = values.radiance;
    gpu_scene_.advance(world_);
    history_.camera = input.camera;
    history_.jitter_px = frame.jitter_px;
    history_.rays = PreviousRays{tracer_.geometry_revision(), {input.frame, input.seed, RAY_SHADOW}};
    return {*radiance_,  values.display, values.gbuffer, timings,
            rays.shadow, rays.closest,   rays.camera,    gbuffer_.statistics()};
}

Image Renderer::read_radiance(const Texture2D& radiance) const {
    const std::vector<glm::vec4> texels = radiance.download<glm::vec4>();
    Image image(radiance.width_px(), radiance.height_px(), 3);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) image.values[3 * i + channel] = texels[i][channel];
    }
    return image;
}

float Renderer::read_exposure_ev() const {
    if (!exposure_) return 0.0f;
    return glm::uintBitsToFloat(exposure_->buffer().download<glm::uvec4>()[0].y);
}

std::map<std::string, std::uint64_t> Renderer::read_counters() const {
    const std::vector<std::uint32_t> values = counters_.download<std::uint32_t>();
    return {{"bad_weights", values[COUNTER_BAD_WEIGHT]},
            {"bad_radiance", values[COUNTER_BAD_RADIANCE]},
            {"bad_reservoirs", values[COUNTER_BAD_RESERVOIR]},
            {"bad_history", values[COUNTER_BAD_HISTORY]},
            {"mis_sums", values[COUNTER_MIS_SUM]},
            {"coarse_gaps", values[COUNTER_COARSE_GAP]},
            {"bad_light", values[COUNTER_BAD_LIGHT]},
            {"bad_light_history", values[COUNTER_BAD_LIGHT_HISTORY]},
            {"bad_cache", values[COUNTER_BAD_CACHE]},
            {"cache_clamped", values[COUNTER_CACHE_CLAMPED]},
            {"cache_full", values[COUNTER_CACHE_FULL]},
            {"bad_picture", values[COUNTER_BAD_PICTURE]},
            {"rejected_rays", rejected_rays_}};
}

}  // namespace tarn
