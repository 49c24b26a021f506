// Where a surface's textures are read and what becomes of it: coverage that rays meet and radiance that
// surfaces and lights send, against glTF's definitions in double precision.
#include <gtest/gtest.h>

#include <functional>

#include "rays/ray_checks.h"
#include "support/draws.h"
#include "support/texture_oracle.h"
#include "support/toy_scenes.h"
#include "world/scene_access.h"

namespace tarn {
namespace {

using glm::dvec2;
using glm::dvec4;
using test::Draws;

// ---- One quad with textures
// -----------------------------------------------------------------------------------------

// The unit square of the xy plane, facing +Z, with one texture for base colour and one for emission. Texture
// coordinates and colour are affine in the place, the two sets of coordinates unlike each other.
struct Sheet {
    Material material;
    TextureImage images[2];  // base colour, emission
    Texture textures[2];
    glm::dmat3x2 uv_sets[2]{glm::dmat3x2(0.0), glm::dmat3x2(0.0)};  // times (x, y, 1)
    glm::dvec3 vertex_alpha{0.0, 0.0, 1.0};                         // dot (x, y, 1)
};

World build_sheet(const Sheet& sheet) {
    ToyScene toy;
    Material material = sheet.material;
    TextureSlot* slots[] = {&material.base_color_map, &material.emission_map};
    for (std::uint32_t i = 0; i < 2; ++i) {
        toy.scene.images.push_back(sheet.images[i]);
        toy.scene.textures.push_back(sheet.textures[i]);
        toy.scene.textures.back().image = ImageIndex(i);
        slots[i]->texture = TextureIndex(i);
    }
    toy.add_quad(toy.add_material(material), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    Mesh& mesh = toy.scene.meshes.back();
    for (const glm::vec3& position : mesh.positions_os) {
        const glm::dvec3 place(position.x, position.y, 1.0);
        mesh.uv0.emplace_back(sheet.uv_sets[0] * place);
        mesh.uv1.emplace_back(sheet.uv_sets[1] * place);
        mesh.colors.emplace_back(1.0f, 1.0f, 1.0f, float(glm::dot(sheet.vertex_alpha, place)));
    }
    return build_world(toy.scene);
}

TextureImage random_image(Draws& draws, int width, int height) {
    TextureImage image;
    image.width = width;
    image.height = height;
    for (int i = 0; i < width * height; ++i) {
        const std::uint32_t a = draws.bits(), b = draws.bits();
        image.texels.emplace_back(a & 0xffffu, a >> 16, b & 0xffffu, b >> 16);
    }
    return image;
}

Wrap random_wrap(Draws& draws) {
    return Wrap(draws.bits() % 3u);
}

TextureSlot random_slot(Draws& draws) {
    TextureSlot slot;
    slot.uv_set = int(draws.bits() % 2u);
    slot.offset = glm::vec2(draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0));
    slot.scale = glm::vec2(draws.uniform(0.5, 2.0), draws.uniform(-2.0, -0.5));
    slot.rotation_rad = float(draws.uniform(-3.0, 3.0));
    return slot;
}

Sheet random_sheet(Draws& draws) {
    Sheet sheet;
    for (int i = 0; i < 2; ++i) {
        sheet.images[i] = random_image(draws, 5, 3);
        sheet.textures[i].wrap_u = random_wrap(draws);
        sheet.textures[i].wrap_v = random_wrap(draws);
        sheet.textures[i].nearest = draws.bits() % 2u == 0u;
        for (int column = 0; column < 3; ++column) {
            sheet.uv_sets[i][column] = dvec2(draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0));
        }
    }
    sheet.material.base_color_map = random_slot(draws);
    sheet.material.emission_map = random_slot(draws);
    return sheet;
}

// ---- What glTF says of it
// -------------------------------------------------------------------------------------------

// KHR_texture_transform: translation * rotation * scale. Its rotation is counter-clockwise where v points
// down, which is clockwise where it points up; its example, below, fixes the sign.
dvec2 transform_by_definition(const TextureSlot& slot, const dvec2& uv) {
    const double c = std::cos(double(slot.rotation_rad)), s = std::sin(double(slot.rotation_rad));
    const glm::dmat2 rotation(c, -s, s, c);  // by columns
    const glm::dmat2 scale(slot.scale.x, 0.0, 0.0, slot.scale.y);
    return dvec2(slot.offset) + rotation * scale * uv;
}

// The texture's value at a place of the sheet. `edge_distance` shrinks to the distance, in texels, from there
// to the nearest place where the value jumps.
dvec4 look_up(const Sheet& sheet, int which, const TextureSlot& slot, const dvec2& place,
              double& edge_distance) {
    const TextureImage& image = sheet.images[which];
    const Texture& texture = sheet.textures[which];
    const dvec2 uv = transform_by_definition(slot, sheet.uv_sets[slot.uv_set] * glm::dvec3(place, 1.0));
    const ivec2 size(image.width, image.height);
    const auto texel = [&](int x, int y) {
        return dvec4(image.texels[std::size_t(y) * std::size_t(size.x) + std::size_t(x)]) / 65535.0;
    };
    const uint wrap_u = uint(texture.wrap_u), wrap_v = uint(texture.wrap_v);
    if (texture.nearest) {
        const dvec2 at = uv * dvec2(size), cell = glm::floor(at);
        for (int axis = 0; axis < 2; ++axis) {
            edge_distance = std::min({edge_distance, at[axis] - cell[axis], 1.0 + cell[axis] - at[axis]});
        }
        return texel(test::wrap_by_definition(std::int64_t(cell.x), size.x, wrap_u),
                     test::wrap_by_definition(std::int64_t(cell.y), size.y, wrap_v));
    }
    dvec4 value;
    for (int c = 0; c < 4; ++c) {
        value[c] = test::filter_by_definition(uv, size, wrap_u, wrap_v,
                                              [&](int x, int y) { return texel(x, y)[c]; });
    }
    return value;
}

// Base colour's alpha, texture's alpha and the vertices' alpha, multiplied.
double opacity_by_definition(const Sheet& sheet, const dvec2& place, double& edge_distance) {
    return double(sheet.material.base_color.w) * glm::dot(sheet.vertex_alpha, glm::dvec3(place, 1.0)) *
           look_up(sheet, 0, sheet.material.base_color_map, place, edge_distance).w;
}

// ---- Coverage
// -------------------------------------------------------------------------------------------------------

RayRecord ray_onto(const dvec2& place) {
    RayRecord ray;
    ray.origin = {float(place.x), float(place.y), 1.0f};
    ray.direction = {0.0f, 0.0f, -1.0f};
    ray.max_t = RAY_INFINITY;
    ray.pixel = 0;
    return ray;
}

// Rounding decides nearer than this to a jump, in texels, and to the cutoff.
constexpr double EDGE = 1e-3;

struct Coverage {
    int hits = 0;
    int passes = 0;
    int wrong = 0;
};

// Rays at random places of the sheet, counted by what `expect` says of the opacity there (1 hits, 0 passes,
// -1 unknown), with both tracers.
void count_coverage(const Sheet& sheet, Draws& draws, const std::function<int(double)>& expect,
                    Coverage& count) {
    const World world = build_sheet(sheet);
    // The world moves its origin to the middle of the scene.
    const dvec2 origin(world.origin_ws);
    const auto embree = create_embree_tracer(world);
    const auto oracle = create_brute_force_tracer(world);
    for (int i = 0; i < 100; ++i) {
        const dvec2 place(draws.uniform(0.01, 0.99), draws.uniform(0.01, 0.99));
        double edge_distance = 1.0;
        const int expected = expect(opacity_by_definition(sheet, place, edge_distance));
        if (expected < 0 || edge_distance < EDGE) continue;
        ++(expected == 1 ? count.hits : count.passes);
        const RayRecord ray = ray_onto(place - origin);
        for (const auto* tracer : {embree.get(), oracle.get()}) {
            count.wrong += tracer->is_visible(ray, {}) != (expected == 0);
            count.wrong += tracer->trace_closest(ray, {}).has_value() != (expected == 1);
        }
    }
}

TEST(TextureSlots, AMaskIsMetWhereTheProductOfItsAlphasReachesTheCutoff) {
    Draws draws(1);
    Coverage count;
    for (int i = 0; i < 60; ++i) {
        Sheet sheet = random_sheet(draws);
        sheet.material.alpha_mode = AlphaMode::MASK;
        sheet.material.base_color.w = float(draws.uniform(0.5, 1.0));
        sheet.material.alpha_cutoff = float(draws.uniform(0.1, 0.4));
        sheet.vertex_alpha = {draws.uniform(-0.4, 0.0), draws.uniform(-0.4, 0.0), 1.0};
        const double cutoff = sheet.material.alpha_cutoff;
        count_coverage(
            sheet, draws,
            [&](double opacity) { return std::abs(opacity - cutoff) < EDGE ? -1 : int(opacity > cutoff); },
            count);
    }
    EXPECT_EQ(count.wrong, 0);
    EXPECT_GT(count.hits, 1000);
    EXPECT_GT(count.passes, 1000);
}

TEST(TextureSlots, ABlendedSheetIsAlwaysMetWhereItIsWholeAndNeverWhereItIsNot) {
    Draws draws(2);
    Coverage count;
    for (int i = 0; i < 60; ++i) {
        Sheet sheet = random_sheet(draws);
        sheet.material.alpha_mode = AlphaMode::BLEND;
        sheet.textures[0].nearest = true;
        for (glm::u16vec4& texel : sheet.images[0].texels) texel.w = texel.w < 30000 ? 0 : 65535;
        count_coverage(
            sheet, draws, [](double opacity) { return int(opacity > 0.5); }, count);
    }
    EXPECT_EQ(count.wrong, 0);
    EXPECT_GT(count.hits, 1000);
    EXPECT_GT(count.passes, 1000);
}

// A sheet with uv = (x, 1 - y), so that the image stands upright, opaque in one of its quarters alone.
Sheet quarter_sheet(int column, int row) {
    Sheet sheet;
    sheet.material.alpha_mode = AlphaMode::MASK;
    sheet.material.emission = glm::vec3(1.0f);
    for (int i = 0; i < 2; ++i) {
        sheet.images[i].width = sheet.images[i].height = 2;
        sheet.images[i].texels.assign(4, glm::u16vec4(0));
        sheet.images[i].texels[std::size_t(2 * row + column)] = glm::u16vec4(65535);
        sheet.textures[i].nearest = true;
        sheet.uv_sets[i] = glm::dmat3x2(1, 0, 0, -1, 0, 1);
    }
    return sheet;
}

// "This example utilizes only the lower left quadrant of the source image, rotated clockwise 90 degrees."
TextureSlot example_of_the_extension() {
    TextureSlot slot;
    slot.offset = {0.0f, 1.0f};
    slot.rotation_rad = 1.57079632679f;
    slot.scale = {0.5f, 0.5f};
    return slot;
}

TEST(TextureSlots, TheExampleOfTheExtensionShowsTheLowerLeftQuarterAlone) {
    for (int quarter = 0; quarter < 4; ++quarter) {
        const bool shown = quarter == 2;
        Sheet sheet = quarter_sheet(quarter % 2, quarter / 2);
        sheet.material.base_color_map = sheet.material.emission_map = example_of_the_extension();
        const World world = build_sheet(sheet);
        const auto tracer = create_brute_force_tracer(world);
        for (const double x : {0.1, 0.4, 0.9}) {
            for (const double y : {0.2, 0.6, 0.95}) {
                const RayRecord ray = ray_onto(dvec2(x, y) - dvec2(world.origin_ws));
                EXPECT_EQ(tracer->is_visible(ray, {}), !shown) << quarter << " " << x << " " << y;
            }
        }
        sheet.material.alpha_mode = AlphaMode::OPAQUE;
        const World opaque = build_sheet(sheet);
        SceneAccess access(opaque);
        EXPECT_EQ(access.load_triangle_radiance(access.load_light(0), {0.3f, 0.3f}).x, shown ? 1.0f : 0.0f);
    }
}

// ---- Emission
// -------------------------------------------------------------------------------------------------------

// Places on both triangles of the sheet: what their light sends, and the surface that a ray would meet there,
// against emission by definition, `covered(opacity)` of it (-1: unknown). Returns the places compared.
int compare_emission(const Sheet& sheet, Draws& draws, const std::function<double(double)>& covered) {
    const World world = build_sheet(sheet);
    SceneAccess access(world);
    const dvec2 corners[2][3] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
    int compared = 0;
    for (std::uint32_t primitive = 0; primitive < 2; ++primitive) {
        const Light light = access.load_light(world.lights.light_of_primitive[primitive]);
        for (int i = 0; i < 50; ++i) {
            const glm::vec2 b = sample_triangle(draws.uniform_vec2());
            const dvec2* c = corners[primitive];
            const dvec2 place =
                c[0] * (1.0 - double(b.x) - double(b.y)) + c[1] * double(b.x) + c[2] * double(b.y);
            double edge_distance = 1.0;
            const double share = covered(opacity_by_definition(sheet, place, edge_distance));
            const glm::dvec3 emitted =
                glm::dvec3(sheet.material.emission) *
                glm::dvec3(look_up(sheet, 1, sheet.material.emission_map, place, edge_distance));
            if (share < 0.0 || edge_distance < EDGE) continue;
            ++compared;
            const glm::vec3 sent = access.load_triangle_radiance(light, b);
            const Surface surface = access.evaluate_surface(0, primitive, b, {0.0f, 0.0f, -1.0f});
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(sent[channel], share * emitted[channel], 1e-3);
                EXPECT_NEAR(surface.emission[channel], emitted[channel], 1e-3);
            }
        }
    }
    return compared;
}

