// What stands about in the court: the fountain, puddles, a bell in its frame, barrels, crates and benches.
#include "content/court.h"

namespace tarn::content {
namespace {

// A flat irregular patch, 6 mm above the paving.
Shape make_puddle(float radius, const Random& random, std::uint64_t index) {
    constexpr int CORNERS = 22;
    Shape shape;
    std::vector<glm::vec3> rim;
    for (int i = 0; i < CORNERS; ++i) {
        const double angle = 2.0 * PI * i / CORNERS;
        const double wave = 1.0 + 0.18 * sine(2.0 * angle + 6.0 * random.unit(index, 0)) +
                            0.1 * sine(3.0 * angle + 6.0 * random.unit(index, 1));
        rim.emplace_back(radius * wave * cosine(angle), 0.006f, -0.7f * radius * wave * sine(angle));
    }
    const glm::vec3 centre(0, 0.006f, 0);
    for (int i = 0; i < CORNERS; ++i) append_polygon(shape, {centre, rim[i], rim[(i + 1) % CORNERS]});
    return shape;
}

void add_puddles(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    constexpr glm::vec2 PLACES[] = {{4.6f, 5.6f},   {-4.0f, 3.4f}, {1.5f, -5.2f}, {5.2f, 2.2f},
                                    {-7.5f, -4.5f}, {6.5f, 8.4f},  {-1.5f, 7.6f}};
    Shape shape;
    std::uint64_t index = 0;
    for (const glm::vec2& place : PLACES) {
        append(shape, make_puddle(random.between(0.5f, 1.05f, index, 2), random, index),
               move_by({place.x, 0, place.y}) * turn_y(random.between(0.0f, 6.28f, index, 3)));
        ++index;
    }
    writer.add_node("puddles", {}, writer.add_mesh("puddles", {{shape, m.puddle}}));
}

void add_bell(GltfWriter& writer, const CourtMaterials& m) {
    Shape wood, stone, rope;
    for (const float x : {-0.75f, 0.75f}) {
        append(wood, make_box({x - 0.08f, 0.2f, -0.08f}, {x + 0.08f, 2.5f, 0.08f}));
        append(stone, make_tapered_box({0.5f, 0.3f, 0.5f}, 0.8f), move_by({x, 0, 0}));
    }
    append(wood, make_box({-1.0f, 2.3f, -0.1f}, {1.0f, 2.48f, 0.1f}));
    append(wood, make_box({-1.05f, 2.55f, -0.35f}, {1.05f, 2.6f, 0.35f}));
    const Shape bell = make_lathe({{0.33f, 0.0f},
                                   {0.36f, 0.02f},
                                   {0.36f, 0.06f},
                                   {0.3f, 0.14f},
                                   {0.25f, 0.3f},
                                   {0.23f, 0.48f},
                                   {0.19f, 0.58f},
                                   {0.1f, 0.64f},
                                   {0.05f, 0.66f},
                                   {0.05f, 0.8f},
                                   {0, 0.8f}},
                                  28);
    const Shape inside = make_lathe({{0, 0.6f}, {0.2f, 0.46f}, {0.33f, 0.0f}}, 28);
    Shape brass;
    append(brass, bell, move_by({0, 1.55f, 0}));
    append(brass, inside, move_by({0, 1.55f, 0}));
    const Placement place{{9.6f, 0, -2.6f}, rotate_about({0, 1, 0}, -1.1)};
    writer.add_node(
        "bell", place,
        writer.add_mesh("bell", {{wood, m.dark_wood}, {stone, m.dressed_stone}, {brass, m.brass}}));
}

int add_barrel_mesh(GltfWriter& writer, const CourtMaterials& m) {
    const Shape staves = make_lathe({{0, 0},
                                     {0.27f, 0},
                                     {0.32f, 0.22f},
                                     {0.34f, 0.42f},
                                     {0.32f, 0.62f},
                                     {0.27f, 0.84f},
                                     {0.24f, 0.84f},
                                     {0.24f, 0.8f},
                                     {0, 0.8f}},
                                    16);
    Shape hoops;
    for (const glm::vec2 hoop : {glm::vec2(0.06f, 0.293f), glm::vec2(0.25f, 0.333f), glm::vec2(0.55f, 0.333f),
                                 glm::vec2(0.74f, 0.303f)}) {
        append(hoops,
               make_lathe({{hoop.y - 0.03f, 0}, {hoop.y, 0}, {hoop.y, 0.045f}, {hoop.y - 0.03f, 0.045f}}, 12),
               move_by({0, hoop.x, 0}));
    }
    return writer.add_mesh("barrel", {{staves, m.planks}, {hoops, m.iron}});
}

int add_crate_mesh(GltfWriter& writer, const CourtMaterials& m) {
    Shape boards = make_box({-0.27f, 0.02f, -0.27f}, {0.27f, 0.52f, 0.27f}), battens;
    for (int i = 0; i < 4; ++i) {
        const glm::mat4 turned = turn_y(0.5 * PI * i);
        append(battens, make_box({-0.305f, 0.0f, 0.245f}, {-0.235f, 0.54f, 0.305f}), turned);
        append(battens, make_box({-0.235f, 0.0f, 0.25f}, {0.245f, 0.07f, 0.3f}), turned);
        append(battens, make_box({-0.235f, 0.47f, 0.25f}, {0.245f, 0.535f, 0.3f}), turned);
    }
    return writer.add_mesh("crate", {{boards, m.planks}, {battens, m.dark_wood}});
}

void add_bench(GltfWriter& writer, const CourtMaterials& m) {
    Shape shape = make_box({-0.8f, 0.4f, -0.22f}, {0.8f, 0.48f, 0.22f});
    for (const float x : {-0.6f, 0.6f})
        append(shape, make_box({x - 0.1f, 0, -0.17f}, {x + 0.1f, 0.42f, 0.17f}));
    const int mesh = writer.add_mesh("bench", {{shape, m.dressed_stone}});
    for (int i = 0; i < 4; ++i) {
        const double angle = 0.25 * PI + 0.5 * PI * i;
        const glm::vec3 place(3.6f * cosine(angle), 0, -3.6f * sine(angle));
        writer.add_node("bench", {place, rotate_about({0, 1, 0}, angle + 0.5 * PI)}, mesh);
    }
}

}  // namespace

void add_fountain(GltfWriter& writer, const CourtMaterials& m) {
    Shape stone = make_lathe({{0, -0.1f},
                              {2.75f, -0.1f},
                              {2.75f, 0.14f},
                              {2.3f, 0.14f},
                              {2.22f, 0.2f},
                              {2.22f, 0.56f},
                              {2.32f, 0.62f},
                              {2.32f, 0.72f},
                              {1.98f, 0.72f},
                              {1.98f, 0.3f},
                              {0, 0.3f}},
                             32);
    append(stone, make_lathe({{0, 0.28f},
                              {0.5f, 0.28f},
                              {0.42f, 0.62f},
                              {0.24f, 0.74f},
                              {0.2f, 1.15f},
                              {0.3f, 1.3f},
                              {0.75f, 1.5f},
                              {0.98f, 1.62f},
                              {0.98f, 1.7f},
                              {0.9f, 1.7f},
                              {0.6f, 1.56f},
                              {0, 1.56f}},
                             28));
    append(stone, make_lathe({{0, 1.5f},
                              {0.2f, 1.5f},
                              {0.13f, 1.75f},
                              {0.1f, 2.0f},
                              {0.16f, 2.08f},
                              {0.42f, 2.2f},
                              {0.42f, 2.26f},
                              {0.36f, 2.26f},
                              {0.12f, 2.22f},
                              {0.08f, 2.32f},
                              {0.1f, 2.42f},
                              {0, 2.52f}},
                             20));
    Shape water = make_lathe({{2.0f, 0.55f}, {0, 0.55f}}, 32);
    append(water, make_lathe({{0.92f, 1.665f}, {0, 1.665f}}, 28));
    writer.add_node("fountain", {},
                    writer.add_mesh("fountain", {{stone, m.dressed_stone}, {water, m.water}}));
}

void add_furnishings(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    add_puddles(writer, m, random);
    add_bell(writer, m);
    add_bench(writer, m);
    const int barrel = add_barrel_mesh(writer, m), crate = add_crate_mesh(writer, m);
    const glm::vec3 up(0, 1, 0);
    constexpr glm::vec3 BARRELS[] = {{-12.2f, 0, 2.6f},     {-12.1f, 0, 3.4f}, {-11.4f, 0, 2.9f},
                                     {12.9f, 0, -9.6f},     {13.4f, 0, -8.9f}, {12.6f, 0, 10.2f},
                                     {-13.2f, 0, -10.2f},   {2.6f, 0, -10.6f}, {16.9f, 0.15f, 3.2f},
                                     {-6.3f, 0.15f, -14.8f}};
    std::uint64_t index = 50;
    for (const glm::vec3& place : BARRELS) {
        writer.add_node("barrel", {place, rotate_about(up, random.between(0.0f, 6.28f, index++, 0))}, barrel);
    }
    constexpr glm::vec3 CRATES[] = {{-11.5f, 0, -10.3f},  {-10.8f, 0, -10.4f}, {-11.15f, 0.545f, -10.35f},
                                    {13.3f, 0, 5.2f},     {13.2f, 0, 5.95f},   {13.25f, 0.545f, 5.5f},
                                    {3.4f, 0, -10.7f},    {-3.6f, 0, 10.6f},   {-2.9f, 0, 10.5f},
                                    {8.2f, 0.15f, -14.6f}};
    for (const glm::vec3& place : CRATES) {
        writer.add_node("crate", {place, rotate_about(up, random.between(-0.3f, 0.3f, index++, 0))}, crate);
    }
}

}  // namespace tarn::content
