// Drawing lights by the tree: probabilities by enumeration, draws by chi-square, and no light that
// could contribute left out.
#include "world/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "support/goodness_of_fit.h"
#include "support/histogram.h"
#include "support/light_tree_cases.h"
#include "world/scene_access.h"

namespace tarn {
namespace {

using namespace test;

// ---- Probabilities
// --------------------------------------------------------------------------------------------------

TEST(LightTree, ProbabilitiesSumToOneAtAnyPoint) {
    for (const int count : {4, 8, 60, 1000}) {
        const LitWorld world = build_random_world(std::uint64_t(count), count);
        Draws draws(1);
        for (int i = 0; i < 50; ++i) {
            EXPECT_NEAR(sum_of(list_pmf(world, draw_point(world, draws))), 1.0, 1e-5) << count;
        }
    }
}

DiscreteSample draw_light(SceneAccess& access, const Receiver& point, std::uint32_t index) {
    return access.choose_light_by_tree(random_bits4({index, 3u, 7u}, DIMENSION_CANDIDATE), point.position,
                                       point.normal);
}

// p value of "draws at this point follow `pmf`".
double draws_p_value(const LitWorld& world, const Receiver& point, const std::vector<float>& pmf) {
    constexpr std::uint32_t DRAW_COUNT = 200'000;
    SceneAccess access(world, &world.light_tree);
    std::vector<double> observed(pmf.size()), expected(pmf.size());
    for (std::size_t i = 0; i < pmf.size(); ++i) expected[i] = double(pmf[i]) * DRAW_COUNT;
    for (std::uint32_t i = 0; i < DRAW_COUNT; ++i) ++observed[draw_light(access, point, i).index];
    return chi_square_test(observed, expected).p_value;
}

constexpr int POINT_COUNT = 8;

TEST(LightTree, DrawsFollowTheirProbabilities) {
    const LitWorld world = build_random_world(5, 200);
    Draws draws(2);
    for (int i = 0; i < POINT_COUNT; ++i) {
        const Receiver point = draw_point(world, draws);
        EXPECT_GT(draws_p_value(world, point, list_pmf(world, point)),
                  sidak_threshold(SIGNIFICANCE, POINT_COUNT));
    }
}

// The light's way down, and a wrong copy of its probability that forgets what was decided at one level.
float pmf_without_level(const LitWorld& world, std::uint32_t light, const Receiver& point, int forgotten) {
    SceneAccess access(world, &world.light_tree);
    const LightTree& tree = world.light_tree;
    float pmf = 1.0f;
    int height = 0;
    for (std::uint32_t node = tree.leaves[light]; node != 0; node = tree.parents[(node - 2) / 2], ++height) {
        const auto pair = access.load_light_tree_pair(node & ~1u, point.position, point.normal);
        const uint share = (node & 1u) == 0u ? pair.left_share : 16777216u - pair.left_share;
        if (height != forgotten) pmf *= float(share) / 16777216.0f;
    }
    return pmf;
}

TEST(LightTree, NegativeControlAProbabilityWithoutOneLevelFails) {
    const LitWorld world = build_random_world(5, 200, false);
    Draws draws(2);
    const Receiver point{draws.unit_vector(), draws.unit_vector()};
    for (const int forgotten : {-1, 0, 2}) {
        std::vector<float> pmf(world.lights.count);
        for (std::uint32_t i = 0; i < pmf.size(); ++i) pmf[i] = pmf_without_level(world, i, point, forgotten);
        const double p_value = draws_p_value(world, point, pmf);
        if (forgotten < 0) {
            EXPECT_GT(p_value, SIGNIFICANCE) << "the copy is right where it forgets nothing";
        } else {
            EXPECT_LT(p_value, SIGNIFICANCE) << forgotten;
            EXPECT_GT(std::abs(sum_of(pmf) - 1.0), 0.1) << forgotten;
        }
    }
}

TEST(LightTree, ADrawReportsTheProbabilityThatItsLightHas) {
    const LitWorld world = build_random_world(6, 300);
    SceneAccess access(world, &world.light_tree);
    Draws draws(3);
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const Receiver point = draw_point(world, draws);
        const DiscreteSample drawn = draw_light(access, point, i);
        ASSERT_LT(drawn.index, world.lights.count);
        ASSERT_GT(drawn.pmf, 0.0f);
        ASSERT_EQ(drawn.pmf, access.light_tree_pmf(drawn.index, point.position, point.normal));
    }
}

// ---- No light is left out
// ---------------------------------------------------------------------------------------------

// What a light sends to the front of a surface from a place that u chooses.
float irradiance_from(SceneAccess& access, std::uint32_t light, vec2 u, const Receiver& point) {
    LightSample sample;
    sample.light = light;
    sample.uv = sample_triangle(u);
    const IncidentLight incident = access.load_incident_light(sample, point.position);
    return max_component(incident.value) * std::max(0.0f, dot(point.normal, incident.direction));
}

// Pairs of point and light where light arrives though the tree says that it is never drawn. `seen` counts the
// pairs where light arrives.
int count_lost_lights(const LitWorld& world, std::uint64_t seed, int& seen) {
    SceneAccess access(world, &world.light_tree);
    Draws draws(seed);
    int lost = 0;
    for (int i = 0; i < 60; ++i) {
        const Receiver point = draw_point(world, draws);
        const std::vector<float> pmf = list_pmf(world, point);
        for (std::uint32_t light = 0; light < world.lights.count; ++light) {
            bool arrives = false;
            for (int s = 0; s < 8; ++s) {
                arrives = arrives || irradiance_from(access, light, draws.uniform_vec2(), point) > 0.0f;
            }
            seen += arrives;
            lost += arrives && !(pmf[light] > 0.0f);
        }
    }
    return lost;
}

TEST(LightTree, EveryLightThatContributesCanBeDrawn) {
    int seen = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        EXPECT_EQ(count_lost_lights(build_random_world(seed, 40), seed, seen), 0) << seed;
    }
    EXPECT_GT(seen, 10'000);
}

// Applies `change` to each inner node and leaf but the root.
template <class Change>
void change_nodes(LitWorld& world, const Change& change) {
    for (std::uint32_t node = 2; node < world.light_tree.node_count; ++node) {
        glm::uvec4* rows = &world.light_tree.rows[std::size_t(node) * LIGHT_TREE_NODE_ROWS];
        LightTreeNode unpacked = unpack_light_tree_node(rows[0], rows[1]);
        change(unpacked);
        pack_light_tree_node(unpacked, rows[0], rows[1]);
    }
}

TEST(LightTree, NegativeControlBoundsThatAreTooNarrowLoseLights) {
    int seen = 0;
    LitWorld world = build_random_world(3, 40);
    change_nodes(world, [](LightTreeNode& node) { node.radius = 0.0f; });
    EXPECT_GT(count_lost_lights(world, 3, seen), 0) << "spheres shrunk to their centres";
    world = build_random_world(3, 40);
    change_nodes(world, [](LightTreeNode& node) { node.cos_normals = 1.0f; });
    EXPECT_GT(count_lost_lights(world, 3, seen), 0) << "cones shrunk to their axes";
    world = build_random_world(3, 40);
    change_nodes(world, [](LightTreeNode& node) { node.link &= ~LIGHT_TREE_TWO_SIDED; });
    EXPECT_GT(count_lost_lights(world, 3, seen), 0) << "backs forgotten";
}

// Lights and surfaces that nearly graze each other's horizons, small and far away, where rounding decides.
TEST(LightTree, LightsAtTheHorizonAreNotLostToRounding) {
    Draws draws(4);
    int lost = 0, seen = 0;
    for (int i = 0; i < 300; ++i) {
        LightScene lights(static_cast<std::uint64_t>(i));
        lights.add_punctual(LightKind::POINT);
        const MaterialIndex lamp = lights.toy().add_material(emissive_material(vec3(1.0f)));
        lights.toy().add_quad(lamp, {0, 0, 0}, {1e-3f, 0, 0}, {0, 0, -1e-3f});  // faces +Y
        const LitWorld world = build_lit_world(lights.scene());
        SceneAccess access(world, &world.light_tree);
        for (std::uint32_t light = 0; light < world.lights.count; ++light) {
            const vec3 place = access.load_light(light).position;
            const float distance = float(std::pow(10.0, draws.uniform(-2.0, 4.0)));
            const float tilt = float(std::pow(10.0, draws.uniform(-9.0, -3.0)));
            const vec3 away =
                normalize(vec3(draws.uniform_float() - 0.5f, tilt, draws.uniform_float() - 0.5f));
            Receiver point{place + away * distance, vec3(0.0f)};
            point.normal = normalize(cross(away, draws.unit_vector()) - away * tilt);
            if (!(irradiance_from(access, light, vec2(0.5f), point) > 0.0f)) continue;
            ++seen;
            lost += !(access.light_tree_pmf(light, point.position, point.normal) > 0.0f);
        }
    }
    EXPECT_EQ(lost, 0);
    EXPECT_GT(seen, 300);
}

// ---- What it is for
// ---------------------------------------------------------------------------------------------------

// Moments of irradiance / pmf with lights drawn by the tree, each light seen from the middle of its surface.
template <class Draw>
RunningMoments estimate(SceneAccess& access, const Receiver& point, const Draw& draw) {
    RunningMoments moments;
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        const DiscreteSample light = draw(i);
        moments.add(double(irradiance_from(access, light.index, vec2(0.5f), point)) / light.pmf);
    }
    return moments;
}

