// Materials, textures and images of a glTF file.
#include <gtest/gtest.h>
#include <stb_image_write.h>

#include <cmath>

#include "unit/gltf_builder.h"

namespace tarn {
namespace {

void append(void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

std::string png_uri(int width, int height, const std::vector<std::uint8_t>& rgba) {
    std::vector<std::uint8_t> png;
    stbi_write_png_to_func(append, &png, width, height, 4, rgba.data(), width * 4);
    return "data:image/png;base64," + GltfBuilder::base64(png);
}

// One triangle with `material` shown, so that its textures are needed.
GltfBuilder with_material(const nlohmann::json& material) {
    GltfBuilder gltf;
    gltf.push("materials", material);
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}, {"material", 0}});
    return gltf;
}

void add_texture(GltfBuilder& gltf, const std::string& uri) {
    gltf.push("images", {{"uri", uri}});
    gltf.push("textures", {{"source", 0}});
}

TEST(GltfMaterials, DefaultsAreThoseOfTheSpecification) {
    const Scene scene = with_material(nlohmann::json::object()).load();
    ASSERT_EQ(scene.materials.size(), 2u);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.base_color, glm::vec4(1.0f));
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.roughness, 1.0f);
    EXPECT_EQ(material.emission, glm::vec3(0.0f));
    EXPECT_EQ(material.alpha_mode, AlphaMode::OPAQUE);
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_FALSE(material.double_sided);
}

TEST(GltfMaterials, MeshesWithoutAMaterialGetTheLastOne) {
    GltfBuilder gltf;
    gltf.push("materials", {{"name", "unused"}});
    gltf.show({{"attributes", {{"POSITION", gltf.add_triangle_positions()}}}});
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.meshes.at(0).material, MaterialIndex(1));
    EXPECT_EQ(scene.materials.at(1).name, "default");
}

TEST(GltfMaterials, AlphaModesAndCutoff) {
    GltfBuilder gltf;
    gltf.push("materials", {{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}});
    gltf.push("materials", {{"alphaMode", "BLEND"}, {"doubleSided", true}});
    gltf.push("materials", {{"alphaMode", "OPAQUE"}});
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::MASK);
    EXPECT_EQ(scene.materials[0].alpha_cutoff, 0.25f);
    EXPECT_EQ(scene.materials[1].alpha_mode, AlphaMode::BLEND);
    EXPECT_TRUE(scene.materials[1].double_sided);
    EXPECT_EQ(scene.materials[2].alpha_mode, AlphaMode::OPAQUE);
}

TEST(GltfMaterials, ExtensionsChangeEmissionSpecularAndShading) {
    GltfBuilder gltf;
    gltf.push(
        "materials",
        {{"emissiveFactor", {1.0, 0.5, 0.0}},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8.0}}},
           {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1.0, 0.5, 2.0}}}},
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_unlit", nlohmann::json::object()}}}});
    const Scene scene = gltf.load();
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.emission, glm::vec3(8, 4, 0));
    EXPECT_EQ(material.specular, 0.5f);
    EXPECT_EQ(material.specular_color, glm::vec3(1, 0.5f, 2));
    EXPECT_FLOAT_EQ(material.ior, 1.33f);
    EXPECT_TRUE(material.unlit);
}

TEST(GltfMaterials, TransmissionBecomesPartialCoverage) {
    GltfBuilder gltf;
    const nlohmann::json glass = {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}}};
    gltf.push("materials",
              {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}}, {"extensions", glass}});
    gltf.push("materials", {{"alphaMode", "MASK"}, {"extensions", glass}});
    gltf.json["extensionsUsed"] = {"KHR_materials_transmission"};
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.extensions_approximated, std::vector<std::string>{"KHR_materials_transmission"});
    EXPECT_TRUE(scene.extensions_ignored.empty());
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::BLEND);
    EXPECT_EQ(scene.materials[0].base_color.a, 0.25f);
    EXPECT_EQ(scene.materials[1].alpha_mode, AlphaMode::MASK);
}

