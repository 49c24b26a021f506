// The public scene: loading, cameras, time.
#include "tarn/scene.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "api/guard.h"
#include "api/scene_state.h"
#include "core/data_files.h"
#include "image_io/image_io.h"
#include "scene/gltf_import.h"

namespace tarn::api {
namespace {

std::string name_of_camera(const tarn::Scene& scene, std::size_t index) {
    const tarn::Camera& camera = scene.cameras[index];
    if (!camera.name.empty() || !camera.node.is_set()) return camera.name;
    return at(scene.nodes, camera.node).name;
}

// Directions with the lengths that the node gives them; make_record normalizes, as tarn::scene_camera does.
Camera describe_camera(const SceneState& state, std::size_t index) {
    const tarn::Camera& source = state.scene.cameras[index];
    if (!scene_camera(state.scene, state.world, CameraIndex(index), 1.0, state.time_s)) return {};
    const Pose pose = evaluate_pose(state.scene, state.time_s);
    const glm::dmat4& m = at(pose.world_from_node, source.node);
    Camera camera;
    camera.position = to_public(glm::dvec3(m[3]));
    camera.right = to_public(glm::dvec3(m[0]));
    camera.up = to_public(glm::dvec3(m[1]));
    camera.forward = to_public(-glm::dvec3(m[2]));
    camera.half_height = source.orthographic ? source.half_height_m : std::tan(0.5 * source.vertical_fov_rad);
    camera.orthographic = source.orthographic;
    return camera;
}

Camera view_of_whole(const World& world, double aspect) {
    const CameraRecord record = tarn::default_camera(world, aspect);
    Camera camera;
    camera.position = to_public(glm::dvec3(record.position) + world.origin_ws);
    camera.right = to_public(glm::dvec3(record.right));
    camera.up = to_public(glm::dvec3(record.up));
    camera.forward = to_public(glm::dvec3(record.forward));
    camera.half_height = glm::length(glm::dvec3(record.up));
    return camera;
}

}  // namespace

RayTracer& SceneState::find_tracer() {
    if (!tracer) tracer = create_embree_tracer(world);
    return *tracer;
}

void SceneState::update() {
    if (!is_stale) return;
    is_stale = false;
    if (is_outgrown) return build_anew();
    update_world(world, scene, time_s);
    scene.moves.clear();
    if (tracer) tracer->update(world);
    for (SceneFollower* follower : followers) follower->follow_scene();
}

// The sky stays: it is no part of the tables.
void SceneState::build_anew() {
    is_outgrown = false;
    WorldEnvironment sky = std::move(world.environment);
    WorldOptions options;
    options.time_s = time_s;
    world = build_world(scene, options);
    world.environment = std::move(sky);
    scene.moves.clear();
    world.moves_followed = scene.moves.count();
    if (!tracer) return;
    // Views hold the old one until they have let go of it.
    const std::unique_ptr<RayTracer> old = std::exchange(tracer, create_embree_tracer(world));
    for (SceneFollower* follower : followers) follower->rebuild();
}

Scene::Scene(std::shared_ptr<SceneState> state) : state_(std::move(state)) {}
Scene::Scene(Scene&& other) noexcept = default;
Scene& Scene::operator=(Scene&& other) noexcept = default;
Scene::~Scene() = default;

std::filesystem::path Scene::find_file(const std::filesystem::path& scene) {
    std::error_code ignored;
    if (std::filesystem::exists(scene, ignored) || scene.has_parent_path() || scene.has_extension())
        return scene;
    constexpr DataFolder CONTENT = {"content", "TARN_CONTENT_DIR", TARN_CONTENT_DIR};
    if (const auto own = find_data_file(CONTENT, scene.string() + ".glb")) return *own;
    throw Error(fmt::format("scene '{}' is neither a file nor a scene of Tarn's own: {}", scene.string(),
                            describe_data_places(CONTENT)));
}

Scene Scene::load(const std::filesystem::path& file, const SceneOptions& options) {
    return guard([&] {
        auto state = std::make_shared<SceneState>();
        state->scene = load_gltf(file, GltfOptions{options.scene_index});
        state->time_s = options.time_s;
        WorldOptions world_options;
        world_options.time_s = options.time_s;
        if (options.sky) world_options.environment = make_even_sky(*options.sky);
        if (!options.environment.empty()) world_options.environment = read_radiance(options.environment);
        state->world = build_world(state->scene, world_options);
        return Scene(std::move(state));
    });
}

const std::string& Scene::name() const {
    return state_->scene.name;
}

Box Scene::bounds() const {
    const World& world = state_->world;
    return {to_public(world.bounds.lower + world.origin_ws), to_public(world.bounds.upper + world.origin_ws)};
}

SceneFacts Scene::facts() const {
    const World& world = state_->world;
    SceneFacts facts;
    for (const WorldInstance& instance : world.instances)
        facts.triangles += world.meshes[instance.mesh].triangle_count;
    facts.instances = world.instances.size();
    facts.materials = state_->scene.materials.size();
    facts.textures = state_->scene.images.size();
    facts.punctual_lights = world.lights.punctual_count;
    facts.light_triangles = world.lights.count - world.lights.punctual_count;
    facts.sky_width_px = int(world.environment.width);
    facts.sky_height_px = int(world.environment.height);
    return facts;
}

std::size_t Scene::camera_count() const {
    return state_->scene.cameras.size();
}

std::string Scene::camera_name(std::size_t index) const {
    if (index >= camera_count())
        throw Error(fmt::format("camera {}: the scene has {}", index, camera_count()));
    return name_of_camera(state_->scene, index);
}

Camera Scene::camera(std::size_t index) const {
    camera_name(index);
    return guard([&] { return describe_camera(*state_, index); });
}

Camera Scene::camera(const std::string& name) const {
    std::string names;
    for (std::size_t i = 0; i < camera_count(); ++i) {
        const std::string known = camera_name(i);
        if (known == name) return camera(i);
        names += (names.empty() ? " '" : ", '") + known + "'";
    }
    throw Error(fmt::format("camera '{}': the scene has{}", name, names.empty() ? " none" : names));
}

Camera Scene::default_camera(double aspect) const {
    if (camera_count() > 0) return camera(0);
    if (!(aspect > 0.0)) throw Error(fmt::format("the picture's width / height is {}", aspect));
    return view_of_whole(state_->world, aspect);
}

double Scene::duration_s() const {
    double duration_s = 0.0;
    for (const Animation& animation : state_->scene.animations)
        duration_s = std::max(duration_s, animation.duration_s);
    return duration_s;
}

void Scene::move_to(double time_s) {
    if (!std::isfinite(time_s)) throw Error(fmt::format("the moment {} s is no finite number", time_s));
    if (time_s == state_->time_s) return;
    state_->time_s = time_s;
    state_->is_stale = true;
}

}  // namespace tarn::api
