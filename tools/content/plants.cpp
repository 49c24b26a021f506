// Trees in planters, potted shrubs and ivy: trunks of tubes, leaves of alpha-masked cards.
#include <cmath>

#include "content/court.h"

namespace tarn::content {
namespace {

// A card with the leaf picture, its root at the origin, growing along +Y, facing +Z, bent a little.
Shape make_card(float size) {
    Shape shape = make_quad({-0.5f * size, 0, 0}, {size, 0, 0}, {0, size, 0.15f * size});
    return shape;
}

// Turns +Y to `direction` with a free spin about it.
glm::mat4 point_along(const glm::vec3& direction, double spin_rad) {
    const glm::vec3 helper = std::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(direction, helper)), z = glm::cross(x, direction);
    glm::mat4 matrix(1.0f);
    matrix[0] = glm::vec4(x, 0);
    matrix[1] = glm::vec4(direction, 0);
    matrix[2] = glm::vec4(z, 0);
    return matrix * turn_y(spin_rad);
}

int add_tree_mesh(GltfWriter& writer, const CourtMaterials& m, const Random& random,
                  std::uint64_t seed_index) {
    Shape bark, leaves, planter, soil;
    append(planter, make_lathe({{0, 0},
                                {0.7f, 0},
                                {0.82f, 0.5f},
                                {0.9f, 0.5f},
                                {0.9f, 0.6f},
                                {0.74f, 0.6f},
                                {0.72f, 0.48f},
                                {0, 0.48f}},
                               8));
    append(soil, make_lathe({{0.74f, 0.54f}, {0, 0.56f}}, 8));
    append(bark, make_tube({{0, 0.5f, 0}, {0.05f, 1.4f, 0.03f}, {-0.03f, 2.3f, 0.05f}}, 0.11f, 8));
    const Shape card = make_card(0.62f);
    constexpr int BRANCHES = 9, CARDS = 44;
    for (int b = 0; b < BRANCHES; ++b) {
        const std::uint64_t index = seed_index * 100 + static_cast<std::uint64_t>(b);
        const double angle = 2.0 * PI * (b + 0.6 * random.unit(index, 0)) / BRANCHES;
        const float reach = random.between(0.9f, 1.5f, index, 1), rise = random.between(0.7f, 1.9f, index, 2);
        const glm::vec3 root(-0.02f, 1.75f + 0.06f * static_cast<float>(b), 0.04f);
        const glm::vec3 tip = root + glm::vec3(reach * cosine(angle), rise, reach * sine(angle));
        const glm::vec3 middle = glm::mix(root, tip, 0.5f) + glm::vec3(0, 0.12f, 0);
        append(bark, make_tube({root, middle, tip}, 0.035f, 5));
        for (int c = 0; c < CARDS; ++c) {
            const std::uint64_t dimension = 10 + 8 * static_cast<std::uint64_t>(c);
            const float t = random.between(0.35f, 1.05f, index, dimension);
            const glm::vec3 place = glm::mix(root, tip, t) +
                                    0.34f * t * random.direction(index, dimension + 1) +
                                    glm::vec3(0, 0.08f, 0);
            const glm::vec3 outward = glm::normalize(random.direction(index, dimension + 3) +
                                                     glm::normalize(place - glm::vec3(0, 2.2f, 0)));
            append(leaves, card,
                   move_by(place) * point_along(outward, random.between(0.0f, 6.28f, index, dimension + 5)) *
                       stretch(glm::vec3(random.between(0.7f, 1.1f, index, dimension + 6))));
        }
    }
    return writer.add_mesh("tree",
                           {{bark, m.bark}, {leaves, m.leaves}, {planter, m.dressed_stone}, {soil, m.soil}});
}

int add_shrub_mesh(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    Shape pot = make_lathe({{0, 0},
                            {0.17f, 0},
                            {0.24f, 0.34f},
                            {0.28f, 0.34f},
                            {0.28f, 0.42f},
                            {0.22f, 0.42f},
                            {0.21f, 0.36f},
                            {0, 0.36f}},
                           14);
    Shape leaves;
    const Shape card = make_card(0.5f);
    for (int i = 0; i < 30; ++i) {
        const auto index = static_cast<std::uint64_t>(i) + 5000;
        const glm::vec3 direction = glm::normalize(random.direction(index, 0) + glm::vec3(0, 1.1f, 0));
        const float lift = random.between(0.36f, 0.62f, index, 2);
        append(leaves, card,
               move_by({0.12f * direction.x, lift, 0.12f * direction.z}) *
                   point_along(direction, random.between(0.0f, 6.28f, index, 3)));
    }
    return writer.add_mesh("shrub", {{pot, m.terracotta}, {leaves, m.leaves}});
}

// Ivy over an arcade wall: cards that hang before the stone, in the frame of a bay.
int add_ivy_mesh(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    Shape leaves;
    const Shape card = make_card(0.55f);
    for (int i = 0; i < 70; ++i) {
        const auto index = static_cast<std::uint64_t>(i) + 7000;
        const float u = random.between(-1.0f, 1.0f, index, 0), v = random.unit(index, 1);
        const glm::vec3 place(1.3f * u, 5.0f - 2.6f * v * v - 0.5f * std::abs(u),
                              random.between(0.43f, 0.52f, index, 2));
        const glm::vec3 direction = glm::normalize(
            glm::vec3(random.between(-0.8f, 0.8f, index, 3), -1.0f, random.between(0.05f, 0.4f, index, 4)));
        append(leaves, card, move_by(place) * point_along(direction, random.between(-0.5f, 0.5f, index, 5)));
    }
    return writer.add_mesh("ivy", {{leaves, m.leaves}});
}

}  // namespace

std::array<glm::vec3, 4> tree_places() {
    return {{{-7.2f, 0, -3.2f}, {7.0f, 0, -4.6f}, {-6.4f, 0, 5.4f}, {9.0f, 0, 0.6f}}};
}

void add_plants(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    const int trees[2] = {add_tree_mesh(writer, m, random, 1), add_tree_mesh(writer, m, random, 2)};
    int number = 0;
    for (const glm::vec3& place : tree_places()) {
        writer.add_node("tree", {place, rotate_about({0, 1, 0}, 1.3 * number)}, trees[number % 2]);
        ++number;
    }
    const int shrub = add_shrub_mesh(writer, m, random), ivy = add_ivy_mesh(writer, m, random);
    const std::array<Side, 4> sides = court_sides();
    for (int s = 0; s < 4; ++s) {
        const Side& side = sides[s];
        for (int bay = 1; bay < side.bays; bay += 2) {
            if (s == 3 && bay >= 1 && bay <= 5) continue;  // the stair stands there
            Placement place = side.bay(bay);
            place.translation += glm::vec3(turn_y(side.turn_rad) * glm::vec4(-0.5f * BAY_M, 0, 0.85f, 0));
            place.translation.y = 0.0f;
            writer.add_node("shrub", place, shrub);
        }
        for (const int bay : {1, 6}) {
            if (s != 3) writer.add_node("ivy", side.bay(bay), ivy);
        }
    }
}

}  // namespace tarn::content
