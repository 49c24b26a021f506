// Lanterns of four kinds: in the arcades, on strings across the court, in garlands below the cornice, and
// adrift.

#include "content/court.h"

namespace tarn::content {
namespace {

// The glowing and the dark part of a lantern that hangs from the origin.
struct LanternKind {
    Shape glow;
    Shape frame;
};

// Round paper lantern: 20 glowing triangles between two wooden rims.
LanternKind make_round_lantern(float radius) {
    const float h = 0.85f * radius, rim = 0.45f * radius, top = -0.12f;
    LanternKind kind;
    kind.glow = make_lathe({{rim, top - 2 * h}, {radius, top - h}, {rim, top}}, 5);
    append(kind.frame, make_lathe({{0, top - 0.01f}, {1.1f * rim, top}, {0, top + 0.05f}}, 5));
    append(kind.frame,
           make_lathe({{0, top - 2 * h - 0.03f}, {1.1f * rim, top - 2 * h}, {0, top - 2 * h + 0.01f}}, 5));
    append(kind.frame, make_tube({{0, top + 0.03f, 0}, {0, 0, 0}}, 0.006f, 3));
    return kind;
}

// Tall six-sided paper lantern: 12 glowing triangles.
LanternKind make_tall_lantern(float radius) {
    const float h = 2.6f * radius, top = -0.1f;
    LanternKind kind;
    kind.glow = make_lathe({{0.85f * radius, top - h}, {radius, top}}, 6);
    append(
        kind.frame,
        make_lathe({{0, top - 0.005f}, {1.12f * radius, top}, {0.5f * radius, top + 0.04f}, {0, top + 0.05f}},
                   6));
    append(kind.frame,
           make_lathe({{0, top - h - 0.04f}, {0.97f * radius, top - h}, {0, top - h + 0.005f}}, 6));
    append(kind.frame, make_tube({{0, top + 0.04f, 0}, {0, 0, 0}}, 0.006f, 3));
    return kind;
}

// Eight-sided crystal: 8 glowing triangles.
LanternKind make_star_lantern(float radius) {
    LanternKind kind;
    const float top = -0.08f;
    for (int i = 0; i < 4; ++i) {
        const auto on_belt = [&](int k) {
            const double angle = 0.5 * PI * (k % 4);
            return glm::vec3(0.75f * radius * cosine(angle), top - radius, -0.75f * radius * sine(angle));
        };
        append_polygon(kind.glow, {on_belt(i), on_belt(i + 1), {0, top, 0}});
        append_polygon(kind.glow, {on_belt(i + 1), on_belt(i), {0, top - 2 * radius, 0}});
    }
    append(kind.frame, make_lathe({{0, top - 0.02f}, {0.025f, top}, {0, top + 0.03f}}, 5));
    append(kind.frame, make_tube({{0, top + 0.02f, 0}, {0, 0, 0}}, 0.006f, 3));
    return kind;
}

// Metal lantern with four panes (8 glowing triangles) on a chain of `drop` metres.
LanternKind make_pane_lantern(float width, float height, float drop) {
    LanternKind kind;
    const float half = 0.5f * width, low = -drop - height;
    for (int i = 0; i < 4; ++i) {
        const glm::mat4 turned = turn_y(0.5 * PI * i);
        append(
            kind.glow,
            make_quad({-0.9f * half, low + 0.005f, 0.9f * half}, {1.8f * half, 0, 0}, {0, height - 0.01f, 0}),
            turned);
        append(kind.frame,
               make_box({half - 0.015f, low, half - 0.015f}, {half + 0.015f, -drop, half + 0.015f}), turned);
    }
    const float wide = width + 0.06f;
    append(kind.frame, make_tapered_box({wide, 0.1f, wide}, 0.25f), move_by({0, -drop - 0.01f, 0}));
    append(kind.frame,
           make_box({-0.5f * wide, low - 0.03f, -0.5f * wide}, {0.5f * wide, low + 0.015f, 0.5f * wide}));
    append(kind.frame, make_tube({{0, -drop + 0.05f, 0}, {0, 0.02f, 0}}, 0.01f, 4));
    append(kind.frame, make_lathe({{0, -drop + 0.08f}, {0.04f, -drop + 0.11f}, {0, -drop + 0.14f}}, 6));
    return kind;
}

// Gathers lanterns by colour, so that a whole string becomes one mesh.
struct LanternGroup {
    Shape dark;  // frames and ropes
    std::array<Shape, COLORS> glow;

