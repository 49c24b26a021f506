// Reading accessors of every kind, seen through the positions, colours and coordinates of a loaded mesh.
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace tarn {
namespace {

void expect_near(const glm::vec3& actual, const glm::vec3& expected) {
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(actual[c], expected[c]) << "component " << c;
}

// The mesh keeps its vertices where the file has normals.
int add_normals(GltfBuilder& gltf, std::size_t count) {
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) values.insert(values.end(), {0.0f, 0.0f, 1.0f});
    return gltf.add_floats("VEC3", count, values);
}

TEST(GltfAccessors, StridedElementsSkipWhatLiesBetween) {
    GltfBuilder gltf;
    const int view = gltf.add_view<float>({9, 0, 0, 0, 7, 7, 1, 0, 0, 7, 7, 0, 1, 0}, 20);
    const int positions = gltf.push("accessors", {{"bufferView", view},
                                                  {"byteOffset", 4},
                                                  {"componentType", GltfBuilder::FLOAT},
                                                  {"count", 3},
                                                  {"type", "VEC3"}});
    gltf.show({{"attributes", {{"POSITION", positions}, {"NORMAL", add_normals(gltf, 3)}}}});
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    expect_near(scene.meshes[0].positions_os[0], {0, 0, 0});
    expect_near(scene.meshes[0].positions_os[1], {1, 0, 0});
    expect_near(scene.meshes[0].positions_os[2], {0, 1, 0});
}

TEST(GltfAccessors, SparseValuesReplaceTheirElementsAlone) {
    GltfBuilder gltf;
    const int positions = gltf.add_triangle_positions();
    const int indices = gltf.add_view<std::uint16_t>({1});
    const int values = gltf.add_view<float>({5, 6, 7});
    gltf.json["accessors"][std::size_t(positions)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", GltfBuilder::UNSIGNED_SHORT}}},
        {"values", {{"bufferView", values}}}};
    gltf.show({{"attributes", {{"POSITION", positions}, {"NORMAL", add_normals(gltf, 3)}}}});
    const Scene scene = gltf.load();
    expect_near(scene.meshes[0].positions_os[0], {0, 0, 0});
    expect_near(scene.meshes[0].positions_os[1], {5, 6, 7});
    expect_near(scene.meshes[0].positions_os[2], {0, 1, 0});
}

TEST(GltfAccessors, SparseIndicesMayStandOnNoBufferView) {
    GltfBuilder gltf;
    const int positions = gltf.add_triangle_positions();
    const int which = gltf.add_view<std::uint8_t>({1, 2});
    const int values = gltf.add_view<std::uint16_t>({1, 2});
    const int indices = gltf.push(
        "accessors", {{"componentType", GltfBuilder::UNSIGNED_SHORT},
                      {"count", 3},
                      {"type", "SCALAR"},
                      {"sparse",
                       {{"count", 2},
                        {"indices", {{"bufferView", which}, {"componentType", GltfBuilder::UNSIGNED_BYTE}}},
                        {"values", {{"bufferView", values}}}}}});
    gltf.show(
        {{"attributes", {{"POSITION", positions}, {"NORMAL", add_normals(gltf, 3)}}}, {"indices", indices}});
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.meshes.at(0).triangles.size(), 1u);
    EXPECT_EQ(scene.meshes[0].triangles[0], glm::uvec3(0, 1, 2));
}

TEST(GltfAccessors, NormalizedIntegersSpanTheUnitIntervals) {
    GltfBuilder gltf;
    const int colors = gltf.add_accessor<std::uint8_t>("VEC4", GltfBuilder::UNSIGNED_BYTE, 3,
                                                       {0, 51, 102, 255, 255, 0, 0, 255, 0, 0, 0, 0});
    const int uv =
        gltf.add_accessor<std::uint16_t>("VEC2", GltfBuilder::UNSIGNED_SHORT, 3, {0, 65535, 13107, 0, 0, 0});
    gltf.json["accessors"][std::size_t(colors)]["normalized"] = true;
    gltf.json["accessors"][std::size_t(uv)]["normalized"] = true;
    const int positions = gltf.add_triangle_positions();
    gltf.show({{"attributes",
                {{"POSITION", positions},
                 {"NORMAL", add_normals(gltf, 3)},
                 {"COLOR_0", colors},
                 {"TEXCOORD_0", uv}}}});
    const Scene scene = gltf.load();
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_FLOAT_EQ(mesh.colors[0].y, 0.2f);
    EXPECT_FLOAT_EQ(mesh.colors[0].z, 0.4f);
    EXPECT_FLOAT_EQ(mesh.colors[0].w, 1.0f);
    EXPECT_FLOAT_EQ(mesh.uv0[0].y, 1.0f);
    EXPECT_FLOAT_EQ(mesh.uv0[1].x, 0.2f);
}

