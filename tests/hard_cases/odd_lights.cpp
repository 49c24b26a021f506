// Lights that are very dim and very bright, absent, without area, edge-on, on a surface or inside of things:
// pictures stay finite, counters stay at zero, and what is known in closed form stays true.
#include <gtest/gtest.h>

#include "scene/gltf_import.h"
#include "support/on_context.h"
#include "support/toy_render.h"
#include "unit/gltf_builder.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 97;  // odd: the middle column looks straight ahead
constexpr int HEIGHT_PX = 65;
constexpr double INV_PI_D = 0.318309886183790672;
const DirectMode MODES[] = {DirectMode::UNIFORM, DirectMode::RIS};

class OddLights : public OnContext<> {};

// A floor of 8 m at y = 0 with albedo 0.5, instance 0.
ToyScene make_floor() {
    ToyScene toy;
    const MaterialIndex grey = toy.add_material(lambert_material(glm::vec3(0.5f)));
    toy.add_quad(grey, {-4.0f, 0.0f, 4.0f}, {8.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -8.0f});
    return toy;
}

ToyRender make_render(const ToyScene& toy, const WorldOptions& options = {}) {
    return ToyRender(toy.scene, WIDTH_PX, HEIGHT_PX, options);
}

CameraRecord look_at_floor(const ToyRender& render) {
    return render.look({0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 50.0);
}

WorldOptions black_sky() {
    WorldOptions options;
    options.environment = Image(16, 8, 3);
    return options;
}

// ---- Intensities --------------------------------------------------------------------------------

// Light is linear in intensity: a power of two comes out of every product as it went in, so that a floor or
// an epsilon anywhere on the way shows. 2^-27 is 7.5e-9, 2^27 is 1.3e8.
TEST_F(OddLights, PicturesAreLinearInIntensityOverSixteenDecades) {
    for (const DirectMode mode : MODES) {
        const auto picture = [&](float intensity) {
            ToyScene toy = make_floor();
            const MaterialIndex lamp =
                toy.add_material(emissive_material(glm::vec3(3.0f, 2.0f, 1.0f) * intensity));
            toy.add_quad(lamp, {-1.0f, 1.5f, -1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
            toy.add_light(make_point(intensity), at_place(1.0, 1.0, 0.5));
            ToyRender render = make_render(toy);
            return render.render(look_at_floor(render), mode);
        };
        const Image one = picture(1.0f);
        EXPECT_GT(mean_of(one), 0.01);
        for (const float intensity : {0x1p-27f, 0x1p27f}) {
            EXPECT_EQ(count_off_scale(one, picture(intensity), intensity), 0u) << intensity;
        }
    }
}

// Sixteen decades apart in one scene, a wall between them: the dim side is dark, neither black for ever nor
// leaked upon.
TEST_F(OddLights, ADimLightBesideABrightOneKeepsItsValue) {
    ToyScene toy = make_floor();
    const MaterialIndex grey = toy.add_material(lambert_material(glm::vec3(0.5f)));
    toy.add_quad(grey, {0.0f, 0.0f, 4.0f}, {0.0f, 6.0f, 0.0f}, {0.0f, 0.0f, -8.0f});
    toy.add_quad(grey, {0.0f, 0.0f, -4.0f}, {0.0f, 6.0f, 0.0f}, {0.0f, 0.0f, 8.0f});
    toy.add_light(make_point(1e-8f), at_place(-1.0, 1.0, 0.0));
    toy.add_light(make_point(1e8f), at_place(1.0, 1.0, 0.0));
    ToyRender render = make_render(toy);
    const CameraRecord camera = render.look({0.0, 5.0, 0.001}, {0.0, 0.0, 0.0}, 60.0);
    for (const DirectMode mode : MODES) {
        const Image image = render.render(camera, mode);
        const double draws = mode == DirectMode::UNIFORM ? 2.0 : 1.0;  // W of a light that was drawn
        int dim_lit = 0, dim_wrong = 0, bright_lit = 0, bright_wrong = 0;
        for (int y = 0; y < HEIGHT_PX; ++y) {
            for (int x = 0; x < WIDTH_PX; ++x) {
                // The middle column sees the floor right under the wall, which belongs to either side.
                if (render.seen_instance(x, y) != 0 || x == WIDTH_PX / 2) continue;
                const glm::dvec3 direction = render.ray_direction(camera, x, y);
                const glm::dvec3 eye = render.camera_position_ws(camera);
                const glm::dvec3 p = eye - direction * (eye.y / direction.y);
                const bool dim = p.x < 0.0;
                const glm::dvec3 to_light = glm::dvec3(dim ? -1.0 : 1.0, 1.0, 0.0) - p;
                const double distance = glm::length(to_light);
                const double exact =
                    0.5 * INV_PI_D * (dim ? 1e-8 : 1e8) * to_light.y / std::pow(distance, 3.0);
                const double value = image.pixel(x, y)[1];
                const bool wrong = value != 0.0 && std::abs(value / (draws * exact) - 1.0) > 1e-3;
                (dim ? dim_lit : bright_lit) += value > 0.0;
                (dim ? dim_wrong : bright_wrong) += wrong;
            }
        }
        EXPECT_EQ(bright_wrong, 0);
        EXPECT_GT(bright_lit, 500);
        EXPECT_EQ(dim_wrong, 0);
        // One draw of two finds the dim light; by power it would take 1e16 draws.
        if (mode == DirectMode::UNIFORM) {
            EXPECT_GT(dim_lit, 500);
        }
    }
}

// ---- None, one, without area --------------------------------------------------------------------

TEST_F(OddLights, WithoutLightsAnEvenSkyLightsAConvexBody) {
    ToyScene toy;
    const MaterialIndex grey = toy.add_material(lambert_material(glm::vec3(0.5f)));
    toy.add_instance(toy.add_mesh(grey, sphere_corners(1.0f, 24)));
    ToyRender render = make_render(toy);
    const CameraRecord camera = render.look({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 40.0);
    for (const DirectMode mode : MODES) {
        const Image image = render.render(camera, mode, 32);
        double body = 0.0;
        int count = 0;
        for (int y = 0; y < HEIGHT_PX; ++y) {
            for (int x = 0; x < WIDTH_PX; ++x) {
                if (render.seen_instance(x, y) == INVALID_INDEX) {
                    EXPECT_NEAR(image.pixel(x, y)[0], 1.0f, 1e-6f);
                } else {
                    body += image.pixel(x, y)[1];
                    ++count;
                }
            }
        }
        // Radiance 1 from everywhere on albedo 0.5. One draw has a relative deviation of at most 2; there are
        // 30 000.
        ASSERT_GT(count, 1000);
        EXPECT_NEAR(body / count, 0.5, 0.5 * 6.0 * 2.0 / std::sqrt(32.0 * count));
    }
}

TEST_F(OddLights, ABlackSkyAloneGivesABlackPicture) {
    ToyRender render = make_render(make_floor(), black_sky());
    for (const DirectMode mode : MODES) EXPECT_EQ(mean_of(render.render(look_at_floor(render), mode)), 0.0);
}

TEST_F(OddLights, OneTriangleIsAsBrightAsItsSolidAngle) {
    ToyScene toy = make_floor();
    const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(1e4f)));
    // 5e-5 m^2, facing down from 2 m: as a point from the floor.
    toy.add_instance(toy.add_mesh(lamp, {{0.0f, 2.0f, 0.0f}, {0.01f, 2.0f, 0.0f}, {0.0f, 2.0f, 0.01f}}));
    ToyRender render = make_render(toy);
    ASSERT_EQ(render.world().lights.count, 1u);
    const CameraRecord camera = look_at_floor(render);
    for (const DirectMode mode : MODES) {
        const Image image = render.render(camera, mode);
        const int x = WIDTH_PX / 2, y = HEIGHT_PX / 2;
        const double expected = 0.5 * INV_PI_D * 1e4 * 5e-5 / 4.0;
        EXPECT_NEAR(image.pixel(x, y)[1], expected, 1e-3 * expected);
    }
}

TEST_F(OddLights, EmittersWithoutAreaChangeNothing) {
    const auto picture = [](bool with_degenerate, DirectMode mode) {
        ToyScene toy = make_floor();
        toy.add_light(make_point(2.0f), at_place(0.5, 1.0, 0.0));
        if (with_degenerate) {
            const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(1e6f)));
            const glm::vec3 a(-1.0f, 1.0f, 0.0f), b(1.0f, 1.0f, 0.0f);
            toy.add_instance(toy.add_mesh(lamp, {a, a, a, a, b, 0.5f * (a + b), a, a, b}));
        }
        ToyRender render = make_render(toy);
        return render.render(look_at_floor(render), mode).values;
    };
    for (const DirectMode mode : MODES) EXPECT_EQ(picture(true, mode), picture(false, mode));
}

