// The walls of the lantern court: two storeys of arcades on four sides, back walls, roofs and corner towers.
#include "content/court.h"

namespace tarn::content {
namespace {

constexpr float HALF_BAY = 0.5f * BAY_M;
constexpr float WALL_DEPTH_M = 0.5f;
constexpr float BACK_Z = -GALLERY_DEPTH_M;
constexpr float OUTER_WALL_M = 0.4f;
constexpr float RIDGE_M = 9.0f;
constexpr float EAVE_Z = 0.75f, EAVE_Y = 7.02f;
// The west side has its stair here: this bay has no parapet.
constexpr int STAIR_SIDE = 3, STAIR_BAY = 4;

Shape make_column(float radius, float height, int segments) {
    const float r = radius;
    return make_lathe({{0, 0},
                       {1.35f * r, 0},
                       {1.35f * r, 0.1f},
                       {1.12f * r, 0.17f},
                       {r, 0.22f},
                       {1.02f * r, 0.4f * height},
                       {0.88f * r, height - 0.3f},
                       {1.02f * r, height - 0.26f},
                       {0.9f * r, height - 0.22f},
                       {1.3f * r, height - 0.1f},
                       {1.3f * r, height},
                       {0, height}},
                      segments);
}

Shape make_ground_walls() {
    Shape shape;
    const ArchSize arch{BAY_M, 1.7f, WALL_DEPTH_M, 2.3f, 0.25f, 14};
    append(shape, make_arch(arch), move_by({0, 2.1f, 0}));
    return shape;
}

Shape make_ground_stone() {
    Shape shape;
    append(shape, make_column(0.27f, 2.1f - TERRACE_M, 14), move_by({-HALF_BAY, TERRACE_M, 0}));
    append(shape, make_box({-HALF_BAY, -0.2f, BACK_Z - 0.1f}, {HALF_BAY, TERRACE_M, 0.5f}));
    append(shape, make_box({-HALF_BAY, 3.8f, BACK_Z - 0.1f}, {HALF_BAY, UPPER_FLOOR_M, 0.4f}));
    append(shape, make_box({-HALF_BAY, 3.68f, -0.3f}, {HALF_BAY, 3.82f, 0.32f}));
    return shape;
}

Shape make_upper_stone() {
    Shape shape;
    const float spring = UPPER_FLOOR_M + 1.75f;
    for (const float x : {-HALF_BAY, 0.0f}) {
        append(shape, make_column(0.14f, 1.75f, 10), move_by({x, UPPER_FLOOR_M, 0}));
        const ArchSize arch{HALF_BAY, CORNICE_M - spring, 0.34f, 1.14f, 0.12f, 8};
        append(shape, make_arch(arch), move_by({x + 0.5f * HALF_BAY, spring, 0}));
    }
    append(shape, make_box({-HALF_BAY, CORNICE_M - 0.05f, -0.25f}, {HALF_BAY, CORNICE_M + 0.3f, 0.2f}));
    return shape;
}

Shape make_parapet() {
    Shape shape;
    append(shape, make_box({-HALF_BAY, PARAPET_M - 0.1f, -0.09f}, {HALF_BAY, PARAPET_M, 0.09f}));
    append(shape, make_box({-HALF_BAY, 0.06f, -0.07f}, {HALF_BAY, 0.14f, 0.07f}));
    const Shape baluster = make_lathe({{0.035f, 0.1f}, {0.055f, 0.3f}, {0.03f, 0.6f}, {0.045f, 0.87f}}, 5);
    for (int i = 0; i < 10; ++i) {
        if (i % 5 == 0) continue;
        append(shape, baluster, move_by({-HALF_BAY + 0.3f * static_cast<float>(i), 0, 0}));
    }
    return shape;
}

// Planks under the roof, with two beams.
Shape make_upper_ceiling() {
    Shape shape = make_box({-HALF_BAY, 6.72f, BACK_Z - 0.1f}, {HALF_BAY, 6.8f, -0.1f});
    for (const float x : {-0.75f, 0.75f})
        append(shape, make_box({x - 0.07f, 6.52f, BACK_Z - 0.1f}, {x + 0.07f, 6.75f, -0.1f}));
    return shape;
}

// Beams under the upper storey's floor.
Shape make_ground_ceiling() {
    Shape shape;
    for (const float x : {-1.0f, 0.0f, 1.0f}) {
        append(shape, make_box({x - 0.08f, 3.58f, BACK_Z - 0.1f}, {x + 0.08f, 3.85f, -0.2f}));
    }
    return shape;
}

// A sloping slab with half-round tiles on it, as wide as a bay.
Shape make_roof() {
    const glm::vec2 eave(EAVE_Z, EAVE_Y), ridge(BACK_Z - OUTER_WALL_M - 0.25f, RIDGE_M + 0.1f);
    const glm::vec2 along = glm::normalize(ridge - eave), up(along.y, -along.x);
    const glm::vec2 lift = -0.1f * up;
    // The outline lies in the (z, y) plane: turned so that its x becomes world z, its depth spans x.
    Shape slab = make_extrusion({eave + lift, eave, ridge, ridge + lift}, BAY_M);
    Shape shape;
    append(shape, slab, turn_y(-0.5 * PI));
    const float length = glm::length(ridge - eave) + 0.06f;
    Shape tile;
    constexpr int SIDES = 5, TILES = 10;
    constexpr float RADIUS = 0.115f;
    std::vector<glm::vec3> end;
    for (int i = 0; i <= SIDES; ++i) {
        const double angle = PI * i / SIDES;
        end.emplace_back(RADIUS * cosine(angle), 0.8f * RADIUS * sine(angle), 0.0f);
    }
    for (int i = 0; i < SIDES; ++i) {
        const glm::vec3 back(0, 0, -length);
        append_polygon(tile, {end[i + 1], end[i], end[i] + back, end[i + 1] + back});
    }
    append_polygon(tile, end);
    append_polygon(tile, {{-RADIUS, 0, -length}, {RADIUS, 0, -length}, {RADIUS, 0, 0}, {-RADIUS, 0, 0}});
    glm::mat4 sloped(1.0f);  // turns -Z along the slope and +Y away from it
    sloped[1] = {0, up.y, up.x, 0};
    sloped[2] = {0, -along.y, -along.x, 0};
    for (int i = 0; i < TILES; ++i) {
        const float x = -HALF_BAY + BAY_M * (static_cast<float>(i) + 0.5f) / TILES;
        append(shape, tile, move_by({x, EAVE_Y, EAVE_Z + 0.05f}) * sloped);
    }
    // The ridge stone closes the tiles' upper ends.
    append(shape, make_box({-HALF_BAY, ridge.y - 0.2f, ridge.x - 0.12f},
                           {HALF_BAY, ridge.y + 0.16f, ridge.x + 0.1f}));
    return shape;
}

enum class Opening { DOOR, WINDOW, NICHE };

// A frame of four boxes around an opening on the back wall, and what fills it.
void append_opening(Opening kind, const glm::vec3& foot, Shape& frame, Shape& wood, Shape& panes) {
    const bool door = kind == Opening::DOOR;
    const float half = door ? 0.55f : 0.5f, low = door ? 0.0f : 0.9f, high = door ? 2.15f : 2.2f;
    const auto bar = [&](float x0, float y0, float x1, float y1) {
        append(frame, make_box(foot + glm::vec3(x0, y0, -0.05f), foot + glm::vec3(x1, y1, 0.07f)));
    };
    bar(-half - 0.12f, low, -half, high + 0.12f);
    bar(half, low, half + 0.12f, high + 0.12f);
    bar(-half, high, half, high + 0.12f);
    if (!door) bar(-half - 0.2f, low - 0.1f, half + 0.2f, low);
    if (kind == Opening::WINDOW) {
        append(panes, make_quad(foot + glm::vec3(-half, low, 0.02f), {2 * half, 0, 0}, {0, high - low, 0}));
        append(wood, make_box(foot + glm::vec3(-0.03f, low, -0.02f), foot + glm::vec3(0.03f, high, 0.05f)));
    } else {
        append(wood, make_box(foot + glm::vec3(-half, low, -0.05f), foot + glm::vec3(half, high, 0.03f)));
    }
}

// Two bays of back wall, two storeys high.
int add_back_wall(GltfWriter& writer, const CourtMaterials& m, const std::array<Opening, 4>& openings) {
    Shape frame, wood, panes;
    append_opening(openings[0], {-HALF_BAY, TERRACE_M, BACK_Z}, frame, wood, panes);
    append_opening(openings[1], {HALF_BAY, TERRACE_M, BACK_Z}, frame, wood, panes);
    append_opening(openings[2], {-HALF_BAY, UPPER_FLOOR_M, BACK_Z}, frame, wood, panes);
    append_opening(openings[3], {HALF_BAY, UPPER_FLOOR_M, BACK_Z}, frame, wood, panes);
    const Shape wall = make_box({-BAY_M, -0.2f, BACK_Z - OUTER_WALL_M}, {BAY_M, RIDGE_M - 0.25f, BACK_Z});
    return writer.add_mesh(
        "back wall", {{wall, m.plaster}, {frame, m.dressed_stone}, {wood, m.paint_blue}, {panes, m.window}});
}

// The same shape in two neighbouring bays.
Shape pair_of(const Shape& bay) {
    Shape pair;
    for (const float x : {-HALF_BAY, HALF_BAY}) append(pair, bay, move_by({x, 0, 0}));
    return pair;
}

// Both storeys of two neighbouring bays: arcades, floors and ceilings.
int add_bay_pair(GltfWriter& writer, const CourtMaterials& m) {
    Shape stone = make_ground_stone(), beams = make_ground_ceiling();
    append(stone, make_upper_stone());
    append(beams, make_upper_ceiling());
    return writer.add_mesh("bay pair", {{pair_of(make_ground_walls()), m.ashlar},
                                        {pair_of(stone), m.dressed_stone},
                                        {pair_of(beams), m.dark_wood}});
}

void add_towers(GltfWriter& writer, const CourtMaterials& m) {
    const float size = GALLERY_DEPTH_M + OUTER_WALL_M + 0.3f;
    Shape walls = make_box({-0.5f * size, -0.2f, -0.5f * size}, {0.5f * size, 9.9f, 0.5f * size});
    Shape panes;
    for (int face = 0; face < 4; ++face) {
        const Shape pane = make_quad({-0.35f, 8.2f, 0.5f * size + 0.02f}, {0.7f, 0, 0}, {0, 1.1f, 0});
        append(panes, pane, turn_y(0.5 * PI * face));
    }
    Shape roof;
    append(roof, make_tapered_box({size + 0.7f, 3.4f, size + 0.7f}, 0.02f), move_by({0, 9.85f, 0}));
    const int mesh = writer.add_mesh("tower", {{walls, m.plaster}, {roof, m.clay}, {panes, m.window}});
    for (const float x : {-1.0f, 1.0f}) {
        for (const float z : {-1.0f, 1.0f}) {
            writer.add_node("tower", {{x * (HALF_X_M + 0.5f * size), 0, z * (HALF_Z_M + 0.5f * size)}}, mesh);
        }
    }
}

void add_paving(GltfWriter& writer, const CourtMaterials& m) {
    Shape shape;
    constexpr int COLUMNS = 10, ROWS = 8;
    for (int row = 0; row < ROWS; ++row) {
        for (int column = 0; column < COLUMNS; ++column) {
            const float x0 = BAY_M * static_cast<float>(column) - HALF_X_M,
                        z0 = BAY_M * static_cast<float>(row) - HALF_Z_M;
            append_polygon(
                shape, {{x0, 0, z0 + BAY_M}, {x0 + BAY_M, 0, z0 + BAY_M}, {x0 + BAY_M, 0, z0}, {x0, 0, z0}});
        }
    }
    writer.add_node("paving", {}, writer.add_mesh("paving", {{shape, m.cobbles}}));
}

}  // namespace

Placement Side::bay(int index) const {
    const float along = BAY_M * (static_cast<float>(index) - 0.5f * static_cast<float>(bays - 1));
    return {to_world({along, 0, 0}), rotate_about({0, 1, 0}, turn_rad)};
}

Placement Side::bay_pair(int index) const {
    const float along = BAY_M * (2.0f * static_cast<float>(index) + 1.0f - 0.5f * static_cast<float>(bays));
    return {to_world({along, 0, 0}), rotate_about({0, 1, 0}, turn_rad)};
}

glm::vec3 Side::to_world(const glm::vec3& local) const {
    return middle + glm::vec3(turn_y(turn_rad) * glm::vec4(local, 0.0f));
}

std::array<Side, 4> court_sides() {
    // East and west lie 8 mm deeper, so that no two sides have surfaces in one plane where they cross.
    constexpr float LOWER = -0.008f;
    return {{{"north", 10, 0.0, {0, 0, -HALF_Z_M}},
             {"east", 8, -0.5 * PI, {HALF_X_M, LOWER, 0}},
             {"south", 10, PI, {0, 0, HALF_Z_M}},
             {"west", 8, 0.5 * PI, {-HALF_X_M, LOWER, 0}}}};
}

void add_architecture(GltfWriter& writer, const CourtMaterials& m) {
    add_paving(writer, m);
    add_towers(writer, m);
    const int bay_pair = add_bay_pair(writer, m);
    const int roof = writer.add_mesh("roof", {{pair_of(make_roof()), m.clay}});
    const int parapet = writer.add_mesh("parapet", {{make_parapet(), m.dressed_stone}});
    using enum Opening;
    const int walls[2] = {add_back_wall(writer, m, {WINDOW, DOOR, DOOR, WINDOW}),
                          add_back_wall(writer, m, {NICHE, WINDOW, WINDOW, NICHE})};
    const std::array<Side, 4> sides = court_sides();
    for (int s = 0; s < 4; ++s) {
        const Side& side = sides[s];
        const std::string name = side.name;
        for (int pair = 0; pair < side.bays / 2; ++pair) {
            const Placement place = side.bay_pair(pair);
            writer.add_node(name + " bays", place, bay_pair);
            writer.add_node(name + " roof", place, roof);
            writer.add_node(name + " back wall", place, walls[(pair + s) % 2]);
        }
        for (int bay = 0; bay < side.bays; ++bay) {
            if (s == STAIR_SIDE && bay == STAIR_BAY) continue;
            Placement place = side.bay(bay);
            place.translation.y += UPPER_FLOOR_M;
            writer.add_node(name + " parapet", place, parapet);
        }
    }
}

void add_stairs(GltfWriter& writer, const CourtMaterials& m) {
    constexpr int STEPS = 24;
    constexpr float RUN = 0.29f, RISE = UPPER_FLOOR_M / STEPS, WIDTH = 1.7f;
    // Local frame: the flight climbs towards local +x from -STEPS * RUN to the landing at 0; local +z is the
    // court.
    Shape steps, walls;
    const float half = 0.5f * WIDTH;
    for (int i = 0; i < STEPS; ++i) {
        const float x0 = RUN * static_cast<float>(i - STEPS), x1 = RUN * static_cast<float>(i + 1 - STEPS);
        const float low = RISE * static_cast<float>(i), high = RISE * static_cast<float>(i + 1);
        append_polygon(steps, {{x0, high, half}, {x1, high, half}, {x1, high, -half}, {x0, high, -half}});
        append_polygon(steps, {{x0, low, -half}, {x0, low, half}, {x0, high, half}, {x0, high, -half}});
        append_polygon(walls, {{x0, 0, half}, {x1, 0, half}, {x1, high, half}, {x0, high, half}});
        append_polygon(walls, {{x1, 0, -half}, {x0, 0, -half}, {x0, high, -half}, {x1, high, -half}});
    }
    constexpr float START = -RUN * STEPS;
    const auto banister =
        make_extrusion({{START, 0.0f}, {0.0f, 0.0f}, {0.0f, UPPER_FLOOR_M + 0.95f}, {START, 0.95f}}, 0.18f);
    append(walls, banister, move_by({0, 0, half + 0.08f}));
    append(steps, make_box({START - 0.14f, 0, half - 0.05f}, {START + 0.14f, 1.15f, half + 0.21f}));
    append(walls, make_arch({BAY_M, UPPER_FLOOR_M - 0.22f, WIDTH, 1.9f, 2.2f, 14}),
           move_by({HALF_BAY, 0, 0}));
    append(steps, make_box({0.0f, UPPER_FLOOR_M - 0.22f, -half}, {BAY_M, UPPER_FLOOR_M, half + 0.12f}));
    Shape rails;
    append(rails, make_parapet(), move_by({HALF_BAY, UPPER_FLOOR_M, half - 0.02f}));
    append(rails, make_parapet(),
           move_by({BAY_M - 0.12f, UPPER_FLOOR_M - 0.01f, 0.0f}) * turn_y(0.5 * PI) *
               stretch({WIDTH / BAY_M, 1, 1}));
    const Side side = court_sides()[STAIR_SIDE];
    Placement place = side.bay(STAIR_BAY);
    place.translation += glm::vec3(turn_y(side.turn_rad) * glm::vec4(-HALF_BAY, 0.008f, 0.39f + half, 0));
    writer.add_node(
        "stair", place,
        writer.add_mesh("stair", {{steps, m.dressed_stone}, {walls, m.ashlar}, {rails, m.dressed_stone}}));
}

}  // namespace tarn::content
