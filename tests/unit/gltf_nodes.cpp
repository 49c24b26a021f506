// Scenes, cameras, lights and broken node trees.
#include <gtest/gtest.h>

#include "scene/pose.h"
#include "unit/gltf_builder.h"

namespace tarn {
namespace {

GltfBuilder two_scenes() {
    GltfBuilder gltf;
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}});
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}});
    gltf.push("nodes", {{"children", {1}}});
    gltf.push("scenes", {{"name", "first"}, {"nodes", {0}}});
    gltf.push("scenes", {{"name", "second"}, {"nodes", {2}}});
    gltf.json["scene"] = 1;
    return gltf;
}

TEST(GltfNodes, TheDefaultSceneIsShownUnlessAnotherIsAskedFor) {
    const GltfBuilder gltf = two_scenes();
    const Scene by_default = gltf.load();
    EXPECT_EQ(by_default.name, "second");
    ASSERT_EQ(by_default.instances.size(), 1u);
    EXPECT_EQ(by_default.instances[0].node, NodeIndex(1));
    const Scene first = gltf.load(0);
    EXPECT_EQ(first.name, "first");
    ASSERT_EQ(first.instances.size(), 1u);
    EXPECT_EQ(first.instances[0].node, NodeIndex(0));
    EXPECT_NE(error_of([&] { gltf.load(2); }).find("scene 2 is asked for, the file has 2"),
              std::string::npos);
}

TEST(GltfNodes, WithoutScenesAllNodesAreShown) {
    GltfBuilder gltf = two_scenes();
    gltf.json.erase("scenes");
    gltf.json.erase("scene");
    EXPECT_EQ(gltf.load().instances.size(), 2u);
}

TEST(GltfNodes, NegativeScaleStaysInTheTransform) {
    GltfBuilder gltf;
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}});
    gltf.json["nodes"][0]["scale"] = {-2, 1, 1};
    const Scene scene = gltf.load();
    const Pose pose = evaluate_pose(scene, -1.0);
    const glm::dmat4 matrix = origin_from_object(scene, scene.instances.at(0), pose, glm::dvec3(0.0));
    EXPECT_EQ(glm::determinant(matrix), -2.0);
    EXPECT_EQ(compute_bounds(scene, pose).lower.x, -2.0);
    EXPECT_EQ(scene.meshes.at(0).triangles.at(0), glm::uvec3(0, 1, 2));
}

TEST(GltfNodes, ALongWayFromTheOriginMillimetresSurvive) {
    GltfBuilder gltf;
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}});
    gltf.json["nodes"][0]["translation"] = {0.001, 0, 0};
    gltf.push("nodes", {{"translation", {1e5, 0, 0}}, {"children", {0}}});
    const Scene scene = gltf.load();
    const Pose pose = evaluate_pose(scene, -1.0);
    EXPECT_NEAR(pose.world_from_node[0][3].x - 1e5, 0.001, 1e-10);
    const glm::dmat4 near = origin_from_object(scene, scene.instances.at(0), pose, glm::dvec3(1e5, 0, 0));
    EXPECT_NEAR(near[3].x, 0.001, 1e-10);
}

TEST(GltfNodes, CamerasAndLightsComeInNodeOrder) {
    GltfBuilder gltf;
    gltf.push("cameras",
              {{"type", "perspective"}, {"name", "wide"}, {"perspective", {{"yfov", 1.5}, {"znear", 0.1}}}});
    gltf.push("cameras", {{"type", "orthographic"},
                          {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0.1}, {"zfar", 10}}}});
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"color", {1, 0.5, 0}},
         {"intensity", 10},
         {"range", 5},
         {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}},
        {{"type", "directional"}}};
    gltf.push("nodes", {{"camera", 1}, {"name", "plan"}});
    gltf.push("nodes", {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_TRUE(scene.cameras[0].orthographic);
    EXPECT_EQ(scene.cameras[0].half_height_m, 3.0);
    EXPECT_EQ(scene.cameras[0].name, "plan");
    EXPECT_EQ(scene.cameras[1].vertical_fov_rad, 1.5);
    EXPECT_EQ(scene.cameras[1].node, NodeIndex(1));
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::SPOT);
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(10, 5, 0));
    EXPECT_EQ(scene.lights[0].range_m, 5.0);
    EXPECT_EQ(scene.lights[0].outer_cone_rad, 0.2);
    EXPECT_EQ(scene.lights[1].kind, LightKind::DIRECTIONAL);
    EXPECT_EQ(scene.light_nodes, std::vector<NodeIndex>{NodeIndex(1)});
}

TEST(GltfNodes, CyclesAndSecondParentsAreErrors) {
    GltfBuilder cycle;
    cycle.push("nodes", {{"children", {1}}});
    cycle.push("nodes", {{"children", {0}}});
    EXPECT_NE(error_of([&] { cycle.load(); }).find("is its own ancestor"), std::string::npos);
    GltfBuilder shared;
    shared.push("nodes", {{"children", {2}}});
    shared.push("nodes", {{"children", {2}}});
    shared.push("nodes", nlohmann::json::object());
    EXPECT_NE(error_of([&] { shared.load(); }).find("nodes[2] has two parents"), std::string::npos);
}

TEST(GltfNodes, ReferencesBehindTheEndNameTheirPath) {
    GltfBuilder gltf;
    gltf.push("nodes", {{"mesh", 7}});
    const std::string error = error_of([&] { gltf.load(); });
    EXPECT_NE(error.find("nodes[0].mesh is 7, meshes has 0 entries"), std::string::npos) << error;
}

}  // namespace
}  // namespace tarn
