// Any number of small emissive triangles above a floor with pillars; their total power does not depend on the
// number.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "content/portable_math.h"
#include "content/scenes.h"
#include "core/error.h"
#include "shared/math/colour.h"

namespace tarn::content {
namespace {

constexpr float HALF_FLOOR_M = 20.0f;
constexpr int MAX_COUNT = 1000000;
constexpr float DRIFT_M = 0.6f;  // how far a drifting light comes from its place at most, or little more
constexpr std::size_t GROUP_SIZE = 100;
constexpr double TOTAL_POWER = 8000.0;  // luminous sum of pi * area * radiance over all triangles

// Hues of the lights; each is scaled to luminance 1.
constexpr glm::vec3 HUES[] = {{1.0f, 0.75f, 0.45f}, {1.0f, 0.55f, 0.2f}, {1.0f, 0.25f, 0.15f},
                              {1.0f, 0.9f, 0.7f},   {0.35f, 0.7f, 1.0f}, {0.2f, 0.4f, 1.0f},
                              {0.3f, 1.0f, 0.45f},  {0.9f, 0.3f, 1.0f},  {1.0f, 0.35f, 0.6f},
                              {0.3f, 1.0f, 0.9f},   {0.8f, 1.0f, 0.3f},  {1.0f, 1.0f, 1.0f}};
constexpr int HUE_COUNT = std::size(HUES);
constexpr double TINTED_SATURATION = 0.5;

struct Box {
    glm::vec3 lower, upper;
};

// Pillars and boxes on a jittered 8 x 8 grid, its four middle cells left free for the camera's view.
std::vector<Box> place_boxes(const Random& random) {
    std::vector<Box> boxes;
    for (int cell = 0; cell < 64; ++cell) {
        const int column = cell % 8, row = cell / 8;
        if ((column == 3 || column == 4) && (row == 3 || row == 4)) continue;
        const auto index = static_cast<std::uint64_t>(cell);
        const bool pillar = random.unit(index, 0) < 0.5f;
        const glm::vec3 centre(4.6f * (column - 3.5f) + random.between(-0.9f, 0.9f, index, 1), 0,
                               4.6f * (row - 3.5f) + random.between(-0.9f, 0.9f, index, 2));
        const float low = pillar ? 0.25f : 0.4f, high = pillar ? 0.4f : 1.1f;
        const glm::vec3 half(random.between(low, high, index, 3), 0, random.between(low, high, index, 4));
        const float height =
            pillar ? random.between(3.0f, 4.5f, index, 5) : random.between(0.5f, 2.0f, index, 5);
        boxes.push_back({centre - half, centre + half + glm::vec3(0, height, 0)});
    }
    return boxes;
}

bool is_clear(const glm::vec3& p, float margin, const std::vector<Box>& boxes) {
    for (const Box& box : boxes) {
        if (glm::all(glm::greaterThan(p, box.lower - margin)) &&
            glm::all(glm::lessThan(p, box.upper + margin))) {
            return false;
        }
    }
    return true;
}

// A place between 0.3 and 4 m above the floor, outside all boxes (or the last of 16 tries).
glm::vec3 place_light(const Random& random, std::uint64_t index, float margin,
                      const std::vector<Box>& boxes) {
    glm::vec3 place(0.0f);
    for (std::uint64_t attempt = 0; attempt < 16; ++attempt) {
        const std::uint64_t dimension = 8 + 3 * attempt;
        place = {random.between(-19.0f, 19.0f, index, dimension),
                 random.between(0.3f, 4.0f, index, dimension + 1),
                 random.between(-19.0f, 19.0f, index, dimension + 2)};
        if (is_clear(place, margin, boxes)) break;
    }
    return place;
}

// Equilateral, freely turned.
void append_light(Shape& shape, const Random& random, std::uint64_t index, const glm::vec3& place,
                  float side) {
    const glm::vec3 normal = random.direction(index, 0);
    const glm::vec3 start = random.direction(index, 2);
    const glm::vec3 helper = std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 across = glm::cross(normal, start);
    const glm::vec3 u =
        glm::normalize(glm::dot(across, across) > 0.01f ? across : glm::cross(normal, helper));
    const glm::vec3 v = glm::cross(normal, u);
    const float radius = side * 0.57735027f;
    const auto base = static_cast<std::uint32_t>(shape.positions.size());
    shape.positions.push_back(place + radius * u);
    shape.positions.push_back(place + radius * (-0.5f * u + 0.8660254f * v));
    shape.positions.push_back(place + radius * (-0.5f * u - 0.8660254f * v));
    shape.normals.insert(shape.normals.end(), 3, normal);
    shape.triangles.push_back(base + glm::uvec3(0, 1, 2));
}

// What all lights of a scene have in common.
struct Lights {
    Random random;
    std::vector<Box> boxes;
    float side = 0.0f;
    std::vector<int> materials;  // one a hue
};

// Of luminance 1.
glm::vec3 colour_of(int hue, double saturation) {
    return glm::mix(glm::vec3(1.0f), HUES[hue] / luminance(HUES[hue]), static_cast<float>(saturation));
}

Lights make_lights(GltfWriter& writer, const SceneOptions& options, const std::vector<Box>& boxes) {
    const int count = options.count;
    const double side = 0.12 * std::sqrt(std::sqrt(1000.0 / count));
    const double area = side * side * 0.4330127018922193;
    const double radiance = TOTAL_POWER / (PI * area * count);
    Lights lights{Random(options.seed), boxes, static_cast<float>(side), {}};
    for (int hue = 0; hue < std::min(count, HUE_COUNT); ++hue) {
        MaterialSpec spec;
        spec.name = "light " + std::to_string(hue);
        spec.base_color = glm::vec3(0.0f);
        spec.specular = 0.0f;
        spec.radiance = colour_of(hue, options.saturation) * static_cast<float>(radiance);
        lights.materials.push_back(writer.add_material(spec));
    }
    return lights;
}

glm::vec3 place_light(const Lights& lights, int light, float margin) {
    return place_light(lights.random, static_cast<std::uint64_t>(light), margin, lights.boxes);
}

void append_light(Shape& shape, const Lights& lights, int light, const glm::vec3& place) {
    append_light(shape, lights.random, static_cast<std::uint64_t>(light), place, lights.side);
}

// Lights from `first` on, which stand still: one mesh, one part for each hue that is used.
void add_still_lights(GltfWriter& writer, const Lights& lights, int first, int count) {
    std::vector<Part> parts;
    for (const int material : lights.materials) parts.push_back({{}, material});
    for (int i = first; i < count; ++i) {
        append_light(parts[i % HUE_COUNT].shape, lights, i, place_light(lights, i, lights.side));
    }
    std::erase_if(parts, [](const Part& part) { return part.shape.triangles.empty(); });
    if (!parts.empty()) writer.add_node("lights", {}, writer.add_mesh("lights", parts));
}

// Lets a node drift round a tilted ellipse and back to where it stands.
void drift(GltfWriter& writer, int node, const Random& random, std::uint64_t group) {
    const glm::vec3 across = random.direction(group, 64), along = random.direction(group, 66);
    const glm::vec3 flat(0.5f * DRIFT_M, 0.25f * DRIFT_M, 0.5f * DRIFT_M);
    const glm::vec3 a = across * flat, b = along * flat;
    writer.animate_translation(node, Motion::CUBIC, {0.0f, 2.0f, 4.0f, 6.0f, 8.0f},
                               {glm::vec3(0.0f), a + b, 2.0f * a, a - b, glm::vec3(0.0f)});
}

// Interleaves the bits of a place in the hall, so that successive codes are near each other.
std::uint32_t morton_code(const glm::vec3& place) {
    const glm::vec3 share = (place - glm::vec3(-HALF_FLOOR_M, 0, -HALF_FLOOR_M)) / (2 * HALF_FLOOR_M);
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::uint32_t>(std::clamp(share[axis], 0.0f, 0.999f) * 1024.0f);
        for (int bit = 0; bit < 10; ++bit) code |= (cell >> bit & 1u) << (3 * bit + axis);
    }
    return code;
}

// The first `count` lights, in swarms of neighbours of one hue that drift each on its own.
void add_drifting_lights(GltfWriter& writer, const Lights& lights, int count) {
    struct Placed {
        std::uint32_t code;
        int light;
        glm::vec3 place;
    };
    std::vector<Placed> placed;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 place = place_light(lights, i, lights.side + DRIFT_M);
        placed.push_back({morton_code(place), i, place});
    }
    std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
        return std::tie(a.code, a.light) < std::tie(b.code, b.light);
    });
    for (std::size_t first = 0, group = 0; first < placed.size(); first += GROUP_SIZE, ++group) {
        Part part{{}, lights.materials[group % lights.materials.size()]};
        for (std::size_t i = first; i < std::min(first + GROUP_SIZE, placed.size()); ++i) {
            append_light(part.shape, lights, placed[i].light, placed[i].place);
        }
        const std::string name = "drifting lights " + std::to_string(group);
        drift(writer, writer.add_node(name, {}, writer.add_mesh(name, {part})), lights.random, group);
    }
}

