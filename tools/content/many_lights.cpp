// Any number of small emissive triangles above a floor with pillars; their total power does not depend on the
// number.
#include <cmath>

#include "content/portable_math.h"
#include "content/scenes.h"
#include "core/error.h"

namespace tarn::content {
namespace {

constexpr float HALF_FLOOR_M = 20.0f;
constexpr int MAX_COUNT = 1000000;
constexpr double TOTAL_POWER = 8000.0;  // luminous sum of pi * area * radiance over all triangles

// Hues of the lights; each is scaled to luminance 1.
constexpr glm::vec3 HUES[] = {{1.0f, 0.75f, 0.45f}, {1.0f, 0.55f, 0.2f}, {1.0f, 0.25f, 0.15f},
                              {1.0f, 0.9f, 0.7f},   {0.35f, 0.7f, 1.0f}, {0.2f, 0.4f, 1.0f},
                              {0.3f, 1.0f, 0.45f},  {0.9f, 0.3f, 1.0f},  {1.0f, 0.35f, 0.6f},
                              {0.3f, 1.0f, 0.9f},   {0.8f, 1.0f, 0.3f},  {1.0f, 1.0f, 1.0f}};
constexpr int HUE_COUNT = std::size(HUES);

float luminance(const glm::vec3& c) {
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

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

// One mesh, one part for each hue that is used.
void add_lights(GltfWriter& writer, const Random& random, int count, const std::vector<Box>& boxes) {
    const double side = 0.12 * std::sqrt(std::sqrt(1000.0 / count));
    const double area = side * side * 0.4330127018922193;
    const double radiance = TOTAL_POWER / (PI * area * count);
    std::vector<Part> parts(std::min(count, HUE_COUNT));
    for (int hue = 0; hue < static_cast<int>(parts.size()); ++hue) {
        MaterialSpec spec;
        spec.name = "light " + std::to_string(hue);
        spec.base_color = glm::vec3(0.0f);
        spec.specular = 0.0f;
        spec.radiance = HUES[hue] / luminance(HUES[hue]) * static_cast<float>(radiance);
        parts[hue].material = writer.add_material(spec);
    }
    for (int i = 0; i < count; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        const glm::vec3 place = place_light(random, index, static_cast<float>(side), boxes);
        append_light(parts[i % HUE_COUNT].shape, random, index, place, static_cast<float>(side));
    }
    writer.add_node("lights", {}, writer.add_mesh("lights", parts));
}

}  // namespace

void build_many_lights(GltfWriter& writer, const SceneOptions& options) {
    if (options.count < 1 || options.count > MAX_COUNT) {
        throw Error("many_lights: count is {}, must be 1 to {}", options.count, MAX_COUNT);
    }
    const Random random(options.seed);
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
    add_lights(writer, random, options.count, boxes);
    writer.add_camera("main", {0.0f, 5.5f, 17.5f}, {0.0f, 0.8f, 0.0f}, 55.0);
}

}  // namespace tarn::content