double enumerate_irradiance(SceneAccess& access, const Receiver& point) {
    double sum = 0.0;
    for (std::uint32_t light = 0; light < access.get_light_count(); ++light) {
        sum += irradiance_from(access, light, vec2(0.5f), point);
    }
    return sum;
}

// Variance of irradiance / pmf over all lights. (What was drawn cannot tell it: the rarest lights decide.)
double enumerate_variance(SceneAccess& access, const Receiver& point) {
    double sum = 0.0;
    for (std::uint32_t light = 0; light < access.get_light_count(); ++light) {
        const double value = irradiance_from(access, light, vec2(0.5f), point);
        if (value > 0.0) sum += value * value / access.light_tree_pmf(light, point.position, point.normal);
    }
    const double mean = enumerate_irradiance(access, point);
    return sum - mean * mean;
}

TEST(LightTree, TheMeanOfItsEstimatesIsTheSumOverAllLights) {
    const LitWorld world = build_random_world(8, 120);
    SceneAccess access(world, &world.light_tree);
    Draws draws(5);
    for (int i = 0; i < POINT_COUNT; ++i) {
        const Receiver point{vec3(draws.unit_vector()) * 3.0f, draws.unit_vector()};
        const RunningMoments moments =
            estimate(access, point, [&](std::uint32_t index) { return draw_light(access, point, index); });
        const double variance = enumerate_variance(access, point) / double(moments.count());
        const double z = (moments.mean() - enumerate_irradiance(access, point)) / std::sqrt(variance);
        EXPECT_GT(normal_two_sided_p_value(z), sidak_threshold(SIGNIFICANCE, POINT_COUNT)) << i;
    }
}