int count_moving(const SceneOptions& options) {
    if (!(options.moving_percent >= 0.0 && options.moving_percent <= 100.0)) {
        throw Error("many_lights: moving is {} %, must be 0 to 100", options.moving_percent);
    }
    return static_cast<int>(std::ceil(options.count * options.moving_percent / 100.0));
}

}  // namespace

void build_many_lights(GltfWriter& writer, const SceneOptions& options) {
    if (options.count < 1 || options.count > MAX_COUNT) {
        throw Error("many_lights: count is {}, must be 1 to {}", options.count, MAX_COUNT);
    }
    if (!(options.saturation >= 0.0 && options.saturation <= 1.0)) {
        throw Error("many_lights: saturation is {}, must be 0 to 1", options.saturation);
    }
    MaterialSpec stone;
    stone.name = "stone";
    stone.base_color = glm::vec3(0.45f);
    stone.roughness = 0.6f;
    MaterialSpec floor = stone;
    floor.name = "floor";
    floor.base_color = {0.32f, 0.3f, 0.28f};
    floor.roughness = 0.35f;
    const glm::vec3 corner(-HALF_FLOOR_M, 0, HALF_FLOOR_M);
    const Shape plane = make_quad(corner, {2 * HALF_FLOOR_M, 0, 0}, {0, 0, -2 * HALF_FLOOR_M});
    writer.add_node("floor", {}, writer.add_mesh("floor", {{plane, writer.add_material(floor)}}));

    const std::vector<Box> boxes = place_boxes(Random(options.seed + 1));
    Shape blocks;
    for (const Box& box : boxes) append(blocks, make_box(box.lower, box.upper));
    writer.add_node("boxes", {}, writer.add_mesh("boxes", {{blocks, writer.add_material(stone)}}));
    const Lights lights = make_lights(writer, options, boxes);
    const int moving = count_moving(options);
    add_still_lights(writer, lights, moving, options.count);
    add_drifting_lights(writer, lights, moving);
    writer.add_camera("main", {0.0f, 5.5f, 17.5f}, {0.0f, 0.8f, 0.0f}, 55.0);
}

// One light of each hue: shadows of many colours, and few enough that means converge in seconds.
void build_coloured_lights(GltfWriter& writer, const SceneOptions& options) {
    SceneOptions few = options;
    few.count = HUE_COUNT;
    few.moving_percent = 0.0;
    build_many_lights(writer, few);
}

// The same with hues of coloured lamps, not of lasers: between white and the pure ones.
void build_tinted_lights(GltfWriter& writer, const SceneOptions& options) {
    SceneOptions tinted = options;
    tinted.saturation = TINTED_SATURATION;
    build_coloured_lights(writer, tinted);
}

}  // namespace tarn::content