TEST_F(OddLights, AnEmitterWithoutAreaAloneIsFinite) {
    ToyScene toy = make_floor();
    const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(1e6f)));
    toy.add_instance(toy.add_mesh(lamp, {{0.0f, 1.0f, 0.0f}, {1.0f, 1.0f, 0.0f}, {0.5f, 1.0f, 0.0f}}));
    ToyRender render = make_render(toy);
    for (const DirectMode mode : MODES) render.render(look_at_floor(render), mode, 4);
}

// ---- A million ----------------------------------------------------------------------------------

template <class T>
void append_bytes(std::string& bytes, const std::vector<T>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

// A binary glTF file of one emissive sheet, [-1, 1] x {1.5} x [-1, 1] facing down, of 2 * columns * rows
// triangles.
std::string sheet_glb(std::uint32_t columns, std::uint32_t rows) {
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t z = 0; z <= rows; ++z) {
        for (std::uint32_t x = 0; x <= columns; ++x) {
            positions.insert(positions.end(), {2.0f * float(x) / float(columns) - 1.0f, 1.5f,
                                               2.0f * float(z) / float(rows) - 1.0f});
        }
    }
    for (std::uint32_t z = 0; z < rows; ++z) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t a = z * (columns + 1) + x, b = a + columns + 1;
            indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
        }
    }
    std::string binary;
    append_bytes(binary, positions);
    append_bytes(binary, indices);
    std::string json = fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "buffers": [{{"byteLength": {0}}}], "nodes": [{{"mesh": 0}}],
        "bufferViews": [{{"buffer": 0, "byteLength": {1}}}, {{"buffer": 0, "byteOffset": {1}, "byteLength": {2}}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": {3}, "type": "VEC3"}},
                      {{"bufferView": 1, "componentType": 5125, "count": {4}, "type": "SCALAR"}}],
        "materials": [{{"emissiveFactor": [1, 1, 1]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "material": 0}}]}}]}})",
        binary.size(), positions.size() * sizeof(float), indices.size() * sizeof(std::uint32_t),
        positions.size() / 3, indices.size());
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string glb = "glTF";
    append_bytes<std::uint32_t>(glb, {2, std::uint32_t(28 + json.size() + binary.size())});
    append_bytes<std::uint32_t>(glb, {std::uint32_t(json.size()), 0x4e4f534a});
    glb += json;
    append_bytes<std::uint32_t>(glb, {std::uint32_t(binary.size()), 0x004e4942});
    return glb + binary;
}