// A point light and a triangle of a millimetre, both far away: their irradiance in closed form is also what
// the bounds of nodes without extent come to, but for LIGHT_TREE_SLACK; so no cosine may be near 0.
TEST(LightTree, TwoSmallLightsAreDrawnInProportionToTheIrradianceTheyBring) {
    Draws draws(8);
    int compared = 0;
    for (int i = 0; i < 1500; ++i) {
        const glm::dvec3 places[] = {draws.unit_vector() * 3.0f, draws.unit_vector() * 4.0f};
        const vec3 a = draws.unit_vector() * 1e-3f, b = draws.unit_vector() * 1e-3f;
        const glm::dvec3 area = 0.5 * cross(glm::dvec3(a), glm::dvec3(b));
        ToyScene toy;
        toy.add_light(PunctualLight{}, glm::translate(glm::dmat4(1.0), places[0]));  // 1 W/sr
        const Material lamp = emissive_material(vec3(float(3.0 / length(area))));    // 3 W/sr
        toy.add_instance(toy.add_mesh(toy.add_material(lamp), {vec3(0.0f), a, b}),
                         glm::translate(glm::dmat4(1.0), places[1]));
        const LitWorld world = build_lit_world(toy.scene);
        const glm::dvec3 place = draws.unit_vector(), normal = draws.unit_vector();
        double irradiances[2], least_cosine = 1.0;
        for (int k = 0; k < 2; ++k) {
            const glm::dvec3 way = normalize(places[k] - place);
            const double cosine = dot(normal, way), facing = k == 0 ? 1.0 : -dot(normalize(area), way);
            irradiances[k] = (k == 0 ? 1.0 : 3.0) * std::max(cosine, 0.0) * std::max(facing, 0.0) /
                             dot(places[k] - place, places[k] - place);
            least_cosine = std::min({least_cosine, std::abs(cosine), std::abs(facing)});
        }
        const double sum = irradiances[0] + irradiances[1];
        if (least_cosine < 0.1 || sum == 0.0) continue;
        ++compared;
        const Receiver point{vec3(place - world.origin_ws), vec3(normal)};
        EXPECT_NEAR(list_pmf(world, point)[0], irradiances[0] / sum, 0.01);
    }
    EXPECT_GT(compared, 500);
}