TEST(TextureSlots, LightsAndSurfacesEmitWhatTheirMapSaysThere) {
    Draws draws(3);
    int compared = 0;
    for (int i = 0; i < 60; ++i) {
        Sheet sheet = random_sheet(draws);
        sheet.material.emission = {1.0f, 2.0f, 3.0f};
        compared += compare_emission(sheet, draws, [](double) { return 1.0; });
    }
    EXPECT_GT(compared, 5000);
}

TEST(TextureSlots, LightsEmitTheShareThatTheirCoverageLeavesThem) {
    Draws draws(4);
    int compared = 0;
    for (int i = 0; i < 60; ++i) {
        Sheet sheet = random_sheet(draws);
        sheet.material.emission = {1.0f, 2.0f, 3.0f};
        sheet.material.base_color.w = 0.8f;
        sheet.vertex_alpha = {-0.2, -0.4, 1.0};
        sheet.material.alpha_mode = i % 2 == 0 ? AlphaMode::MASK : AlphaMode::BLEND;
        sheet.material.alpha_cutoff = 0.3f;
        compared += compare_emission(sheet, draws, [&](double opacity) {
            if (i % 2 == 1) return opacity;
            const double cutoff = sheet.material.alpha_cutoff;
            return std::abs(opacity - cutoff) < EDGE ? -1.0 : double(opacity > cutoff);
        });
    }
    EXPECT_GT(compared, 5000);
}

// ---- At the cutoff
// --------------------------------------------------------------------------------------------------

// glTF 2.0, 3.9.4: opaque where alpha is greater than or equal to the cutoff. At a vertex nothing is rounded.
TEST(TextureSlots, AnAlphaThatEqualsTheCutoffIsCovered) {
    for (const float cutoff : {0.5f, std::nextafter(0.5f, 1.0f)}) {
        Sheet sheet = quarter_sheet(0, 0);
        for (TextureImage& image : sheet.images) image.texels.assign(4, glm::u16vec4(65535));
        sheet.material.base_color.w = 0.5f;
        sheet.material.alpha_cutoff = cutoff;
        const World world = build_sheet(sheet);
        SceneAccess access(world);
        const bool covered = cutoff == 0.5f;
        EXPECT_EQ(is_hit_covered(world, world.material_rows, {}, 0u, 0u, 0u, {0.0f, 0.0f}), covered)
            << cutoff;
        const glm::vec3 sent = access.load_triangle_radiance(access.load_light(0), {0.0f, 0.0f});
        EXPECT_EQ(sent.x, covered ? 1.0f : 0.0f) << cutoff;
    }
}

}  // namespace
}  // namespace tarn