// The sheet over a floor, from a file through import, light tables and frames.
ToyRender make_sheet_render(std::uint32_t columns, std::uint32_t rows) {
    const TemporaryFile file(".glb", sheet_glb(columns, rows));
    Scene sheet = load_gltf(file.path());
    ToyScene toy = make_floor();
    toy.scene.materials.push_back(sheet.materials.at(0));
    sheet.meshes.at(0).material = MaterialIndex(toy.scene.materials.size() - 1);
    toy.scene.meshes.push_back(std::move(sheet.meshes.at(0)));
    toy.add_instance(MeshIndex(toy.scene.meshes.size() - 1));
    return make_render(toy);
}

double mean_of_floor(ToyRender& render, DirectMode mode, int frames) {
    const Image image = render.render(look_at_floor(render), mode, frames);
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < HEIGHT_PX; ++y) {
        for (int x = 0; x < WIDTH_PX; ++x) {
            if (render.seen_instance(x, y) != 0) continue;
            sum += image.pixel(x, y)[1];
            ++count;
        }
    }
    EXPECT_GT(count, 3000);
    return sum / count;
}

TEST_F(OddLights, AMillionTrianglesShineAsTwoOfTheSameShape) {
    ToyRender two = make_sheet_render(1, 1);
    ToyRender million = make_sheet_render(1000, 500);
    ASSERT_EQ(two.world().lights.count, 2u);
    ASSERT_EQ(million.world().lights.count, 1000000u);
    for (const DirectMode mode : MODES) {
        const double expected = mean_of_floor(two, mode, 8);
        EXPECT_GT(expected, 0.01);
        // The floor is at least 1.5 m below, so that one draw deviates by at most its own mean: six standard
        // errors of the difference of 8 x 3000 draws each.
        EXPECT_NEAR(mean_of_floor(million, mode, 8), expected, 6.0 * expected * std::sqrt(2.0 / 24000.0));
    }
}

