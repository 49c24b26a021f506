// The generated scenes are what the README of content/ promises: the same bytes each time, sound geometry,
// known power.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "content/portable_math.h"
#include "content/scenes.h"
#include "content_reader.h"
#include "core/error.h"

namespace tarn::content {
namespace {

class EachScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Content, EachScene, testing::ValuesIn(list_scenes()),
                         [](const auto& info) { return info.param; });

TEST_P(EachScene, HasTheSameBytesTwice) {
    EXPECT_EQ(generate_scene(GetParam(), {}), generate_scene(GetParam(), {}));
}

TEST_P(EachScene, HasSoundGeometry) {
    const ReadScene scene = read_scene(generate_scene(GetParam(), {}));
    EXPECT_EQ(scene.bad_indices, 0u);
    ASSERT_FALSE(scene.triangles.empty());
    std::size_t against_winding = 0, without_area = 0, not_unit = 0;
    for (const ReadTriangle& t : scene.triangles) {
        const glm::vec3 winding = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
        without_area += area(t) < 1e-9;
        for (const glm::vec3& normal : t.normals) {
            against_winding += glm::dot(winding, normal) <= 0.0f;
            not_unit += std::abs(glm::length(normal) - 1.0f) > 1e-4f;
        }
    }
    EXPECT_EQ(without_area, 0u);
    EXPECT_EQ(not_unit, 0u);
    EXPECT_LE(against_winding, scene.triangles.size() * 3 / 1000)
        << "of " << scene.triangles.size() * 3 << " corners";
}

TEST_P(EachScene, HasOnlyWhatTheFormatAllows) {
    const ReadScene scene = read_scene(generate_scene(GetParam(), {}));
    const tinygltf::Model& model = scene.model;
    std::set<std::string> cameras;
    for (const tinygltf::Camera& camera : model.cameras) cameras.insert(camera.name);
    EXPECT_TRUE(cameras.count("main"));
    EXPECT_EQ(cameras.size(), model.cameras.size()) << "two cameras share a name";
    for (const tinygltf::Node& node : model.nodes) {
        if (node.rotation.empty()) continue;
        const glm::dvec4 rotation(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]);
        EXPECT_NEAR(glm::length(rotation), 1.0, 1e-6) << node.name;
    }
    for (const tinygltf::Material& material : model.materials) {
        for (const double factor : material.emissiveFactor)
            EXPECT_TRUE(factor >= 0.0 && factor <= 1.0) << material.name;
    }
}

TEST(LanternCourt, KeepsItsPromises) {
    const ReadScene scene = read_scene(generate_scene("lantern_court", {}));
    EXPECT_GE(scene.triangles.size(), 50000u);
    EXPECT_LE(scene.triangles.size(), 150000u);
    EXPECT_GE(scene.instances, 150u);
    EXPECT_LE(scene.instances, 650u);
    std::set<std::string> cameras;
    for (const tinygltf::Camera& camera : scene.model.cameras) cameras.insert(camera.name);
    EXPECT_EQ(cameras, (std::set<std::string>{"main", "arcade", "balcony", "closeup"}));
}

