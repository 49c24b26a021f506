// Market stalls: timber frames with cloth roofs, a counter, goods of three kinds, and a row of lanterns each.
#include "content/court.h"

namespace tarn::content {
namespace {

constexpr float HALF_WIDTH = 1.35f, HALF_DEPTH = 0.95f;
constexpr float COUNTER_M = 0.9f;

// A stall faces local +z.
Shape make_timber() {
    Shape shape;
    for (const float x : {-HALF_WIDTH, HALF_WIDTH}) {
        append(shape, make_box({x - 0.05f, 0, HALF_DEPTH - 0.05f}, {x + 0.05f, 2.18f, HALF_DEPTH + 0.05f}));
        append(shape, make_box({x - 0.05f, 0, -HALF_DEPTH - 0.05f}, {x + 0.05f, 2.62f, -HALF_DEPTH + 0.05f}));
    }
    append(shape, make_box({-HALF_WIDTH - 0.1f, 2.1f, HALF_DEPTH - 0.04f},
                           {HALF_WIDTH + 0.1f, 2.17f, HALF_DEPTH + 0.04f}));
    append(shape, make_box({-HALF_WIDTH - 0.1f, 2.54f, -HALF_DEPTH - 0.04f},
                           {HALF_WIDTH + 0.1f, 2.61f, -HALF_DEPTH + 0.04f}));
    append(shape,
           make_box({-HALF_WIDTH, 1.35f, -HALF_DEPTH - 0.02f}, {HALF_WIDTH, 1.41f, -HALF_DEPTH + 0.35f}));
    return shape;
}

Shape make_counter() {
    Shape shape = make_box({-HALF_WIDTH - 0.12f, COUNTER_M - 0.06f, -0.05f},
                           {HALF_WIDTH + 0.12f, COUNTER_M, HALF_DEPTH + 0.18f});
    append(shape, make_box({-HALF_WIDTH + 0.06f, 0.06f, 0.05f},
                           {HALF_WIDTH - 0.06f, COUNTER_M - 0.05f, HALF_DEPTH + 0.0f}));
    return shape;
}

// A grid of points turned into a cloth with smooth normals; uv in cloth widths. `at` is a function of (u, v)
// in [0, 1].
template <class Surface>
void append_cloth(Shape& shape, int columns, int rows, float repeats, const Surface& at) {
    const auto base = static_cast<std::uint32_t>(shape.positions.size());
    constexpr float STEP = 1.0f / 64.0f;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const float u = static_cast<float>(column) / static_cast<float>(columns),
                        v = static_cast<float>(row) / static_cast<float>(rows);
            shape.positions.push_back(at(u, v));
            shape.normals.push_back(glm::normalize(
                glm::cross(at(u + STEP, v) - at(u - STEP, v), at(u, v - STEP) - at(u, v + STEP))));
            shape.uvs.emplace_back(repeats * u, v);
        }
    }
    const auto stride = static_cast<std::uint32_t>(columns + 1);
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
        for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(columns); ++column) {
            const std::uint32_t a = base + row * stride + column;
            shape.triangles.emplace_back(a, a + stride, a + stride + 1);
            shape.triangles.emplace_back(a, a + stride + 1, a + 1);
        }
    }
}

// Sagging roof from the high back to the low front, and a valance along the front.
Shape make_cloth_roof() {
    Shape shape;
    const float half = HALF_WIDTH + 0.2f;
    const auto roof = [&](float u, float v) {
        const float sag = 0.14f * (4.0f * v * (1.0f - v)) * (0.6f + 0.4f * 4.0f * u * (1.0f - u));
        return glm::vec3(half * (2.0f * u - 1.0f), 2.66f - 0.44f * v - sag,
                         -HALF_DEPTH - 0.1f + (2.0f * HALF_DEPTH + 0.5f) * v);
    };
    append_cloth(shape, 12, 8, 3.0f, roof);
    const auto valance = [&](float u, float v) {
        const float ripple = static_cast<float>(0.025 * sine(2.0 * PI * 6.0 * u));
        const float scallop = 0.2f + 0.07f * static_cast<float>(cosine(2.0 * PI * 6.0 * u));
        return glm::vec3(half * (2.0f * u - 1.0f), 2.22f - scallop * v, HALF_DEPTH + 0.4f + ripple * v);
    };
    append_cloth(shape, 36, 2, 3.0f, valance);
    return shape;
}

