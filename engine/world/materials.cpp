// Materials and the pool of texels.
#include <cmath>

#include "core/error.h"
#include "world/build_steps.h"

namespace tarn {
namespace {

// What a texture buffer is sure to hold on the drivers in use (llvmpipe, NVIDIA, AMD, Intel: 2^27 and more).
constexpr std::size_t TEXEL_LIMIT = std::size_t(1) << 27;

std::vector<std::uint32_t> add_texels(World& world, const Scene& scene) {
    std::vector<std::uint32_t> first_texel;
    for (const TextureImage& image : scene.images) {
        if (world.texels.size() + image.texels.size() > TEXEL_LIMIT) {
            throw Error("{}: image '{}' would make {} texels, the texture pool holds {}", scene.name,
                        image.name, world.texels.size() + image.texels.size(), TEXEL_LIMIT);
        }
        first_texel.push_back(std::uint32_t(world.texels.size()));
        world.texels.insert(world.texels.end(), image.texels.begin(), image.texels.end());
    }
    return first_texel;
}

SlotRecord make_slot(const Scene& scene, const TextureSlot& slot,
                     const std::vector<std::uint32_t>& first_texel) {
    SlotRecord record{};
    record.scale = glm::vec2(1.0f);
    if (!slot.texture.is_set()) return record;
    const Texture& texture = at(scene.textures, slot.texture);
    if (!texture.image.is_set()) return record;
    const TextureImage& image = at(scene.images, texture.image);
    if (image.texels.empty()) return record;
    record.first_texel = first_texel[texture.image.value];
    record.size = std::uint32_t(image.width) | (std::uint32_t(image.height) << 16);
    record.flags = std::uint32_t(texture.wrap_u) | (std::uint32_t(texture.wrap_v) << 2) | SLOT_PRESENT;
    if (texture.nearest) record.flags |= SLOT_NEAREST;
    if (slot.uv_set == 1) record.flags |= SLOT_SECOND_UV;
    record.rotation_rad = slot.rotation_rad;
    record.offset = slot.offset;
    record.scale = slot.scale;
    return record;
}

std::uint32_t material_flags(const Material& material) {
    std::uint32_t flags = 0;
    if (material.alpha_mode == AlphaMode::MASK) flags |= MATERIAL_ALPHA_MASK;
    if (material.alpha_mode == AlphaMode::BLEND) flags |= MATERIAL_ALPHA_BLEND;
    if (material.double_sided) flags |= MATERIAL_DOUBLE_SIDED;
    if (material.unlit) flags |= MATERIAL_UNLIT;
    return flags;
}

MaterialRecord make_record(const Material& material) {
    MaterialRecord record;
    record.base_color = material.base_color;
    record.emission = material.emission;
    record.alpha_cutoff = material.alpha_cutoff;
    record.metallic = material.metallic;
    record.roughness = material.roughness;
    record.normal_scale = material.normal_scale;
    record.flags = material_flags(material);
    // KHR_materials_ior and KHR_materials_specular: F0 = min(((n-1)/(n+1))^2 * tint, 1) * weight, F90 =
    // weight.
    const float root = material.ior == 0.0f ? 1.0f : (material.ior - 1.0f) / (material.ior + 1.0f);
    record.dielectric_f0 =
        glm::min(root * root * material.specular_color, glm::vec3(1.0f)) * material.specular;
    record.dielectric_f90 = material.specular;
    return record;
}

}  // namespace

void add_materials(World& world, const Scene& scene) {
    const std::vector<std::uint32_t> first_texel = add_texels(world, scene);
    for (const Material& material : scene.materials) {
        glm::uvec4 rows[MATERIAL_ROWS];
        pack_material(make_record(material), rows[0], rows[1], rows[2], rows[3]);
        const TextureSlot* slots[] = {&material.base_color_map, &material.metallic_roughness_map,
                                      &material.normal_map, &material.emission_map};
        for (int s = 0; s < 4; ++s) {
            pack_slot(make_slot(scene, *slots[s], first_texel), rows[4 + 2 * s], rows[5 + 2 * s]);
        }
        world.material_rows.insert(world.material_rows.end(), rows, rows + MATERIAL_ROWS);
        world.material_flags.push_back(material_flags(material));
    }
}

}  // namespace tarn