// Lanterns are small and stand apart: glowing triangles closer than a lantern's size belong to the same one.
TEST(LanternCourt, HasFiveHundredToTwoThousandLanterns) {
    const ReadScene scene = read_scene(generate_scene("lantern_court", {}));
    std::vector<ReadTriangle> glowing;
    for (const ReadTriangle& t : scene.triangles) {
        const bool window = scene.model.materials[t.material].name == "window";
        if (!window && scene.radiance(t.material) != glm::dvec3(0.0)) glowing.push_back(t);
    }
    std::vector<glm::vec3> middles;  // one for each lantern found so far
    for (const ReadTriangle& t : glowing) {
        const glm::vec3 middle = (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0f;
        bool known = false;
        for (const glm::vec3& other : middles) known = known || glm::distance(other, middle) < 0.36f;
        if (!known) middles.push_back(middle);
    }
    EXPECT_GE(middles.size(), 500u);
    EXPECT_LE(middles.size(), 2000u);
    EXPECT_GE(glowing.size(), 8 * middles.size());
    EXPECT_LE(glowing.size(), 24 * middles.size());
}

TEST(LanternCourt, MovesInClosedLoopsOfBothKinds) {
    const ReadScene scene = read_scene(generate_scene("lantern_court", {}));
    const tinygltf::Model& model = scene.model;
    ASSERT_EQ(model.animations.size(), 1u);
    std::set<std::string> kinds;
    for (const tinygltf::AnimationSampler& sampler : model.animations[0].samplers) {
        kinds.insert(sampler.interpolation);
        const tinygltf::Accessor& output = model.accessors[sampler.output];
        const std::size_t components = output.type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
        const bool cubic = sampler.interpolation == "CUBICSPLINE";
        const std::size_t keys = model.accessors[sampler.input].count;
        ASSERT_EQ(output.count, keys * (cubic ? 3 : 1));
        const unsigned char* values = bytes_of(model, sampler.output);
        const std::size_t first = cubic ? 1 : 0, last = output.count - (cubic ? 2 : 1), size = 4 * components;
        EXPECT_EQ(std::memcmp(values + first * size, values + last * size, size), 0);
    }
    EXPECT_EQ(kinds, (std::set<std::string>{"LINEAR", "CUBICSPLINE"}));
}

double luminous_power(const ReadScene& scene) {
    double power = 0.0;
    for (const ReadTriangle& t : scene.triangles) {
        power += PI * area(t) * glm::dot(scene.radiance(t.material), glm::dvec3(0.2126, 0.7152, 0.0722));
    }
    return power;
}

TEST(ManyLights, HasTheSamePowerForEveryCount) {
    for (const int count : {1, 7, 1000, 30000}) {
        SceneOptions options;
        options.count = count;
        const ReadScene scene = read_scene(generate_scene("many_lights", options));
        std::size_t lights = 0;
        for (const ReadTriangle& t : scene.triangles) lights += scene.radiance(t.material) != glm::dvec3(0.0);
        EXPECT_EQ(lights, static_cast<std::size_t>(count));
        EXPECT_LT(scene.triangles.size() - lights, 2000u);
        EXPECT_NEAR(luminous_power(scene), 8000.0, 8.0) << count << " lights";
    }
}

TEST(ManyLights, RefusesCountsOutOfRange) {
    for (const int count : {0, -3, 1000001}) {
        SceneOptions options;
        options.count = count;
        EXPECT_THROW(generate_scene("many_lights", options), Error);
    }
}

TEST(ManyLights, MovesAsManyAsItIsTold) {
    for (const double percent : {0.0, 0.1, 1.0, 50.0, 100.0}) {
        SceneOptions options;
        options.count = 3000;
        options.moving_percent = percent;
        const ReadScene scene = read_scene(generate_scene("many_lights", options));
        std::set<int> drifting;
        for (const tinygltf::Animation& animation : scene.model.animations) {
            for (const tinygltf::AnimationChannel& channel : animation.channels)
                drifting.insert(channel.target_node);
        }
        std::size_t lights = 0, moving = 0;
        for (const ReadTriangle& t : scene.triangles) {
            if (scene.radiance(t.material) == glm::dvec3(0.0)) continue;
            ++lights;
            moving += drifting.count(static_cast<int>(t.node));
        }
        EXPECT_EQ(lights, 3000u);
        EXPECT_EQ(moving, static_cast<std::size_t>(std::ceil(30.0 * percent)));
        EXPECT_GE(100 * drifting.size(), moving);
        EXPECT_NEAR(luminous_power(scene), 8000.0, 8.0);
    }
}

TEST(ManyLights, RefusesToMoveMoreThanThereAre) {
    for (const double percent : {-1.0, 100.5, std::nan("")}) {
        SceneOptions options;
        options.moving_percent = percent;
        EXPECT_THROW(generate_scene("many_lights", options), Error);
    }
}

// Saturation 0 makes every light white and keeps what an eye sees of its power.
TEST(ManyLights, PalesWithItsSaturation) {
    double spread_before = 0.0;
    for (const double saturation : {0.0, 0.5, 1.0}) {
        SceneOptions options;
        options.saturation = saturation;
        const ReadScene scene = read_scene(generate_scene("many_lights", options));
        double spread = 0.0;
        for (const ReadTriangle& t : scene.triangles) {
            const glm::dvec3 radiance = scene.radiance(t.material);
            spread = std::max({spread, std::abs(radiance.r - radiance.g), std::abs(radiance.g - radiance.b)});
        }
        EXPECT_NEAR(luminous_power(scene), 8000.0, 8.0) << saturation;
        if (saturation == 0.0)
            EXPECT_EQ(spread, 0.0);
        else
            EXPECT_GT(spread, 1.9 * spread_before) << saturation;
        spread_before = spread;
    }
    for (const double saturation : {-0.1, 1.1, std::nan("")}) {
        SceneOptions options;
        options.saturation = saturation;
        EXPECT_THROW(generate_scene("many_lights", options), Error) << saturation;
    }
}

TEST(ManyLights, ChangesWithTheSeed) {
    SceneOptions other;
    other.seed = 2;
    EXPECT_NE(generate_scene("many_lights", {}), generate_scene("many_lights", other));
}

TEST(Scenes, RefuseAnUnknownName) {
    EXPECT_THROW(generate_scene("no_such_scene", {}), Error);
}

TEST(RectangleOverPlane, EmitsTheRadianceItSaysDownwards) {
    const ReadScene scene = read_scene(generate_scene("rectangle_over_plane", {}));
    double lit_area = 0.0;
    for (const ReadTriangle& t : scene.triangles) {
        if (scene.radiance(t.material) == glm::dvec3(0.0)) continue;
        lit_area += area(t);
        EXPECT_EQ(scene.radiance(t.material), glm::dvec3(5.0));
        EXPECT_EQ(t.normals[0], glm::vec3(0, -1, 0));
    }
    EXPECT_NEAR(lit_area, 0.5, 1e-6);
}

TEST(PortableMath, SineAndCosineAgreeWithTheLibrary) {
    for (double angle = -40.0; angle < 40.0; angle += 0.0137) {
        EXPECT_NEAR(sine(angle), std::sin(angle), 1e-14) << angle;
        EXPECT_NEAR(cosine(angle), std::cos(angle), 1e-14) << angle;
    }
}

TEST(PortableMath, RandomNumbersAreUniform) {
    // Chi-square over 64 bins, 63 degrees of freedom: 99.9 % of fair generators stay below 103.4.
    const Random random(7);
    constexpr int BINS = 64, DRAWS = 64000;
    for (std::uint64_t dimension = 0; dimension < 4; ++dimension) {
        double bins[BINS] = {}, chi_square = 0.0;
        for (std::uint64_t i = 0; i < DRAWS; ++i)
            bins[static_cast<int>(BINS * random.unit(i, dimension))] += 1.0;
        for (const double bin : bins) chi_square += (bin - 1000.0) * (bin - 1000.0) / 1000.0;
        EXPECT_LT(chi_square, 103.4) << "dimension " << dimension;
    }
}

// The crossing of the segment a -> b with a triangle, from either side.
bool crosses(const glm::vec3& a, const glm::vec3& b, const ReadTriangle& t) {
    const glm::vec3 e1 = t.corners[1] - t.corners[0], e2 = t.corners[2] - t.corners[0], way = b - a;
    const glm::vec3 p = glm::cross(way, e2), s = a - t.corners[0];
    const float determinant = glm::dot(e1, p);
    if (determinant == 0.0f) return false;
    const glm::vec3 q = glm::cross(s, e1);
    const float u = glm::dot(s, p) / determinant, v = glm::dot(way, q) / determinant,
                along = glm::dot(e2, q) / determinant;
    return u >= 0.0f && v >= 0.0f && u + v <= 1.0f && along >= 0.0f && along <= 1.0f;
}

glm::vec3 catmull_rom(const std::vector<glm::vec3>& keys, std::size_t segment, float t) {
    const glm::vec3 p0 = keys[segment == 0 ? 0 : segment - 1], p1 = keys[segment], p2 = keys[segment + 1];
    const glm::vec3 p3 = keys[std::min(segment + 2, keys.size() - 1)];
    return p1 +
           0.5f * t *
               (p2 - p0 + t * (2.0f * p0 - 5.0f * p1 + 4.0f * p2 - p3 + t * (3.0f * (p1 - p2) + p3 - p0)));
}

TEST(Flythrough, OfTheLanternCourtPassesThroughNothing) {
    const ReadScene scene = read_scene(generate_scene("lantern_court", {}));
    std::ifstream file(std::string(TARN_SOURCE_DIR) + "/content/flythroughs/lantern_court.json");
    const nlohmann::json path = nlohmann::json::parse(file);
    std::vector<glm::vec3> keys;
    float last_time_s = -1.0f;
    for (const auto& key : path["keys"]) {
        keys.emplace_back(key["position"][0], key["position"][1], key["position"][2]);
        EXPECT_GT(key["time_s"].get<float>(), last_time_s);
        last_time_s = key["time_s"];
    }
    EXPECT_EQ(last_time_s, path["duration_s"].get<float>());
    constexpr float CLEARANCE_M = 0.3f;
    constexpr int STEPS = 8;
    for (std::size_t segment = 0; segment + 1 < keys.size(); ++segment) {
        for (int step = 0; step < STEPS; ++step) {
            const glm::vec3 a = catmull_rom(keys, segment, static_cast<float>(step) / STEPS);
            const glm::vec3 b = catmull_rom(keys, segment, static_cast<float>(step + 1) / STEPS);
            const glm::vec3 aside = CLEARANCE_M * glm::normalize(glm::cross(b - a, glm::vec3(0, 1, 0)));
            for (const ReadTriangle& t : scene.triangles) {
                for (const float side : {-1.0f, 0.0f, 1.0f}) {
                    ASSERT_FALSE(crosses(a + side * aside, b + side * aside, t))
                        << scene.model.nodes[t.node].name << " is in the way after key " << segment;
                }
            }
        }
    }
}

}  // namespace
}  // namespace tarn::content