// ---- Where a light may be -----------------------------------------------------------------------

// The middle pixel looks at the light itself: distance 0 there, grazing everywhere else.
TEST_F(OddLights, APointLightOnASurfaceIsFinite) {
    ToyScene toy = make_floor();
    toy.add_light(make_point(1.0f), at_place(0.0, 0.0, 0.0));
    ToyRender render = make_render(toy);
    for (const DirectMode mode : MODES)
        render.render(render.look({0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 5.0), mode, 4);
}

TEST_F(OddLights, AnEmitterFlushWithTheFloorDoesNotLightIt) {
    ToyScene toy = make_floor();
    const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(10.0f)));
    toy.add_quad(lamp, {4.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f});
    ToyRender render = make_render(toy);
    const CameraRecord camera = render.look({3.0, 2.0, 2.0}, {4.0, 0.0, 0.0}, 50.0);
    for (const DirectMode mode : MODES) {
        const Image image = render.render(camera, mode, 4);
        int floor = 0, lamp_pixels = 0;
        for (int y = 0; y < HEIGHT_PX; ++y) {
            for (int x = 0; x < WIDTH_PX; ++x) {
                const std::uint32_t seen = render.seen_instance(x, y);
                // The cosine is 0 up to the rounding of the position.
                if (seen == 0) {
                    ++floor;
                    EXPECT_LT(image.pixel(x, y)[1], 1e-4f);
                } else if (seen == 1) {
                    ++lamp_pixels;
                    EXPECT_EQ(image.pixel(x, y)[1], 10.0f);
                }
            }
        }
        EXPECT_GT(floor, 500);
        EXPECT_GT(lamp_pixels, 200);
    }
}

TEST_F(OddLights, ALightInsideGeometryLightsNothingOutside) {
    ToyScene toy = make_floor();
    const MaterialIndex grey = toy.add_material(lambert_material(glm::vec3(0.5f)));
    toy.add_instance(toy.add_mesh(grey, sphere_corners(0.75f, 12)), at_place(0.0, 0.75, 0.0));
    toy.add_light(make_point(100.0f), at_place(0.1, 0.8, 0.05));
    ToyRender render = make_render(toy);
    for (const DirectMode mode : MODES)
        EXPECT_EQ(mean_of(render.render(look_at_floor(render), mode, 8)), 0.0);
}

// A single-sided emitter in the plane x = 0, seen edge-on by the middle column: one half of the floor is lit,
// the other exactly black.
TEST_F(OddLights, AnEmitterEdgeOnLightsOneSide) {
    ToyScene toy = make_floor();
    const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(10.0f)));
    toy.add_quad(lamp, {0.0f, 0.5f, 1.0f}, {0.0f, 0.0f, -2.0f}, {0.0f, 1.0f, 0.0f});
    ToyRender render = make_render(toy);
    const CameraRecord camera = render.look({0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 50.0);
    for (const DirectMode mode : MODES) {
        const Image image = render.render(camera, mode, 4);
        int left = 0, right = 0, right_pixels = 0;
        for (int y = 0; y < HEIGHT_PX; ++y) {
            for (int x = 0; x < WIDTH_PX; ++x) {
                if (render.seen_instance(x, y) != 0 || x == WIDTH_PX / 2) continue;
                (x < WIDTH_PX / 2 ? left : right) += image.pixel(x, y)[1] > 0.0f;
                right_pixels += x > WIDTH_PX / 2;
            }
        }
        EXPECT_EQ(std::min(left, right), 0);
        EXPECT_EQ(std::max(left, right), right_pixels);
    }
}

}  // namespace
}  // namespace tarn::test
