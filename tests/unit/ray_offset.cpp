// Ray origins: the error bound holds against double precision, and the origin leaves on the right side of its
// triangle.
#include "shared/math/ray_offset.h"

#include <gtest/gtest.h>

#include <functional>

#include "support/draws.h"
#include "world/scene_access.h"

namespace tarn {
namespace {

using glm::dvec3;
using test::Draws;

struct Triangle {
    World world;  // one instance of one triangle
    vec3 corners_os[3];
    glm::dmat4x3 world_from_object;
};

// A triangle of edge `size`, `distance` from its object's origin, turned, scaled unevenly and moved by
// `offset`.
Triangle make_triangle(Draws& draws, double size, double distance, double scale, double offset) {
    Triangle t;
    t.world.vertex_rows.resize(3 * VERTEX_ROWS);
    const vec3 centre = draws.unit_vector() * float(distance);
    for (int i = 0; i < 3; ++i) {
        Vertex v{};
        v.position_os = centre + draws.unit_vector() * float(size);
        v.normal_os = vec3(0, 0, 1);
        t.corners_os[i] = v.position_os;
        glm::uvec4* rows = &t.world.vertex_rows[std::size_t(i) * VERTEX_ROWS];
        pack_vertex(v, rows[0], rows[1], rows[2], rows[3]);
    }
    t.world.triangles = {glm::uvec3(0, 1, 2)};
    t.world.material_rows.resize(MATERIAL_ROWS);
    const vec3 move = draws.unit_vector() * float(offset);
    for (int row = 0; row < 3; ++row) {
        const vec3 r = draws.unit_vector() * float(scale * draws.uniform(0.5, 2.0));
        t.world.instance_rows.push_back(pack_row4(vec4(r, move[row])));
        for (int c = 0; c < 3; ++c) t.world_from_object[c][row] = r[c];
        t.world_from_object[3][row] = move[row];
    }
    t.world.instance_rows.push_back(uvec4(0u));
    return t;
}

dvec3 exact_point(const Triangle& t, const vec2& barycentrics) {
    const double u = barycentrics.x, v = barycentrics.y;
    const dvec3 p =
        dvec3(t.corners_os[0]) * (1.0 - u - v) + dvec3(t.corners_os[1]) * u + dvec3(t.corners_os[2]) * v;
    return t.world_from_object * glm::dvec4(p, 1.0);
}

dvec3 exact_normal(const Triangle& t) {
    const dvec3 p0 = exact_point(t, vec2(0, 0)), p1 = exact_point(t, vec2(1, 0)),
                p2 = exact_point(t, vec2(0, 1));
    return glm::normalize(glm::cross(p1 - p0, p2 - p0));
}

vec2 random_barycentrics(Draws& draws) {
    const vec2 u = draws.uniform_vec2();
    return u.x + u.y > 1.0f ? vec2(1.0f) - u : u;
}

// Runs `check` over triangles of many sizes, scales and places.
void for_many_triangles(const std::function<void(const Triangle&, Draws&)>& check) {
    Draws draws(1);
    for (const double size : {1e-3, 1.0, 100.0}) {
        for (const double distance : {0.0, 10.0, 1e4}) {
            for (const double scale : {1e-2, 1.0, 50.0}) {
                for (const double offset : {0.0, 1.0, 1e3, 1e5}) {
                    for (int i = 0; i < 20; ++i)
                        check(make_triangle(draws, size, distance, scale, offset), draws);
                }
            }
        }
    }
}

TEST(RayOffset, PositionStaysWithinItsErrorBound) {
    double worst = 0.0;
    for_many_triangles([&](const Triangle& t, Draws& draws) {
        const vec2 b = random_barycentrics(draws);
        const ShadingPoint p = SceneAccess(t.world).evaluate_surface(0u, 0u, b, draws.unit_vector()).point;
        for (int c = 0; c < 3; ++c) {
            const double error = std::abs(double(p.position[c]) - exact_point(t, b)[c]);
            EXPECT_LE(error, p.position_error);
            worst = std::max(worst, error / p.position_error);
        }
    });
    // Half of the bound belongs to the tracer's own rounding, and the rest was doubled for safety.
    EXPECT_LT(worst, 0.25);
    EXPECT_GT(worst, 0.01) << "the bound is needlessly wide";
}

// False for tiny triangles far from their object's origin, whose normal rounding itself has turned or undone.
bool is_normal_sound(const Triangle& t, const ShadingPoint& p) {
    return std::abs(glm::dot(exact_normal(t), dvec3(p.geometric_normal))) > 0.99999;
}

// Distance of the ray's origin from the triangle's exact plane, towards the side that `direction` leaves to.
double clearance(const Triangle& t, const vec2& b, const vec3& position, float error, const vec3& normal,
                 const vec3& direction) {
    const dvec3 plane = exact_normal(t) * (glm::dot(exact_normal(t), dvec3(normal)) < 0.0 ? -1.0 : 1.0);
    const double side = dot(normal, direction) >= 0.0f ? 1.0 : -1.0;
    const vec3 origin = offset_ray_origin(position, error, normal, direction);
    return side * glm::dot(plane, dvec3(origin) - exact_point(t, b));
}

TEST(RayOffset, OriginLiesOnTheSideOfTheTrianglesExactPlaneThatTheRayLeavesTo) {
    int checked = 0;
    for_many_triangles([&](const Triangle& t, Draws& draws) {
        const vec2 b = random_barycentrics(draws);
        const vec3 direction = draws.unit_vector();
        const ShadingPoint p = SceneAccess(t.world).evaluate_surface(0u, 0u, b, draws.unit_vector()).point;
        // A normal that rounding itself has turned is another matter: tiny triangles far from their object's
        // origin.
        if (!is_normal_sound(t, p)) return;
        EXPECT_GT(clearance(t, b, p.position, p.position_error, p.geometric_normal, direction), 0.0);
        ++checked;
    });
    EXPECT_GT(checked, 1500);
}

TEST(RayOffset, NegativeControlAFixedEpsilonEndsUpOnTheWrongSide) {
    int wrong = 0;
    for_many_triangles([&](const Triangle& t, Draws& draws) {
        const vec2 b = random_barycentrics(draws);
        const vec3 direction = draws.unit_vector();
        const ShadingPoint p = SceneAccess(t.world).evaluate_surface(0u, 0u, b, draws.unit_vector()).point;
        if (!is_normal_sound(t, p)) return;
        if (clearance(t, b, p.position, 1e-4f, p.geometric_normal, direction) <= 0.0) ++wrong;
    });
    EXPECT_GT(wrong, 0);
}

TEST(RayOffset, MovesAlongTheNormalForwardsAndBackwardsByTheErrorTimesItsL1Norm) {
    const vec3 n = vec3(0.6f, 0.0f, -0.8f);
    EXPECT_LT(length(offset_ray_origin(vec3(0.0f), 0.1f, n, n) - n * 0.14f), 1e-7f);
    EXPECT_LT(length(offset_ray_origin(vec3(0.0f), 0.1f, n, -n) + n * 0.14f), 1e-7f);
    EXPECT_LT(length(offset_ray_origin(vec3(0.0f), 0.1f, n, vec3(0, 1, 0)) - n * 0.14f), 1e-7f)
        << "tangential";
}

TEST(RayOffset, OffsetAtOneHundredKilometresIsCentimetresAndAtTheOriginMicrometres) {
    EXPECT_LT(position_error_bound(1e5f), 0.3f);
    EXPECT_GT(position_error_bound(1e5f), 0.01f);
    EXPECT_LT(position_error_bound(1.0f), 3e-6f);
}

}  // namespace
}  // namespace tarn
