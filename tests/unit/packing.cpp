// Packing: octahedral directions and all records come back as they went in.
#include "shared/math/packing.h"

#include <gtest/gtest.h>

#include "shared/interface/records.h"
#include "support/draws.h"
#include "world/scene_access.h"

namespace tarn {
namespace {

using glm::dvec3;
using test::Draws;

double octahedral_error(const vec3& n) {
    return glm::length(dvec3(decode_octahedral(encode_octahedral(n))) - glm::normalize(dvec3(n)));
}

TEST(Octahedral, RoundTripIsGoodToAMillionthForRandomDirections) {
    Draws draws(1);
    for (int i = 0; i < 200'000; ++i) EXPECT_LT(octahedral_error(draws.unit_vector()), 1e-6);
}

TEST(Octahedral, RoundTripOfTheAxesIsExactWithEitherSignOfZero) {
    for (const float zero : {0.0f, -0.0f}) {
        for (const float one : {1.0f, -1.0f}) {
            EXPECT_EQ(octahedral_error(vec3(one, zero, zero)), 0.0);
            EXPECT_EQ(octahedral_error(vec3(zero, one, zero)), 0.0);
            EXPECT_EQ(octahedral_error(vec3(zero, zero, one)), 0.0);
        }
    }
}

TEST(Octahedral, StaysInItsSquareAndUnitAlongTheFold) {
    Draws draws(2);
    for (int i = 0; i < 10'000; ++i) {
        const vec3 d = draws.unit_vector();
        const vec3 n = normalize(vec3(d.x, d.y, d.z * 1e-6f));
        const vec2 p = encode_octahedral(n);
        EXPECT_LE(std::abs(p.x), 1.0f);
        EXPECT_LE(std::abs(p.y), 1.0f);
        EXPECT_LT(octahedral_error(n), 1e-6);
        EXPECT_NEAR(length(decode_octahedral(p)), 1.0f, 2e-7f);
    }
}

TEST(Rows, KeepEveryBitOfFloatsAndWords) {
    Draws draws(3);
    for (int i = 0; i < 1000; ++i) {
        const uvec4 row(draws.bits(), draws.bits(), draws.bits(), draws.bits());
        // Signalling NaNs may turn quiet in a float register; numbers may not change.
        if (!is_finite3(row_xyz(row)) || !is_finite(uintBitsToFloat(row.w))) continue;
        EXPECT_EQ(pack_row4(row_xyzw(row)), row);
        EXPECT_EQ(pack_row(row_xyz(row), row.w), row);
    }
}

// ---- Records
// ------------------------------------------------------------------------------------------------------

TEST(Records, VertexRoundTripThroughTheSceneFunctions) {
    Draws draws(4);
    World world;
    world.vertex_rows.resize(3 * VERTEX_ROWS);
    Vertex vertices[3];
    for (int i = 0; i < 3; ++i) {
        Vertex& v = vertices[i];
        v.position_os = draws.unit_vector();
        v.normal_os = draws.unit_vector();
        v.tangent_os = vec4(draws.unit_vector(), -1.0f);
        v.uv0 = draws.uniform_vec2();
        v.uv1 = draws.uniform_vec2();
        v.color = vec4(draws.uniform_vec3(), draws.uniform_float());
        glm::uvec4* rows = &world.vertex_rows[std::size_t(i) * VERTEX_ROWS];
        pack_vertex(v, rows[0], rows[1], rows[2], rows[3]);
    }
    SceneAccess access(world);
    for (uint i = 0; i < 3u; ++i) {
        EXPECT_EQ(access.load_position_os(i), vertices[i].position_os);
        EXPECT_EQ(row_xyz(access.fetch_vertex_row(i * VERTEX_ROWS + 1u)), vertices[i].normal_os);
        EXPECT_EQ(row_xyzw(access.fetch_vertex_row(i * VERTEX_ROWS + 2u)), vertices[i].tangent_os);
        EXPECT_EQ(access.load_uv0(i), vertices[i].uv0);
        // At a corner of the triangle (i, i, i) interpolation is that vertex.
        const SceneAccess::VertexExtras extras = access.interpolate_extras(uvec3(i), vec2(0.25f, 0.5f));
        EXPECT_EQ(extras.uv0, vertices[i].uv0);
        EXPECT_LT(length(extras.uv1 - vertices[i].uv1), 1e-6f);
        EXPECT_LT(length(extras.color - vertices[i].color), 2.0f / 65535.0f);
    }
}

TEST(Records, VertexColorsZeroAndOneAreExactAndOthersAreClamped) {
    Vertex v{};
    v.color = vec4(0.0f, 1.0f, -3.0f, 7.0f);
    uvec4 rows[VERTEX_ROWS];
    pack_vertex(v, rows[0], rows[1], rows[2], rows[3]);
    const World world;
    EXPECT_EQ(SceneAccess(world).unpack_color(rows[3]), vec4(0, 1, 0, 1));
}

TEST(Records, InstanceRowsBecomeItsMatrixAndIndices) {
    uvec4 rows[INSTANCE_ROWS];
    for (uint i = 0; i < 3u; ++i) rows[i] = pack_row4(vec4(4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3));
    rows[3] = uvec4(100u, 200u, 300u, INSTANCE_MIRRORED);
    const InstanceRecord r = unpack_instance(rows[0], rows[1], rows[2], rows[3]);
    EXPECT_EQ(r.world_from_object[0], vec4(0, 1, 2, 3));
    EXPECT_EQ(r.world_from_object[1], vec4(4, 5, 6, 7));
    EXPECT_EQ(r.world_from_object[2], vec4(8, 9, 10, 11));
    EXPECT_EQ(r.first_triangle, 100u);
    EXPECT_EQ(r.first_vertex, 200u);
    EXPECT_EQ(r.material, 300u);
    EXPECT_EQ(r.flags, INSTANCE_MIRRORED);
}

TEST(Records, MaterialRoundTripKeepsEveryBit) {
    MaterialRecord m;
    m.base_color = vec4(0.1f, 0.2f, 0.3f, 0.4f);
    m.emission = vec3(5.0f, 6.0f, 7.0f);
    m.alpha_cutoff = 0.5f;
    m.metallic = 0.6f;
    m.roughness = 0.7f;
    m.normal_scale = -0.8f;
    m.flags = MATERIAL_DOUBLE_SIDED | MATERIAL_ALPHA_MASK;
    m.dielectric_f0 = vec3(0.04f, 0.05f, 0.06f);
    m.dielectric_f90 = 0.9f;
    uvec4 rows[4];
    pack_material(m, rows[0], rows[1], rows[2], rows[3]);
    const MaterialRecord back = unpack_material(rows[0], rows[1], rows[2], rows[3]);
    EXPECT_EQ(back.base_color, m.base_color);
    EXPECT_EQ(back.emission, m.emission);
    EXPECT_EQ(back.alpha_cutoff, m.alpha_cutoff);
    EXPECT_EQ(back.metallic, m.metallic);
    EXPECT_EQ(back.roughness, m.roughness);
    EXPECT_EQ(back.normal_scale, m.normal_scale);
    EXPECT_EQ(back.flags, m.flags);
    EXPECT_EQ(back.dielectric_f0, m.dielectric_f0);
    EXPECT_EQ(back.dielectric_f90, m.dielectric_f90);
}

TEST(Records, TextureSlotRoundTripKeepsEveryBit) {
    const SlotRecord s{123u,  640u | 480u << 16u, SLOT_PRESENT | SLOT_SECOND_UV,
                       0.25f, vec2(1.5f, 2.5f),   vec2(-3.0f, 4.0f)};
    uvec4 rows[2];
    pack_slot(s, rows[0], rows[1]);
    const SlotRecord back = unpack_slot(rows[0], rows[1]);
    EXPECT_EQ(back.first_texel, s.first_texel);
    EXPECT_EQ(back.size, s.size);
    EXPECT_EQ(back.flags, s.flags);
    EXPECT_EQ(back.rotation_rad, s.rotation_rad);
    EXPECT_EQ(back.offset, s.offset);
    EXPECT_EQ(back.scale, s.scale);
}

TEST(Records, SlotFlagsDoNotOverlapTheWrapModes) {
    EXPECT_EQ((SLOT_PRESENT | SLOT_NEAREST | SLOT_SECOND_UV) & 15u, 0u);
    EXPECT_EQ(SLOT_PRESENT & SLOT_NEAREST & SLOT_SECOND_UV, 0u);
}

TEST(Records, RayRoundTripKeepsEveryBitAndAnInactiveRayIsNegative) {
    const RayRecord ray{vec3(1.0f, 2.0f, 3.0f), 0.999f, vec3(-4.0f, 5.0f, -6.0f), 123456u};
    uvec4 rows[RAY_ROWS];
    pack_ray(ray, rows[0], rows[1]);
    const RayRecord back = unpack_ray(rows[0], rows[1]);
    EXPECT_EQ(back.origin, ray.origin);
    EXPECT_EQ(back.max_t, ray.max_t);
    EXPECT_EQ(back.direction, ray.direction);
    EXPECT_EQ(back.pixel, ray.pixel);
    EXPECT_LT(inactive_ray().max_t, 0.0f);
}

// ---- Texture transform and camera
// -----------------------------------------------------------------------------------

TEST(TextureTransform, ScalesThenTurnsThenMoves) {
    const World world;
    SceneAccess access(world);
    SlotRecord slot{0u, 0u, SLOT_PRESENT, 0.0f, vec2(0.25f, 0.5f), vec2(2.0f, 3.0f)};
    EXPECT_EQ(access.slot_uv(slot, vec2(0.5f, 1.0f), vec2(9.0f)), vec2(1.25f, 3.5f));
    // A quarter turn counter-clockwise, V pointing down, takes +U to -V and +V to +U.
    slot.rotation_rad = PI / 2.0f;
    const vec2 turned = access.slot_uv(slot, vec2(1.0f, 0.0f), vec2(9.0f));
    EXPECT_NEAR(turned.x, 0.25f, 1e-6f);
    EXPECT_NEAR(turned.y, 0.5f - 2.0f, 1e-6f);
    slot.flags |= SLOT_SECOND_UV;
    EXPECT_NEAR(access.slot_uv(slot, vec2(1.0f, 0.0f), vec2(0.0f, 1.0f)).x, 3.25f, 1e-6f);
}

TEST(CameraRay, CornersAndCentreOfThePictureAreWhereTheyBelong) {
    const CameraRecord camera{vec3(1, 2, 3), vec3(2, 0, 0), vec3(0, 1, 0), vec3(0, 0, -1), false};
    const PixelRay centre = camera_ray(camera, vec2(320, 180), vec2(640, 360));
    EXPECT_EQ(centre.origin, vec3(1, 2, 3));
    EXPECT_EQ(centre.direction, vec3(0, 0, -1));
    const PixelRay upper_left = camera_ray(camera, vec2(0, 0), vec2(640, 360));
    EXPECT_LT(length(upper_left.direction - normalize(vec3(-2, 1, -1))), 1e-6f);
    const PixelRay lower_right = camera_ray(camera, vec2(640, 360), vec2(640, 360));
    EXPECT_LT(length(lower_right.direction - normalize(vec3(2, -1, -1))), 1e-6f);
}

TEST(CameraRay, AnOrthographicCameraMovesItsOriginAndKeepsItsDirection) {
    const CameraRecord camera{vec3(1, 2, 3), vec3(2, 0, 0), vec3(0, 1, 0), vec3(0, 0, -1), true};
    const PixelRay ray = camera_ray(camera, vec2(0, 360), vec2(640, 360));
    EXPECT_EQ(ray.origin, vec3(-1, 1, 3));
    EXPECT_EQ(ray.direction, vec3(0, 0, -1));
}

}  // namespace
}  // namespace tarn
