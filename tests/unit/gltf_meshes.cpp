// Primitives of every mode, and normals where the file has none.
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace tarn {
namespace {

constexpr int POINTS = 0;
constexpr int STRIP = 5;
constexpr int FAN = 6;

// A unit square as four vertices, with normals so that vertices stay shared.
nlohmann::json square(GltfBuilder& gltf, const std::vector<float>& positions, int mode) {
    const int position = gltf.add_floats("VEC3", 4, positions);
    const int normal = gltf.add_floats("VEC3", 4, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    return {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"mode", mode}};
}

TEST(GltfMeshes, StripsAlternateTheirWinding) {
    GltfBuilder gltf;
    gltf.show(square(gltf, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, STRIP));
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.meshes.at(0).triangles.size(), 2u);
    EXPECT_EQ(scene.meshes[0].triangles[0], glm::uvec3(0, 1, 2));
    EXPECT_EQ(scene.meshes[0].triangles[1], glm::uvec3(1, 3, 2));
}

TEST(GltfMeshes, FansShareTheirFirstVertex) {
    GltfBuilder gltf;
    gltf.show(square(gltf, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, FAN));
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.meshes.at(0).triangles.size(), 2u);
    EXPECT_EQ(scene.meshes[0].triangles[0], glm::uvec3(1, 2, 0));
    EXPECT_EQ(scene.meshes[0].triangles[1], glm::uvec3(2, 3, 0));
}

TEST(GltfMeshes, PointsHaveNoAreaAndAreSkipped) {
    GltfBuilder gltf;
    gltf.show(square(gltf, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, POINTS));
    EXPECT_TRUE(gltf.load().meshes.empty());
}

TEST(GltfMeshes, MissingNormalsAreFlatAndVerticesUnshared) {
    GltfBuilder gltf;
    // Two triangles that share an edge and stand at a right angle.
    const int positions = gltf.add_floats("VEC3", 4, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1});
    const int indices =
        gltf.add_accessor<std::uint8_t>("SCALAR", GltfBuilder::UNSIGNED_BYTE, 6, {0, 1, 2, 0, 3, 1});
    gltf.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    const Scene scene = gltf.load();
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.positions_os.size(), 6u);
    ASSERT_EQ(mesh.normals_os.size(), 6u);
    for (std::size_t v = 0; v < 3; ++v) EXPECT_EQ(mesh.normals_os[v], glm::vec3(0, 0, 1));
    for (std::size_t v = 3; v < 6; ++v) EXPECT_EQ(mesh.normals_os[v], glm::vec3(0, -1, 0));
}

TEST(GltfMeshes, TrianglesWithoutAreaGetAFiniteNormal) {
    GltfBuilder gltf;
    const int positions = gltf.add_floats("VEC3", 3, {1, 1, 1, 2, 2, 2, 3, 3, 3});
    gltf.show({{"attributes", {{"POSITION", positions}}}});
    const Scene scene = gltf.load();
    for (const glm::vec3& normal : scene.meshes.at(0).normals_os) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(GltfMeshes, NormalsOfLengthZeroAreReplacedByTheirTriangles) {
    GltfBuilder gltf;
    const int normals = gltf.add_floats("VEC3", 3, {0, 0, 0, 0, 0, 2, 0, 0, 1});
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}, {"NORMAL", normals}}}});
    const Scene scene = gltf.load();
    for (const glm::vec3& normal : scene.meshes.at(0).normals_os) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(GltfMeshes, AnIndexBehindTheLastVertexIsAnError) {
    GltfBuilder gltf;
    const int indices = gltf.add_accessor<std::uint8_t>("SCALAR", GltfBuilder::UNSIGNED_BYTE, 3, {0, 1, 3});
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}, {"indices", indices}});
    const std::string error = error_of([&] { gltf.load(); });
    EXPECT_NE(error.find("meshes[0].primitives[0]: index 2"), std::string::npos) << error;
    EXPECT_NE(error.find("is 3, the primitive has 3 vertices"), std::string::npos) << error;
}

TEST(GltfMeshes, AttributesOfUnequalLengthAreAnError) {
    GltfBuilder gltf;
    const int uv = gltf.add_floats("VEC2", 2, {0, 0, 1, 1});
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}, {"TEXCOORD_0", uv}}}});
    EXPECT_NE(error_of([&] { gltf.load(); }).find("TEXCOORD_0"), std::string::npos);
}

TEST(GltfMeshes, BothSetsOfTextureCoordinatesAreReadAndAThirdIsNot) {
    GltfBuilder gltf;
    const int sets[] = {gltf.add_floats("VEC2", 3, {0, 1, 2, 3, 4, 5}),
                        gltf.add_floats("VEC2", 3, {6, 7, 8, 9, 10, 11}),
                        gltf.add_floats("VEC2", 3, {-1, -1, -1, -1, -1, -1})};
    gltf.show({{"attributes",
                {{"POSITION", gltf.add_triangle_positions()},
                 {"TEXCOORD_0", sets[0]},
                 {"TEXCOORD_1", sets[1]},
                 {"TEXCOORD_2", sets[2]}}}});
    const Scene scene = gltf.load();
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.positions_os.size(), 3u);
    for (std::size_t v = 0; v < 3; ++v) {
        const float x = 2.0f * mesh.positions_os[v].x + 4.0f * mesh.positions_os[v].y;
        EXPECT_EQ(mesh.uv0.at(v), glm::vec2(x, x + 1.0f));
        EXPECT_EQ(mesh.uv1.at(v), glm::vec2(x + 6.0f, x + 7.0f));
    }
}

TEST(GltfMeshes, WeightsAreScaledToSumOne) {
    GltfBuilder gltf;
    const int joints =
        gltf.add_accessor<std::uint8_t>("VEC4", GltfBuilder::UNSIGNED_BYTE, 3, std::vector<std::uint8_t>(12));
    const int weights = gltf.add_floats("VEC4", 3, {2, 2, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
    gltf.show({{"attributes",
                {{"POSITION", gltf.add_triangle_positions()},
                 {"NORMAL", gltf.add_floats("VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1})},
                 {"JOINTS_0", joints},
                 {"WEIGHTS_0", weights}}}});
    const Scene scene = gltf.load();
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.influence_sets, 1);
    EXPECT_EQ(mesh.weights[0], glm::vec4(0.5f, 0.5f, 0, 0));
    EXPECT_EQ(mesh.weights[1], glm::vec4(1, 0, 0, 0));
}

TEST(GltfMeshes, SharedMeshesAreStoredOnceAndUnusedOnesNotAtAll) {
    GltfBuilder gltf;
    gltf.add_mesh({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}});
    gltf.add_mesh({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}});
    gltf.push("nodes", {{"mesh", 1}});
    gltf.push("nodes", {{"mesh", 1}});
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].mesh, MeshIndex(0));
    EXPECT_EQ(scene.instances[1].mesh, MeshIndex(0));
    EXPECT_EQ(scene.instances[1].node, NodeIndex(1));
}

}  // namespace
}  // namespace tarn
