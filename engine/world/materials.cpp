// Materials and the pool of texels.
#include <cmath>

#include "core/error.h"
#include "world/build_steps.h"

namespace tarn {
namespace {

// What a texture buffer is sure to hold on the drivers in use (llvmpipe, NVIDIA, AMD, Intel: 2^27 and more).
constexpr std::size_t TEXEL_LIMIT = std::size_t(1) << 27;

void add_texels(World& world, const Scene& scene) {
    for (const TextureImage& image : scene.images) {
        if (world.texels.size() + image.texels.size() > TEXEL_LIMIT) {
            throw Error("{}: image '{}' would make {} texels, the texture pool holds {}", scene.name,
                        image.name, world.texels.size() + image.texels.size(), TEXEL_LIMIT);
        }
        world.texels.insert(world.texels.end(), image.texels.begin(), image.texels.end());
    }
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

// Where each image's texels begin in the pool.
std::vector<std::uint32_t> find_texels(const Scene& scene) {
    std::vector<std::uint32_t> first_texel;
    std::size_t next = 0;
    for (const TextureImage& image : scene.images) {
        first_texel.push_back(std::uint32_t(next));
        next += image.texels.size();
    }
    return first_texel;
}

std::vector<glm::uvec4> make_material_rows(const Scene& scene) {
    const std::vector<std::uint32_t> first_texel = find_texels(scene);
    std::vector<glm::uvec4> all;
    for (const Material& material : scene.materials) {
        glm::uvec4 rows[MATERIAL_ROWS];
        pack_material(make_record(material), rows[0], rows[1], rows[2], rows[3]);
        const TextureSlot* slots[] = {&material.base_color_map, &material.metallic_roughness_map,
                                      &material.normal_map, &material.emission_map};
        for (int s = 0; s < 4; ++s) {
            pack_slot(make_slot(scene, *slots[s], first_texel), rows[4 + 2 * s], rows[5 + 2 * s]);
        }
        all.insert(all.end(), rows, rows + MATERIAL_ROWS);
    }
    return all;
}

}  // namespace

void add_materials(World& world, const Scene& scene) {
    add_texels(world, scene);
    world.material_rows = make_material_rows(scene);
    for (const Material& material : scene.materials) world.material_flags.push_back(material_flags(material));
    world.material_revision = 1;
}

void update_materials(World& world, const Scene& scene) {
    std::vector<glm::uvec4> rows = make_material_rows(scene);
    TARN_ASSERT(rows.size() == world.material_rows.size(), "{}: materials were added or removed", scene.name);
    if (rows == world.material_rows) return;
    world.material_rows = std::move(rows);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        world.material_flags[m] = material_flags(scene.materials[m]);
    }
    ++world.material_revision;
}

}  // namespace tarn