// A hall of small lamps that face down: a point is lit by those around it, which power knows nothing of.
TEST(LightTree, InAHallOfLampsItsVarianceIsAQuarterOfThatByPowerAtMost) {
    ToyScene toy;
    const MaterialIndex lamp = toy.add_material(emissive_material(vec3(5.0f)));
    std::vector<vec3> corners;
    for (int i = 0; i < 1024; ++i) {
        const vec3 place(float(i % 32), 2.0f, float(i / 32));
        corners.insert(corners.end(), {place, place + vec3(0.1f, 0, 0), place + vec3(0, 0, 0.1f)});
    }
    toy.add_instance(toy.add_mesh(lamp, corners));
    const LitWorld world = build_lit_world(toy.scene);
    SceneAccess access(world, &world.light_tree);
    const Receiver point{vec3(0.3f, -2.0f, 0.2f), vec3(0.0f, 1.0f, 0.0f)};
    const RunningMoments by_tree =
        estimate(access, point, [&](std::uint32_t index) { return draw_light(access, point, index); });
    const RunningMoments by_power = estimate(access, point, [&](std::uint32_t index) {
        const uvec4 bits = random_bits4({index, 3u, 7u}, DIMENSION_CANDIDATE);
        const uint bucket = uniform_index(bits.x, world.lights.count);
        return resolve_alias(unpack_alias_bucket(world.lights.alias_rows[bucket]), bucket,
                             float_from_bits(bits.y));
    });
    EXPECT_GT(enumerate_irradiance(access, point), 0.0);
    EXPECT_LT(by_tree.variance(), 0.25 * by_power.variance());
}

TEST(LightTree, ACandidatesDensityIsThatOfItsLightTimesOneOverItsArea) {
    const LitWorld world = build_random_world(9, 40);
    SceneAccess access(world, &world.light_tree);
    Draws draws(6);
    const Receiver point = draw_point(world, draws);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const uvec4 bits = random_bits4({i, 0u, 1u}, DIMENSION_CANDIDATE);
        const auto candidate = access.draw_light_by_tree(bits, point.position, point.normal);
        const Light light = access.load_light(candidate.drawn.light);
        const float pmf = access.light_tree_pmf(candidate.drawn.light, point.position, point.normal);
        EXPECT_FLOAT_EQ(candidate.pdf, access.is_triangle(light) ? pmf / triangle_area(light) : pmf);
    }
}

}  // namespace
}  // namespace tarn
