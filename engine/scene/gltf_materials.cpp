// Materials: metallic-roughness, emission, alpha, and the extensions that change those.
#include "scene/gltf_materials.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/error.h"
#include "scene/gltf_images.h"

namespace tarn {
namespace {

using Extensions = tinygltf::ExtensionMap;

const tinygltf::Value* find_extension(const Extensions& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

double number_or(const tinygltf::Value* object, const char* name, double otherwise) {
    return object != nullptr && object->Has(name) ? object->Get(name).GetNumberAsDouble() : otherwise;
}

glm::vec2 vec2_or(const tinygltf::Value& object, const char* name, const glm::vec2& otherwise) {
    if (!object.Has(name)) return otherwise;
    const tinygltf::Value& array = object.Get(name);
    return glm::vec2(array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble());
}

float unit_interval(double value) {
    return float(std::clamp(value, 0.0, 1.0));
}

AlphaMode alpha_mode_of(const std::string& name, int index, GltfDocument& document) {
    if (name == "MASK") return AlphaMode::MASK;
    if (name == "BLEND") return AlphaMode::BLEND;
    if (name != "OPAQUE") {
        document.warn(fmt::format("materials[{}].alphaMode '{}' is unknown, OPAQUE is taken", index, name));
    }
    return AlphaMode::OPAQUE;
}

// The texture index is left as the file's; add_textures() replaces it.
template <class TextureInfo>
TextureSlot read_slot(const TextureInfo& info, GltfDocument& document) {
    TextureSlot slot;
    if (info.index < 0) return slot;
    slot.texture = TextureIndex(info.index);
    slot.uv_set = info.texCoord;
    if (const auto* transform = find_extension(info.extensions, "KHR_texture_transform")) {
        slot.offset = vec2_or(*transform, "offset", slot.offset);
        slot.scale = vec2_or(*transform, "scale", slot.scale);
        slot.rotation_rad = float(number_or(transform, "rotation", 0.0));
        slot.uv_set = int(number_or(transform, "texCoord", slot.uv_set));
    }
    if (slot.uv_set > 1) {
        document.warn(
            fmt::format("textures[{}] is used with TEXCOORD_{}, which is not supported: it is ignored",
                        info.index, slot.uv_set));
        return {};
    }
    return slot;
}

void read_emission(const tinygltf::Material& source, Material& material) {
    const auto* strength = find_extension(source.extensions, "KHR_materials_emissive_strength");
    const double scale = std::max(number_or(strength, "emissiveStrength", 1.0), 0.0);
    for (int c = 0; c < 3 && !source.emissiveFactor.empty(); ++c) {
        const double radiance = std::max(source.emissiveFactor[std::size_t(c)], 0.0) * scale;
        material.emission[c] = float(std::min(radiance, 1e30));
    }
}

void read_specular(const tinygltf::Material& source, int index, GltfDocument& document, Material& material) {
    const auto* ior = find_extension(source.extensions, "KHR_materials_ior");
    material.ior = float(number_or(ior, "ior", 1.5));
    // 0 is the extension's way to say "F0 = 1"; between 0 and 1 nothing is meant.
    if (material.ior != 0.0f) material.ior = std::max(material.ior, 1.0f);
    const auto* specular = find_extension(source.extensions, "KHR_materials_specular");
    if (specular == nullptr) return;
    material.specular = unit_interval(number_or(specular, "specularFactor", 1.0));
    if (specular->Has("specularColorFactor")) {
        for (int c = 0; c < 3; ++c) {
            const double factor = specular->Get("specularColorFactor").Get(c).GetNumberAsDouble();
            material.specular_color[c] = float(std::max(factor, 0.0));
        }
    }
    if (specular->Has("specularTexture") || specular->Has("specularColorTexture")) {
        document.warn(fmt::format("materials[{}]: textures of KHR_materials_specular are ignored", index));
    }
}

// Glass, roughly: what KHR_materials_transmission lets through goes straight on, as if the surface were not
// there for that share of the rays. Without it, lamps behind glass would light nothing. Masks keep their
// mode, and a factor that comes with a texture is left out, since the texture may well be black.
void read_transmission(const tinygltf::Material& source, Material& material) {
    const auto* transmission = find_extension(source.extensions, "KHR_materials_transmission");
    if (transmission == nullptr || transmission->Has("transmissionTexture")) return;
    const float factor = unit_interval(number_or(transmission, "transmissionFactor", 0.0));
    if (factor == 0.0f || material.alpha_mode == AlphaMode::MASK) return;
    if (material.alpha_mode == AlphaMode::OPAQUE) material.base_color.a = 1.0f;
    material.alpha_mode = AlphaMode::BLEND;
    material.base_color.a *= 1.0f - factor;
}

Material read_material(const tinygltf::Material& source, int index, GltfDocument& document) {
    Material material;
    material.name = source.name;
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    for (int c = 0; c < 4; ++c) material.base_color[c] = unit_interval(pbr.baseColorFactor[std::size_t(c)]);
    material.metallic = unit_interval(pbr.metallicFactor);
    material.roughness = unit_interval(pbr.roughnessFactor);
    material.normal_scale = float(source.normalTexture.scale);
    material.alpha_mode = alpha_mode_of(source.alphaMode, index, document);
    material.alpha_cutoff = float(source.alphaCutoff);
    material.double_sided = source.doubleSided;
    material.unlit = find_extension(source.extensions, "KHR_materials_unlit") != nullptr;
    material.base_color_map = read_slot(pbr.baseColorTexture, document);
    material.metallic_roughness_map = read_slot(pbr.metallicRoughnessTexture, document);
    material.normal_map = read_slot(source.normalTexture, document);
    material.emission_map = read_slot(source.emissiveTexture, document);
    read_emission(source, material);
    read_specular(source, index, document, material);
    read_transmission(source, material);
    return material;
}

Wrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::CLAMP;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::MIRROR;
    return Wrap::REPEAT;
}

// Makes textures on demand; each (texture, encoding) and each (image, encoding) once.
class TextureTable {
  public:
    TextureTable(GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

    // The scene's texture for a texture of the file; unset where its image is of no format that is read.
    TextureIndex find_or_add(int texture, TexelEncoding encoding) {
        const auto [entry, is_new] = textures_.try_emplace({texture, encoding});
        if (is_new) entry->second = add(texture, encoding);
        return entry->second;
    }

  private:
    using Key = std::pair<int, TexelEncoding>;

    TextureIndex add(int index, TexelEncoding encoding) {
        const tinygltf::Texture& source = document_.model.textures[std::size_t(index)];
        if (source.source < 0) {
            document_.warn(fmt::format("textures[{}] has no PNG or JPEG image, it is ignored", index));
            return {};
        }
        Texture texture;
        texture.image = find_or_add_image(source.source, encoding);
        if (!texture.image.is_set()) return {};
        if (source.sampler >= 0) {
            const tinygltf::Sampler& sampler = document_.model.samplers[std::size_t(source.sampler)];
            texture.wrap_u = wrap_of(sampler.wrapS);
            texture.wrap_v = wrap_of(sampler.wrapT);
            texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
        scene_.textures.push_back(texture);
        return TextureIndex(scene_.textures.size() - 1);
    }

    // Unset for an image of a format that is ignored.
    ImageIndex find_or_add_image(int index, TexelEncoding encoding) {
        const auto [entry, is_new] = images_.try_emplace({index, encoding});
        if (!is_new) return entry->second;
        if (auto image = load_gltf_image(document_, index, encoding)) {
            entry->second = ImageIndex(scene_.images.size());
            scene_.images.push_back(std::move(*image));
        }
        return entry->second;
    }

    GltfDocument& document_;
    Scene& scene_;
    std::map<Key, TextureIndex> textures_;
    std::map<Key, ImageIndex> images_;
};

}  // namespace

void add_materials(GltfDocument& document, Scene& scene) {
    for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
        scene.materials.push_back(read_material(document.model.materials[i], int(i), document));
    }
    scene.materials.emplace_back().name = "default";
}

void add_textures(GltfDocument& document, const std::vector<bool>& is_used, Scene& scene) {
    TextureTable table(document, scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& material = scene.materials[i];
        const std::array<std::pair<TextureSlot*, TexelEncoding>, 4> slots = {{
            {&material.base_color_map, TexelEncoding::SRGB},
            {&material.metallic_roughness_map, TexelEncoding::LINEAR},
            {&material.normal_map, TexelEncoding::LINEAR},
            {&material.emission_map, TexelEncoding::SRGB},
        }};
        for (const auto& [slot, encoding] : slots) {
            if (!slot->texture.is_set()) continue;
            slot->texture =
                is_used[i] ? table.find_or_add(int(slot->texture.value), encoding) : TextureIndex();
        }
    }
}

}  // namespace tarn