// Fruit heaped in a shallow box.
void append_heap(Shape& wood, Shape& fruit, const glm::vec3& place, const Random& random,
                 std::uint64_t index) {
    const glm::mat4 moved = move_by(place) * turn_x(0.2);
    append(wood, make_box({-0.25f, 0.006f, -0.19f}, {0.25f, 0.03f, 0.19f}), moved);
    for (const float side : {-1.0f, 1.0f}) {
        append(wood, make_box({side * 0.25f - 0.012f, 0.0f, -0.196f}, {side * 0.25f + 0.012f, 0.13f, 0.196f}),
               moved);
        append(wood,
               make_box({-0.24f, -0.006f, side * 0.19f - 0.012f}, {0.24f, 0.125f, side * 0.19f + 0.012f}),
               moved);
    }
    const Shape ball = make_sphere(0.052f, 6, 4);
    for (int i = 0; i < 16; ++i) {
        const bool upper = i >= 12;
        const int column = upper ? (i - 12) % 4 : i % 4, row = upper ? (i - 12) / 4 : i / 4;
        const auto dimension = static_cast<std::uint64_t>(i);
        const glm::vec3 jitter(random.between(-0.012f, 0.012f, index, 2 * dimension), 0,
                               random.between(-0.012f, 0.012f, index, 2 * dimension + 1));
        const glm::vec3 spot(0.11f * (static_cast<float>(column) - 1.5f), upper ? 0.155f : 0.08f,
                             0.11f * (static_cast<float>(row) - (upper ? 0.5f : 1.0f)));
        append(fruit, ball, moved * move_by(spot + jitter) * turn_x(1.3 * i));
    }
}

struct StallParts {
    Shape planks, dark, clay, brass;
    std::array<Shape, 4> fruit;
    std::array<Shape, 4> cloth;
};

void append_fruit_goods(StallParts& parts, const Random& random) {
    for (int i = 0; i < 4; ++i) {
        const float x = -0.99f + 0.66f * static_cast<float>(i);
        append_heap(parts.dark, parts.fruit[i], {x, COUNTER_M + 0.045f, 0.75f}, random, 10 + i);
        append_heap(parts.dark, parts.fruit[(i + 2) % 4], {x, COUNTER_M + 0.045f, 0.27f}, random, 20 + i);
    }
}

void append_pottery(StallParts& parts, const Random& random) {
    const Shape vase = make_lathe({{0, 0},
                                   {0.07f, 0},
                                   {0.12f, 0.1f},
                                   {0.11f, 0.2f},
                                   {0.05f, 0.28f},
                                   {0.07f, 0.34f},
                                   {0.045f, 0.34f},
                                   {0.03f, 0.28f},
                                   {0, 0.1f}},
                                  14);
    const Shape bowl =
        make_lathe({{0, 0}, {0.06f, 0}, {0.15f, 0.09f}, {0.14f, 0.1f}, {0.05f, 0.025f}, {0, 0.02f}}, 16);
    for (int i = 0; i < 16; ++i) {
        const auto index = static_cast<std::uint64_t>(40 + i);
        const bool shelf = i >= 9;
        const glm::vec3 place(
            shelf ? -1.1f + 0.36f * static_cast<float>(i - 9) : -1.2f + 0.3f * static_cast<float>(i),
            shelf ? 1.41f : COUNTER_M, shelf ? -HALF_DEPTH + 0.17f : random.between(0.25f, 0.9f, index, 0));
        const glm::mat4 placed = move_by(place) * stretch(glm::vec3(random.between(0.8f, 1.15f, index, 1)));
        append(i % 3 == 2 ? parts.brass : parts.clay, i % 2 == 0 ? vase : bowl, placed);
    }
}