    void add(const LanternKind& kind, int color, const glm::mat4& place) {
        append(glow[color], kind.glow, place);
        append(dark, kind.frame, place);
    }
    int add_mesh(GltfWriter& writer, const std::string& name, const CourtMaterials& m) const {
        std::vector<Part> parts;
        parts.push_back({dark, m.dark_wood});
        for (int color = 0; color < COLORS; ++color) {
            if (!glow[color].positions.empty()) parts.push_back({glow[color], m.glow[color]});
        }
        return writer.add_mesh(name, parts);
    }
};

// Keys of a closed swing about a unit axis.
void swing(GltfWriter& writer, int node, const glm::quat& rest, const glm::vec3& axis, double amplitude_rad,
           double period_s, double phase, Motion motion) {
    constexpr int KEYS = 8;
    std::vector<float> times_s;
    std::vector<glm::quat> keys;
    for (int i = 0; i <= KEYS; ++i) {
        times_s.push_back(static_cast<float>(period_s * i / KEYS));
        const double angle = amplitude_rad * sine(2.0 * PI * (static_cast<double>(i % KEYS) / KEYS + phase));
        keys.push_back(glm::normalize(rest * rotate_about(axis, angle)));
    }
    writer.animate_rotation(node, motion, times_s, keys);
}

struct StringSpan {
    glm::vec3 start, end;
    float sag_m;
    bool swings;
};

// Strings hang from the upper cornice, over the court in both directions.
std::vector<StringSpan> make_spans() {
    constexpr float Y = 6.75f, X = HALF_X_M - 0.35f, Z = HALF_Z_M - 0.35f;
    std::vector<StringSpan> spans;
    for (int i = 0; i < 9; ++i) {
        const float x = -12.0f + 3.0f * static_cast<float>(i);
        const float lean = i % 2 == 0 ? 1.5f : -1.5f;
        spans.push_back({{x, Y, -Z}, {x + lean, Y, Z}, 1.5f + 0.1f * static_cast<float>(i % 3), i % 2 == 1});
    }
    for (int i = 0; i < 5; ++i) {
        const float z = -8.0f + 4.0f * static_cast<float>(i);
        spans.push_back(
            {{-X, Y - 0.25f, z}, {X, Y - 0.25f, z + (i % 2 == 0 ? -1.5f : 1.5f)}, 2.1f, i % 2 == 0});
    }
    return spans;
}

// In the string's own frame: the origin at its start, so that a turn about its chord swings it.
LanternGroup hang_string(const StringSpan& span, const Random& random, std::uint64_t index) {
    static const LanternKind KINDS[3] = {make_round_lantern(0.16f), make_tall_lantern(0.11f),
                                         make_star_lantern(0.15f)};
    const glm::vec3 chord = span.end - span.start;
    const auto at = [&](float t) { return chord * t - glm::vec3(0, 4.0f * span.sag_m * t * (1.0f - t), 0); };
    LanternGroup group;
    std::vector<glm::vec3> path;
    constexpr int PIECES = 20;
    for (int i = 0; i <= PIECES; ++i) path.push_back(at(static_cast<float>(i) / PIECES));
    group.dark = make_tube(path, 0.012f, 4);
    const int count = static_cast<int>(glm::length(chord) / 0.85f);
    const int first_color = static_cast<int>(random.bits(index, 0) % COLORS);
    for (int i = 0; i < count; ++i) {
        const auto dimension = static_cast<std::uint64_t>(i) + 1;
        const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        const int color = (first_color + static_cast<int>(random.bits(index, dimension) % 3) * 3) % COLORS;
        const LanternKind& kind = KINDS[random.bits(index, dimension + 100) % 3];
        const float size = random.between(0.85f, 1.2f, index, dimension + 200);
        group.add(kind, color,
                  move_by(at(t) - glm::vec3(0, 0.008f, 0)) *
                      turn_y(random.between(0.0f, 6.28f, index, dimension + 300)) * stretch(glm::vec3(size)));
    }
    return group;
}

void add_strings(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    const std::vector<StringSpan> spans = make_spans();
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const StringSpan& span = spans[i];
        const std::string name = "string " + std::to_string(i);
        const int mesh = hang_string(span, random, i).add_mesh(writer, name, m);
        const int node = writer.add_node(name, {span.start}, mesh);
        if (!span.swings) continue;
        const glm::vec3 axis = glm::normalize(span.end - span.start);
        swing(writer, node, glm::quat(1, 0, 0, 0), axis, 0.09, 5.0 + 0.4 * static_cast<double>(i % 4),
              0.13 * static_cast<double>(i), Motion::CUBIC);
    }
}

// One metal lantern in each ground arch, every third swinging; one in every second bay of the upper gallery.
void add_arcade_lanterns(GltfWriter& writer, const CourtMaterials& m) {
    const LanternKind ground = make_pane_lantern(0.2f, 0.3f, 0.5f),
                      upper = make_pane_lantern(0.18f, 0.26f, 0.45f);
    int ground_mesh[3], upper_mesh[3];
    for (int i = 0; i < 3; ++i) {
        ground_mesh[i] = writer.add_mesh("arcade lantern", {{ground.glow, i == 1 ? m.bright_lamp : m.lamp},
                                                            {ground.frame, i == 2 ? m.brass : m.iron}});
        upper_mesh[i] = writer.add_mesh("gallery lantern",
                                        {{upper.glow, m.lamp}, {upper.frame, i == 2 ? m.brass : m.iron}});
    }
    int number = 0;
    for (const Side& side : court_sides()) {
        for (int bay = 0; bay < side.bays; ++bay, ++number) {
            Placement place = side.bay(bay);
            const glm::vec3 ground_floor = place.translation;
            place.translation = ground_floor + glm::vec3(0, 3.52f, 0);
            const int node = writer.add_node("arcade lantern", place, ground_mesh[number % 3]);
            if (number % 3 == 0) {
                swing(writer, node, place.rotation, {1, 0, 0}, 0.12, 2.4, 0.21 * number, Motion::LINEAR);
            }
            if (bay % 2 == 1) continue;
            const glm::vec3 inward(turn_y(side.turn_rad) * glm::vec4(0, 0, -2.0f, 0));
            place.translation = ground_floor + inward + glm::vec3(0, 6.74f, 0);
            writer.add_node("gallery lantern", place, upper_mesh[number % 3]);
        }
    }
}

// Small lanterns in shallow arcs below the string course of each side.
void add_garlands(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    const LanternKind small = make_star_lantern(0.07f);
    int number = 0;
    for (const Side& side : court_sides()) {
        LanternGroup group;
        for (int bay = 0; bay < side.bays; ++bay, ++number) {
            const float left = BAY_M * (static_cast<float>(bay) - 0.5f * static_cast<float>(side.bays));
            const auto at = [&](float t) {
                return glm::vec3(left + BAY_M * t, 3.62f - 1.1f * t * (1.0f - t), 0.36f);
            };
            std::vector<glm::vec3> path;
            for (int i = 0; i <= 8; ++i) path.push_back(at(static_cast<float>(i) / 8.0f));
            append(group.dark, make_tube(path, 0.008f, 3));
            for (int i = 0; i < 6; ++i) {
                const int color = static_cast<int>(random.bits(number, i) % 5);
                group.add(small, color < 4 ? color : 5, move_by(at((static_cast<float>(i) + 0.5f) / 6.0f)));
            }
        }
        const std::string name = std::string(side.name) + " garland";
        writer.add_node(name, {side.middle, rotate_about({0, 1, 0}, side.turn_rad)},
                        group.add_mesh(writer, name, m));
    }
}

// Paper lanterns that sail over the court in slow loops (LINEAR), and others on the basin's water (CUBIC).
void add_drifting(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    LanternKind sky;
    sky.glow = make_lathe({{0.13f, -0.2f}, {0.2f, 0.06f}, {0.13f, 0.22f}, {0, 0.27f}}, 6);
    sky.frame = make_lathe({{0.0f, -0.2f}, {0.14f, -0.22f}, {0.14f, -0.19f}, {0, -0.19f}}, 6);
    LanternKind cup;
    cup.glow = make_lathe({{0.09f, 0.02f}, {0.13f, 0.14f}}, 6);
    append(cup.frame, make_lathe({{0, -0.02f}, {0.16f, 0.0f}, {0.09f, 0.025f}, {0, 0.025f}}, 8));
    append(cup.frame, make_lathe({{0, 0.12f}, {0.145f, 0.14f}, {0, 0.15f}}, 6));
    constexpr int SKY = 7, CUPS = 8, KEYS = 12;
    for (int i = 0; i < SKY + CUPS; ++i) {
        const bool in_sky = i < SKY;
        const LanternKind& kind = in_sky ? sky : cup;
        const int color = in_sky ? i % 2 : (i * 3) % COLORS;
        const int mesh = writer.add_mesh(in_sky ? "sky lantern" : "water lantern",
                                         {{kind.glow, m.glow[color]}, {kind.frame, m.dark_wood}});
        const double phase = static_cast<double>(i) / (in_sky ? SKY : CUPS);
        const float radius = in_sky ? random.between(4.0f, 8.5f, i, 0) : random.between(1.25f, 1.75f, i, 1);
        const float height = in_sky ? random.between(7.6f, 10.5f, i, 2) : 0.552f;
        std::vector<float> times_s;
        std::vector<glm::vec3> keys;
        for (int k = 0; k <= KEYS; ++k) {
            const double angle = 2.0 * PI * (static_cast<double>(k % KEYS) / KEYS + phase);
            const double bob = in_sky ? 0.5 * sine(3.0 * angle) : 0.0;
            times_s.push_back((in_sky ? 4.0f : 2.5f) * static_cast<float>(k));
            keys.emplace_back(radius * cosine(angle), height + bob,
                              radius * sine(angle) * (in_sky ? 0.8 : 1.0));
        }
        const int node = writer.add_node(in_sky ? "sky lantern" : "water lantern", {keys[0]}, mesh);
        writer.animate_translation(node, in_sky ? Motion::LINEAR : Motion::CUBIC, times_s, keys);
    }
}

// Lanterns in the crowns of the trees.
void add_tree_lanterns(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    const LanternKind round = make_round_lantern(0.1f);
    int number = 0;
    for (const glm::vec3& tree : tree_places()) {
        LanternGroup group;
        for (int i = 0; i < 16; ++i) {
            const auto index = static_cast<std::uint64_t>(1000 + 16 * number + i);
            const double angle = 2.0 * PI * (i + 0.5 * random.unit(index, 0)) / 16.0;
            const float radius = random.between(0.9f, 1.7f, index, 1),
                        height = random.between(2.5f, 3.6f, index, 2);
            group.add(round, (2 * number + static_cast<int>(random.bits(index, 3) % 3) * 3) % COLORS,
                      move_by({radius * cosine(angle), height, radius * sine(angle)}));
        }
        writer.add_node("tree lanterns", {tree}, group.add_mesh(writer, "tree lanterns", m));
        ++number;
    }
}

}  // namespace

void add_lanterns(GltfWriter& writer, const CourtMaterials& m, const Random& random) {
    add_strings(writer, m, random);
    add_arcade_lanterns(writer, m);
    add_garlands(writer, m, random);
    add_drifting(writer, m, random);
    add_tree_lanterns(writer, m, random);
}

}  // namespace tarn::content