TEST(GltfAccessors, QuantizedMeshesKeepRawIntegersAndMapNormalizedOnes) {
    GltfBuilder gltf;
    gltf.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    gltf.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    // Positions of 3 shorts padded to 8 bytes; normals of 3 bytes padded to 4.
    const int position_view = gltf.add_view<std::int16_t>({-300, 0, 5, 99, 300, 0, 5, 99, 0, 300, 5, 99}, 8);
    const int normal_view = gltf.add_view<std::int8_t>({0, 0, 127, 9, 0, 0, 127, 9, 0, -128, 0, 9}, 4);
    const int positions = gltf.push("accessors", {{"bufferView", position_view},
                                                  {"componentType", GltfBuilder::SHORT},
                                                  {"count", 3},
                                                  {"type", "VEC3"}});
    const int normals = gltf.push("accessors", {{"bufferView", normal_view},
                                                {"componentType", GltfBuilder::BYTE},
                                                {"normalized", true},
                                                {"count", 3},
                                                {"type", "VEC3"}});
    gltf.show({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    const Scene scene = gltf.load();
    expect_near(scene.meshes.at(0).positions_os[0], {-300, 0, 5});
    expect_near(scene.meshes[0].positions_os[2], {0, 300, 5});
    expect_near(scene.meshes[0].normals_os[0], {0, 0, 1});
    expect_near(scene.meshes[0].normals_os[2], {0, -1, 0});
    EXPECT_EQ(scene.extensions_honoured, std::vector<std::string>{"KHR_mesh_quantization"});
}

TEST(GltfAccessors, SmallMatricesStartTheirColumnsAtMultiplesOfFour) {
    GltfBuilder gltf;
    // Two MAT2 of bytes: 8 bytes each, the last two of which the file may leave out.
    gltf.add_accessor<std::uint8_t>("MAT2", GltfBuilder::UNSIGNED_BYTE, 2, std::vector<std::uint8_t>(14));
    EXPECT_EQ(error_of([&] { gltf.load(); }), "");
    gltf.json["accessors"][0]["count"] = 3;
    EXPECT_NE(error_of([&] { gltf.load(); }).find("accessors[0] reads 3 elements"), std::string::npos);
}

TEST(GltfAccessors, IntegersMayBeWrittenAsFloats) {
    GltfBuilder gltf;
    const int positions = gltf.add_triangle_positions();
    gltf.json["accessors"][std::size_t(positions)]["count"] = 3.0;
    gltf.show({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(gltf.load().meshes.at(0).positions_os.size(), 3u);
}

TEST(GltfAccessors, BuffersLieBesideTheFileUnderPercentEncodedNames) {
    const TemporaryFile buffer(" a b.bin", std::string(36, '\0'));
    GltfBuilder gltf;
    gltf.add_triangle_positions();
    nlohmann::json json = nlohmann::json::parse(gltf.text());
    std::string uri = buffer.path().filename().string();
    for (std::size_t at = 0; (at = uri.find(' ', at)) != std::string::npos;) uri.replace(at, 1, "%20");
    json["buffers"][0]["uri"] = uri;
    const TemporaryFile file(".gltf", json.dump());
    EXPECT_EQ(error_of([&] { load_gltf(file.path()); }), "");
    json["buffers"][0]["uri"] = uri + "x";
    const TemporaryFile broken(".gltf", json.dump());
    EXPECT_NE(error_of([&] { load_gltf(broken.path()); }).find("does not exist"), std::string::npos);
}

}  // namespace
}  // namespace tarn
