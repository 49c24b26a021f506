#include "level.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "../vectors.h"
#include "crate_places.h"
#include "hash.h"

namespace game {
namespace {

constexpr double LANTERN_LIMIT_M = 1.0;  // what is larger is no lantern
constexpr int LANTERNS_PER_DEAD = 3;
constexpr int COURT_FIREFLIES = 60;

void add_point(Box& box, const Vec3& point) {
    box.lower = {std::min(box.lower.x, point.x), std::min(box.lower.y, point.y),
                 std::min(box.lower.z, point.z)};
    box.upper = {std::max(box.upper.x, point.x), std::max(box.upper.y, point.y),
                 std::max(box.upper.z, point.z)};
}

constexpr Box EMPTY_BOX = {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = length(cross(b - a, c - a));
    return area > 1e-8 && std::isfinite(area);
}

void add_solid(Level& level, const Triangles& part) {
    for (std::size_t i = 0; i + 2 < part.corners.size(); i += 3) {
        const Vec3 &a = part.corners[i], &b = part.corners[i + 1], &c = part.corners[i + 2];
        if (!has_area(a, b, c)) continue;
        std::array<float, 9> triangle;
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3 p = part.corners[i + std::size_t(corner)] - level.origin;
            triangle[3 * corner] = float(p.x);
            triangle[3 * corner + 1] = float(p.y);
            triangle[3 * corner + 2] = float(p.z);
            add_point(level.bounds, part.corners[i + std::size_t(corner)]);
        }
        level.triangles.push_back(triangle);
    }
}

bool shines(const Scene& scene, Node node) {
    for (const std::size_t material : scene.materials(node)) {
        const Vec3 emission = scene.surface(material).emission;
        if (emission.x + emission.y + emission.z > 0.0) return true;
    }
    return false;
}

// Small things that shine and stand still.
std::vector<Lantern> find_lanterns(const Scene& scene, const std::vector<Triangles>& parts) {
    std::map<std::uint32_t, Box> boxes;
    for (const Triangles& part : parts) {
        if (part.is_animated) continue;
        Box& box = boxes.try_emplace(part.node.index, EMPTY_BOX).first->second;
        for (const Vec3& corner : part.corners) add_point(box, corner);
    }
    std::vector<Lantern> lanterns;
    for (const auto& [index, box] : boxes) {
        const Vec3 extent = box.upper - box.lower;
        if (!(std::max({extent.x, extent.y, extent.z}) <= LANTERN_LIMIT_M)) continue;
        if (!shines(scene, Node{index})) continue;
        lanterns.push_back({Node{index}, (box.lower + box.upper) * 0.5, false});
        lanterns.back().is_dead = lanterns.size() % LANTERNS_PER_DEAD == 0;
    }
    return lanterns;
}

// A person stands upright: what rolls or looks straight down keeps its heading alone.
void place_start(Level& level, const Camera& camera) {
    const Vec3 forward = normalize(camera.forward);
    const bool is_vertical = std::abs(forward.y) > 0.999999;
    const Vec3 heading = is_vertical ? camera.up * (forward.y > 0.0 ? -1.0 : 1.0) : forward;
    level.start_eye = camera.position;
    level.start_yaw_rad = std::atan2(-heading.x, -heading.z);
    level.start_pitch_rad = std::asin(std::clamp(forward.y, -1.0, 1.0));
    if (!camera.orthographic) level.half_height = camera.half_height;
}

}  // namespace

Level make_level(const Scene& scene) {
    Level level;
    const Box bounds = scene.bounds();
    if (bounds.lower.x <= bounds.upper.x) {
        const Vec3 centre = (bounds.lower + bounds.upper) * 0.5;
        level.origin = {std::floor(centre.x), std::floor(centre.y), std::floor(centre.z)};
    }
    level.bounds = EMPTY_BOX;
    const std::vector<Triangles> parts = scene.triangles();
    for (const Triangles& part : parts) {
        if (!part.is_animated && !part.has_holes) add_solid(level, part);
    }
    place_start(level, scene.default_camera(16.0 / 9.0));
    level.lanterns = find_lanterns(scene, parts);
    level.crates = find_crate_places(scene.name(), level);
    if (scene.name() == "lantern_court") level.fireflies = COURT_FIREFLIES;
    return level;
}

std::uint64_t compute_hash(const Level& level) {
    Hash hash;
    for (const std::array<float, 9>& triangle : level.triangles) {
        for (const float value : triangle) hash.add(value);
    }
    for (const Vec3& point : {level.origin, level.start_eye}) {
        for (const double value : {point.x, point.y, point.z}) hash.add(value);
    }
    hash.add(level.start_yaw_rad);
    hash.add(level.start_pitch_rad);
    for (const CratePlace& crate : level.crates) {
        for (const double value : {crate.above.x, crate.above.y, crate.above.z, crate.yaw_rad})
            hash.add(value);
    }
    return hash.value();
}

}  // namespace game
