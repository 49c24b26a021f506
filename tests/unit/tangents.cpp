// Generated tangents against hand-computed ones and against a file that brings its own.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "scene/gltf_import.h"
#include "scene/normals_tangents.h"

namespace tarn {
namespace {

void expect_tangent(const glm::vec4& actual, const glm::vec3& direction, float handedness) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], direction[c], 1e-6f) << "component " << c;
    EXPECT_EQ(actual.w, handedness);
}

// Vertices in the xy plane with normal +Z.
Mesh flat_mesh(const std::vector<glm::vec2>& positions, const std::vector<glm::vec2>& uv,
               const std::vector<glm::uvec3>& triangles) {
    Mesh mesh;
    for (const glm::vec2& p : positions) mesh.positions_os.emplace_back(p, 0.0f);
    mesh.normals_os.assign(positions.size(), glm::vec3(0, 0, 1));
    mesh.uv0 = uv;
    mesh.triangles = triangles;
    return mesh;
}

TEST(Tangents, PointAlongGrowingUAndTheBitangentUpInThePicture) {
    Mesh mesh =
        flat_mesh({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1}, {1, 1}, {1, 0}, {0, 0}}, {{0, 1, 2}, {0, 2, 3}});
    add_tangents(mesh, 0);
    ASSERT_EQ(mesh.tangents_os.size(), 4u);
    for (const glm::vec4& tangent : mesh.tangents_os) expect_tangent(tangent, {1, 0, 0}, 1.0f);
}

TEST(Tangents, MirroredCoordinatesHaveNegativeHandedness) {
    Mesh mesh =
        flat_mesh({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{1, 1}, {0, 1}, {0, 0}, {1, 0}}, {{0, 1, 2}, {0, 2, 3}});
    add_tangents(mesh, 0);
    for (const glm::vec4& tangent : mesh.tangents_os) expect_tangent(tangent, {-1, 0, 0}, -1.0f);
}

TEST(Tangents, AVertexBetweenBothHandednessesIsSplit) {
    // u grows towards the middle edge from both sides.
    Mesh mesh = flat_mesh({{0, 0}, {0, 1}, {-1, 0}, {1, 0}}, {{1, 1}, {1, 0}, {0, 1}, {0, 1}},
                          {{0, 1, 2}, {0, 3, 1}});
    add_tangents(mesh, 0);
    ASSERT_EQ(mesh.positions_os.size(), 6u);
    for (int c = 0; c < 3; ++c) {
        expect_tangent(mesh.tangents_os[mesh.triangles[0][c]], {1, 0, 0}, 1.0f);
        expect_tangent(mesh.tangents_os[mesh.triangles[1][c]], {-1, 0, 0}, -1.0f);
    }
    EXPECT_EQ(mesh.positions_os[mesh.triangles[1][0]], glm::vec3(0, 0, 0));
    EXPECT_EQ(mesh.uv0.size(), 6u);
}

TEST(Tangents, AreWeightedByTheAngleAtTheVertex) {
    // At vertex 0: 90 degrees of a triangle with tangent (1,0), 45 degrees of one with (1,-1).
    Mesh mesh = flat_mesh({{0, 0}, {1, 0}, {0, 1}, {-1, 1}}, {{0, 0}, {1, 0}, {0, -1}, {-1, 0}},
                          {{0, 1, 2}, {0, 2, 3}});
    add_tangents(mesh, 0);
    const float half = std::sqrt(0.5f);
    expect_tangent(mesh.tangents_os[0],
                   glm::normalize(90.0f * glm::vec3(1, 0, 0) + 45.0f * glm::vec3(half, -half, 0)), 1.0f);
    expect_tangent(mesh.tangents_os[1], {1, 0, 0}, 1.0f);
    expect_tangent(mesh.tangents_os[3], {half, -half, 0}, 1.0f);
}

TEST(Tangents, WithoutUsableCoordinatesTheyAreFiniteAndPerpendicular) {
    Mesh without = flat_mesh({{0, 0}, {1, 0}, {0, 1}}, {}, {{0, 1, 2}});
    Mesh collapsed = flat_mesh({{0, 0}, {1, 0}, {0, 1}}, {{1, 1}, {1, 1}, {1, 1}}, {{0, 1, 2}});
    for (Mesh* mesh : {&without, &collapsed}) {
        add_tangents(*mesh, 0);
        ASSERT_EQ(mesh->tangents_os.size(), 3u);
        for (const glm::vec4& tangent : mesh->tangents_os) {
            EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-6f);
            EXPECT_EQ(tangent.z, 0.0f);
        }
    }
}

TEST(Tangents, AgreeWithAFileThatBringsItsOwn) {
    const std::filesystem::path path =
        std::filesystem::path(TARN_SHARED_DIR) / "scenes/NormalTangentMirrorTest/NormalTangentMirrorTest.glb";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    Scene scene = load_gltf(path);
    Mesh& mesh = scene.meshes.at(0);
    const std::vector<glm::vec4> expected = mesh.tangents_os;
    const std::vector<glm::uvec3> triangles = mesh.triangles;
    ASSERT_FALSE(expected.empty());
    add_tangents(mesh, at(scene.materials, mesh.material).normal_map.uv_set);
    std::size_t same_hand = 0;
    std::size_t close = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (int c = 0; c < 3; ++c) {
            const glm::vec4& file = expected[triangles[t][c]];
            const glm::vec4& made = mesh.tangents_os[mesh.triangles[t][c]];
            same_hand += file.w == made.w ? 1 : 0;
            close += glm::dot(glm::vec3(file), glm::vec3(made)) > 0.99f ? 1 : 0;
        }
    }
    // The file's exporter welded and rounded in its own way; a wrong sign or axis would miss by far more.
    const double corners = 3.0 * double(triangles.size());
    EXPECT_GE(double(same_hand) / corners, 0.999);
    EXPECT_GE(double(close) / corners, 0.98);
}

}  // namespace
}  // namespace tarn
