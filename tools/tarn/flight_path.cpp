#include "flight_path.h"

#include <algorithm>
#include <cmath>

#include "core/data_files.h"
#include "core/error.h"
#include "scene/pose.h"
#include "world/world.h"

namespace tarn {
namespace {

constexpr DataFolder FLYTHROUGHS = {"flythroughs", "TARN_FLYTHROUGH_DIR", TARN_FLYTHROUGH_DIR};
constexpr const char* DEFAULT_PATH = "lantern_court";
constexpr double ORBIT_S = 8.0;
constexpr int ORBIT_KEYS = 16;
constexpr double ORBIT_FOV_DEG = 45.0;
constexpr double KEYS_PER_S = 8.0;  // of an animated camera
constexpr int MAX_KEYS = 1024;

bool is_bare_name(const std::filesystem::path& path) {
    return !std::filesystem::is_regular_file(path) && !path.has_parent_path() && !path.has_extension();
}

// Whether an animation moves the node or what carries it.
bool is_animated(const Scene& scene, NodeIndex node) {
    for (std::size_t steps = 0; node.is_set() && steps <= scene.nodes.size(); ++steps) {
        for (const Animation& animation : scene.animations) {
            for (const AnimationChannel& channel : animation.channels) {
                if (channel.node == node) return true;
            }
        }
        node = at(scene.nodes, node).parent;
    }
    return false;
}

double animation_duration_s(const Scene& scene) {
    double duration_s = 0.0;
    for (const Animation& animation : scene.animations)
        duration_s = std::max(duration_s, animation.duration_s);
    return duration_s;
}

FlightPath follow_camera(const Scene& scene, const Camera& camera, double distance_m) {
    FlightPath result{{camera.name.empty() ? "camera" : camera.name, {}, animation_duration_s(scene), {}, {}},
                      fmt::format("the way of its camera '{}'", camera.name)};
    const int keys = std::clamp(int(std::ceil(result.path.duration_s * KEYS_PER_S)) + 1, 2, MAX_KEYS);
    for (int i = 0; i < keys; ++i) {
        CameraKey key;
        key.time_s = result.path.duration_s * i / (keys - 1);
        const Pose pose = evaluate_pose(scene, key.time_s);
        const glm::dmat4& placement = at(pose.world_from_node, camera.node);
        key.position_ws = glm::dvec3(placement[3]);
        key.target_ws = key.position_ws - glm::normalize(glm::dvec3(placement[2])) * distance_m;
        key.vertical_fov_deg = glm::degrees(camera.vertical_fov_rad);
        result.path.keys.push_back(key);
    }
    return result;
}

double bounding_radius_m(const World& world) {
    return world.bounds.empty() ? 1.0 : std::max(1e-6, 0.5 * glm::length(glm::dvec3(world.bounds.extent())));
}

// Once around, from a little above and outside of the bounding sphere, which fits the narrower side of the
// picture.
FlightPath orbit(const World& world, double aspect) {
    FlightPath result{{"orbit", {}, ORBIT_S, {}, {}}, "an orbit of its bounds"};
    const glm::dvec3 centre_ws =
        (world.bounds.empty() ? glm::dvec3(0.0) : glm::dvec3(world.bounds.centre())) + world.origin_ws;
    const double half = std::atan(std::tan(glm::radians(0.5 * ORBIT_FOV_DEG)) * std::min(1.0, aspect));
    const double distance_m = bounding_radius_m(world) / std::sin(half);
    for (int i = 0; i <= ORBIT_KEYS; ++i) {
        const double angle = glm::radians(360.0) * i / ORBIT_KEYS;
        const glm::dvec3 direction = glm::normalize(glm::dvec3(std::sin(angle), 0.32, std::cos(angle)));
        result.path.keys.push_back(
            {ORBIT_S * i / ORBIT_KEYS, centre_ws + direction * distance_m, centre_ws, ORBIT_FOV_DEG});
    }
    return result;
}

}  // namespace

std::optional<FlightPath> find_path_file(const std::string& option, const std::filesystem::path& scene) {
    const std::string name = option.empty() && scene.empty() ? DEFAULT_PATH : option;
    if (!name.empty()) {
        const std::filesystem::path file =
            is_bare_name(name) ? locate_data_file(FLYTHROUGHS, name + ".json") : std::filesystem::path(name);
        return FlightPath{load_camera_path(file), file.string()};
    }
    if (is_bare_name(scene)) {
        const auto own = find_data_file(FLYTHROUGHS, scene.string() + ".json");
        if (own) return FlightPath{load_camera_path(*own), own->string()};
    }
    std::filesystem::path beside = scene;
    beside.replace_extension(".flythrough.json");
    if (std::filesystem::is_regular_file(beside))
        return FlightPath{load_camera_path(beside), beside.string()};
    return std::nullopt;
}

FlightPath make_flight_path(const Scene& scene, const World& world, double aspect) {
    for (const Camera& camera : scene.cameras) {
        if (animation_duration_s(scene) <= 0.0) break;
        if (camera.orthographic || !is_animated(scene, camera.node)) continue;
        return follow_camera(scene, camera, bounding_radius_m(world));
    }
    return orbit(world, aspect);
}

}  // namespace tarn