TEST(GltfMaterials, TextureTransformsMoveTheirSlotAlone) {
    const nlohmann::json transform = {
        {"offset", {0.25, 0.5}}, {"rotation", 1.5}, {"scale", {2, 3}}, {"texCoord", 1}};
    GltfBuilder gltf = with_material(
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}},
         {"emissiveTexture", {{"index", 0}}}});
    add_texture(gltf, png_uri(1, 1, {255, 255, 255, 255}));
    const Scene scene = gltf.load();
    const TextureSlot& moved = scene.materials[0].base_color_map;
    EXPECT_EQ(moved.offset, glm::vec2(0.25f, 0.5f));
    EXPECT_EQ(moved.scale, glm::vec2(2, 3));
    EXPECT_FLOAT_EQ(moved.rotation_rad, 1.5f);
    EXPECT_EQ(moved.uv_set, 1);
    const TextureSlot& plain = scene.materials[0].emission_map;
    EXPECT_EQ(plain.offset, glm::vec2(0.0f));
    EXPECT_EQ(plain.scale, glm::vec2(1.0f));
    EXPECT_EQ(plain.uv_set, 0);
}

TEST(GltfMaterials, OneImageUsedAsColorAndAsDataIsDecodedTwice) {
    GltfBuilder gltf =
        with_material({{"pbrMetallicRoughness",
                        {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
                       {"emissiveTexture", {{"index", 0}}}});
    add_texture(gltf, png_uri(2, 1, {188, 0, 255, 128, 10, 20, 30, 255}));
    const Scene scene = gltf.load();
    ASSERT_EQ(scene.images.size(), 2u);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.base_color_map.texture, material.emission_map.texture);
    const auto texel = [&](const TextureSlot& slot) {
        return at(scene.images, at(scene.textures, slot.texture).image).texels.at(0);
    };
    // sRGB 188/255 is linear 0.5029; alpha is never encoded.
    const glm::u16vec4 color = texel(material.base_color_map);
    EXPECT_NEAR(color.x / 65535.0, std::pow((188 / 255.0 + 0.055) / 1.055, 2.4), 1e-5);
    EXPECT_EQ(color.z, 65535);
    EXPECT_EQ(color.w, 128 * 257);
    EXPECT_EQ(texel(material.metallic_roughness_map), glm::u16vec4(188 * 257, 0, 65535, 128 * 257));
}

TEST(GltfMaterials, SamplersSetWrapAndFilter) {
    GltfBuilder gltf = with_material({{"emissiveTexture", {{"index", 0}}}});
    add_texture(gltf, png_uri(1, 1, {255, 255, 255, 255}));
    gltf.push("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
    gltf.json["textures"][0]["sampler"] = 0;
    const Scene scene = gltf.load();
    EXPECT_EQ(scene.textures.at(0).wrap_u, Wrap::CLAMP);
    EXPECT_EQ(scene.textures[0].wrap_v, Wrap::MIRROR);
    EXPECT_TRUE(scene.textures[0].nearest);
}

TEST(GltfMaterials, ImagesThatNothingNeedsAreNotDecoded) {
    GltfBuilder gltf = with_material(nlohmann::json::object());
    add_texture(gltf, "data:image/png;base64,AAAA");
    gltf.push("materials", {{"emissiveTexture", {{"index", 0}}}});
    const Scene scene = gltf.load();
    EXPECT_TRUE(scene.images.empty());
    EXPECT_FALSE(scene.materials[1].emission_map.texture.is_set());
}

TEST(GltfMaterials, BrokenImagesAreAnErrorThatNamesThem) {
    GltfBuilder gltf = with_material({{"emissiveTexture", {{"index", 0}}}});
    add_texture(gltf, "data:image/png;base64,AAAA");
    const std::string error = error_of([&] { gltf.load(); });
    EXPECT_NE(error.find("images[0] is neither PNG nor JPEG"), std::string::npos) << error;
}

TEST(GltfMaterials, TexturesOfIgnoredExtensionsLeaveTheirSlotUnset) {
    GltfBuilder gltf = with_material({{"emissiveTexture", {{"index", 0}}}});
    gltf.json["extensionsUsed"] = {"KHR_texture_basisu"};
    gltf.push("images", {{"uri", "a.ktx2"}});
    gltf.push("textures", {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
    const Scene scene = gltf.load();
    EXPECT_FALSE(scene.materials[0].emission_map.texture.is_set());
    EXPECT_EQ(scene.extensions_ignored, std::vector<std::string>{"KHR_texture_basisu"});
}

TEST(GltfMaterials, RequiredExtensionsThatAreNotReadAreNamed) {
    GltfBuilder gltf;
    gltf.json["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_texture_transform",
                                       "KHR_texture_basisu"};
    const std::string error = error_of([&] { gltf.load(); });
    EXPECT_NE(error.find("requires KHR_draco_mesh_compression, KHR_texture_basisu, which"), std::string::npos)
        << error;
}

}  // namespace
}  // namespace tarn
