// Animation curves, hierarchy, skins and morph targets against hand-computed values.
#include "scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/gltf_builder.h"

namespace tarn {
namespace {

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-6f) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance) << "component " << c;
}

// One node whose `property` follows `channel`.
Scene animated_node(AnimationChannel channel) {
    Scene scene;
    scene.nodes.emplace_back();
    channel.node = NodeIndex(0);
    const double duration_s = channel.times_s.back();
    scene.animations.push_back({"test", {std::move(channel)}, duration_s});
    return scene;
}

double translation_x(const Scene& scene, double time_s) {
    return evaluate_pose(scene, time_s).world_from_node[0][3].x;
}

AnimationChannel translation(Interpolation interpolation, std::vector<float> times_s,
                             std::vector<float> values) {
    AnimationChannel channel;
    channel.interpolation = interpolation;
    channel.times_s = std::move(times_s);
    channel.values = std::move(values);
    return channel;
}

TEST(Pose, CubicSplinesFollowTheirTangents) {
    // x: value 1 leaving at 2/s, value 5 arriving at -1/s, 2 s later.
    const Scene scene = animated_node(
        translation(Interpolation::CUBIC, {0, 2}, {0, 0, 0, 1, 0, 0, 2, 0, 0, -1, 0, 0, 5, 0, 0, 0, 0, 0}));
    EXPECT_DOUBLE_EQ(translation_x(scene, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(translation_x(scene, 0.5), 2.28125);
    EXPECT_DOUBLE_EQ(translation_x(scene, 1.0), 3.75);
}

TEST(Pose, StepsHoldAndLinesInterpolate) {
    const std::vector<float> values = {0, 0, 0, 4, 0, 0, 8, 0, 0};
    const Scene step = animated_node(translation(Interpolation::STEP, {0, 1, 2}, values));
    EXPECT_EQ(translation_x(step, 0.99), 0.0);
    EXPECT_EQ(translation_x(step, 1.0), 4.0);
    const Scene line = animated_node(translation(Interpolation::LINEAR, {0, 1, 2}, values));
    EXPECT_DOUBLE_EQ(translation_x(line, 0.25), 1.0);
    EXPECT_DOUBLE_EQ(translation_x(line, 1.5), 6.0);
}

TEST(Pose, LoopsAndRests) {
    Scene scene = animated_node(translation(Interpolation::LINEAR, {0, 2}, {0, 0, 0, 8, 0, 0}));
    scene.nodes[0].local.translation.x = -1.0;
    EXPECT_DOUBLE_EQ(translation_x(scene, 2.5), 2.0);
    EXPECT_DOUBLE_EQ(translation_x(scene, -1.0), -1.0);
}

TEST(Pose, BeforeItsFirstKeyAChannelHoldsIt) {
    const Scene scene = animated_node(translation(Interpolation::LINEAR, {1, 2}, {3, 0, 0, 8, 0, 0}));
    EXPECT_DOUBLE_EQ(translation_x(scene, 0.5), 3.0);
}

TEST(Pose, RotationsTakeTheShortWay) {
    const float half = std::sqrt(0.5f);
    for (const float sign : {1.0f, -1.0f}) {
        AnimationChannel channel =
            translation(Interpolation::LINEAR, {0, 1}, {0, 0, 0, 1, 0, 0, sign * half, sign * half});
        channel.property = AnimatedProperty::ROTATION;
        channel.components = 4;
        const Pose pose = evaluate_pose(animated_node(channel), 0.5);
        // 45 degrees about z.
        expect_near(glm::vec3(pose.world_from_node[0][0]), {half, half, 0});
    }
}

TEST(Pose, ChildrenMayComeBeforeTheirParents) {
    Scene scene;
    scene.nodes.resize(3);
    scene.nodes[0].parent = NodeIndex(1);
    scene.nodes[1].parent = NodeIndex(2);
    scene.nodes[0].local.translation = {1, 0, 0};
    scene.nodes[1].local.scale = {2, 2, 2};
    scene.nodes[2].local.translation = {0, 10, 0};
    const Pose pose = evaluate_pose(scene, -1.0);
    EXPECT_EQ(pose.world_from_node[0][3], glm::dvec4(2, 10, 0, 1));
}

// A strip along y on two joints: the second sits at y = 1 and is turned by 90 degrees about z.
Scene bent_strip(double joints_x) {
    Scene scene;
    scene.nodes.resize(4);
    scene.nodes[0].local.translation = {joints_x, 0, 0};
    scene.nodes[1].parent = NodeIndex(0);
    scene.nodes[1].local.translation = {0, 1, 0};
    scene.nodes[1].local.rotation = glm::angleAxis(M_PI / 2, glm::dvec3(0, 0, 1));
    scene.nodes[2].local.translation = {7, 7, 7};
    Skin skin;
    skin.joints = {NodeIndex(0), NodeIndex(1)};
    skin.joint_from_mesh = {glm::dmat4(1.0), glm::dmat4(1.0)};
    skin.joint_from_mesh[1][3] = {0, -1, 0, 1};
    scene.skins.push_back(skin);
    Mesh mesh;
    mesh.positions_os = {{0, 0, 0}, {1, 1, 0}, {0, 2, 0}};
    mesh.normals_os.assign(3, {1, 0, 0});
    mesh.tangents_os.assign(3, {0, 1, 0, 1});
    mesh.triangles = {{0, 1, 2}};
    mesh.influence_sets = 1;
    mesh.joints = {{0, 1, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}};
    mesh.weights = {{1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}, {0, 1, 0, 0}};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({MeshIndex(0), NodeIndex(2), SkinIndex(0)});
    return scene;
}

TEST(Pose, SkinsBlendTheirJointsAndIgnoreTheNode) {
    const Scene scene = bent_strip(0.0);
    const Pose pose = evaluate_pose(scene, -1.0);
    const DeformedMesh mesh = deform_mesh(scene, scene.instances[0], pose, glm::dvec3(0.0));
    expect_near(mesh.positions_os[0], {0, 0, 0});
    expect_near(mesh.positions_os[1], {0.5f, 1.5f, 0});
    expect_near(mesh.positions_os[2], {-1, 1, 0});
    expect_near(mesh.normals_os[0], {1, 0, 0});
    expect_near(mesh.normals_os[2], {0, 1, 0});
    expect_near(glm::vec3(mesh.tangents_os[2]), {-1, 0, 0});
    EXPECT_EQ(origin_from_object(scene, scene.instances[0], pose, glm::dvec3(1.0)), glm::dmat4(1.0));
}

TEST(Pose, FarFromTheOriginSkinsStayExactNearTheirOwn) {
    const Scene scene = bent_strip(1e5);
    const Pose pose = evaluate_pose(scene, -1.0);
    const DeformedMesh mesh = deform_mesh(scene, scene.instances[0], pose, glm::dvec3(1e5, 0, 0));
    expect_near(mesh.positions_os[1], {0.5f, 1.5f, 0});
    expect_near(mesh.positions_os[2], {-1, 1, 0});
    EXPECT_NEAR(compute_bounds(scene, pose).lower.x, 1e5 - 1.0, 1e-6);
}

TEST(Pose, MorphTargetsAddByTheirWeights) {
    GltfBuilder gltf;
    const int positions = gltf.add_triangle_positions();
    const int normals = gltf.add_floats("VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int up = gltf.add_floats("VEC3", 3, {0, 0, 2, 0, 0, 2, 0, 0, 2});
    const int right = gltf.add_floats("VEC3", 3, {4, 0, 0, 0, 0, 0, 0, 0, 0});
    gltf.show({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
               {"targets", {{{"POSITION", up}}, {{"POSITION", right}}}}});
    gltf.json["meshes"][0]["weights"] = {0.5, 0.25};
    const int times = gltf.add_floats("SCALAR", 2, {0, 1});
    const int weights = gltf.add_floats("SCALAR", 4, {0, 0, 1, 0.5});
    gltf.push("animations",
              {{"samplers", {{{"input", times}, {"output", weights}}}},
               {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    const Scene scene = gltf.load();
    const auto first_vertex = [&](double time_s) {
        return deform_mesh(scene, scene.instances.at(0), evaluate_pose(scene, time_s), glm::dvec3(0.0))
            .positions_os[0];
    };
    expect_near(first_vertex(-1.0), {1, 0, 1});
    expect_near(first_vertex(0.0), {0, 0, 0});
    expect_near(first_vertex(0.5), {1, 0, 1});
    expect_near(first_vertex(0.75), {1.5f, 0, 1.5f});
}

TEST(Pose, FlatNormalsFollowTheirMorphTargets) {
    GltfBuilder gltf;
    // The third vertex goes from (0,1,0) to (0,0,1): the normal turns from +Z to -Y.
    const int moved = gltf.add_floats("VEC3", 3, {0, 0, 0, 0, 0, 0, 0, -1, 1});
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}},
               {"targets", {{{"POSITION", moved}}}}});
    gltf.json["nodes"][0]["weights"] = {1.0};
    const Scene scene = gltf.load();
    const DeformedMesh mesh =
        deform_mesh(scene, scene.instances.at(0), evaluate_pose(scene, -1.0), glm::dvec3(0.0));
    for (const glm::vec3& normal : mesh.normals_os) expect_near(normal, {0, -1, 0});
}

TEST(Pose, AnEmptySceneHasNoBounds) {
    const Scene scene;
    EXPECT_TRUE(compute_bounds(scene, evaluate_pose(scene, 0.0)).empty());
}

}  // namespace
}  // namespace tarn