void append_textiles(StallParts& parts) {
    const Shape roll = make_tube({{-0.42f, 0, 0}, {0.42f, 0, 0}}, 0.075f, 12);
    for (int i = 0; i < 9; ++i) {
        const float x = -0.9f + 0.9f * static_cast<float>(i % 3),
                    z = 0.3f + 0.18f * static_cast<float>(i / 3);
        append(parts.cloth[i % 4], roll, move_by({x, COUNTER_M + 0.076f, z}));
    }
    for (int i = 0; i < 5; ++i) {
        const float x = -1.05f + 0.52f * static_cast<float>(i);
        append_cloth(parts.cloth[(i + 1) % 4], 8, 6, 1.0f, [&](float u, float v) {
            const double fold = 0.03 * sine(2.0 * PI * 2.0 * u) * (0.4 + v);
            return glm::vec3(x - 0.2f + 0.4f * u, 2.5f - 1.0f * v,
                             -HALF_DEPTH + 0.09f + static_cast<float>(fold));
        });
    }
}

int add_stall_mesh(GltfWriter& writer, const CourtMaterials& m, int kind, int color, const Random& random) {
    StallParts parts;
    parts.planks = make_counter();
    parts.dark = make_timber();
    parts.cloth[color] = make_cloth_roof();
    if (kind == 0) append_fruit_goods(parts, random);
    if (kind == 1) append_pottery(parts, random);
    if (kind == 2) append_textiles(parts);
    std::vector<Part> used = {{parts.planks, m.planks}, {parts.dark, m.dark_wood}};
    const auto use = [&](const Shape& shape, int material) {
        if (!shape.positions.empty()) used.push_back({shape, material});
    };
    use(parts.clay, m.terracotta);
    use(parts.brass, m.brass);
    for (int i = 0; i < 4; ++i) use(parts.cloth[i], m.cloth[i]), use(parts.fruit[i], m.fruit[i]);
    return writer.add_mesh("stall " + std::to_string(kind), used);
}

// Six small lanterns below the front of the roof.
int add_stall_lanterns(GltfWriter& writer, const CourtMaterials& m, int color) {
    Shape glow[2], frame;
    for (int i = 0; i < 6; ++i) {
        const glm::mat4 place = move_by({-1.25f + 0.5f * static_cast<float>(i), 1.86f, HALF_DEPTH + 0.12f});
        append(glow[i % 2], make_lathe({{0.04f, 0}, {0.075f, 0.07f}, {0.04f, 0.14f}}, 5), place);
        append(frame, make_lathe({{0, -0.012f}, {0.05f, -0.002f}, {0, 0.01f}}, 5), place);
        append(frame, make_lathe({{0, 0.13f}, {0.05f, 0.142f}, {0, 0.16f}}, 5), place);
        append(frame, make_tube({{0, 0.15f, 0}, {0, 0.4f, -0.06f}}, 0.006f, 3), place);
    }
    return writer.add_mesh("stall lanterns",
                           {{glow[0], m.glow[0]}, {glow[1], m.glow[color]}, {frame, m.dark_wood}});
}

}  // namespace

void add_stalls(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    struct Spot {
        float x, z;
        double turn_rad;
        int kind, color;
    };
    constexpr Spot SPOTS[] = {{-9.2f, -7.6f, 0.35, 0, 0}, {-4.6f, -8.8f, 0.1, 1, 1},
                              {0.2f, -9.0f, 0.0, 2, 2},   {5.2f, -8.6f, -0.15, 0, 3},
                              {11.2f, -6.2f, -0.9, 1, 0}, {11.6f, 3.0f, -1.6, 2, 1},
                              {-8.8f, 8.4f, 2.6, 0, 2},   {0.8f, 9.3f, 3.14, 1, 3}};
    for (const Spot& spot : SPOTS) {
        const Placement place{{spot.x, 0, spot.z}, rotate_about({0, 1, 0}, spot.turn_rad)};
        writer.add_node("stall", place, add_stall_mesh(writer, m, spot.kind, spot.color, random));
        writer.add_node("stall lanterns", place,
                        add_stall_lanterns(writer, m, (spot.color * 2 + 1) % COLORS));
    }
}

}  // namespace tarn::content
