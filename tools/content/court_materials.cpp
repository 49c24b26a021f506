// Materials and textures of the lantern court.
#include "content/court.h"
#include "content/textures.h"

namespace tarn::content {
namespace {

constexpr int LARGE_PX = 512;
constexpr int SMALL_PX = 256;

class Maker {
  public:
    explicit Maker(GltfWriter& writer) : writer_(writer) {}

    int plain(const std::string& name, const glm::vec3& color, float roughness, float metallic = 0.0f) {
        return writer_.add_material(
            {.name = name, .base_color = color, .metallic = metallic, .roughness = roughness});
    }

    int textured(const std::string& name, int texture, float repeat_m, float roughness,
                 const glm::vec3& tint = glm::vec3(1.0f)) {
        return writer_.add_material({.name = name,
                                     .base_color = tint,
                                     .roughness = roughness,
                                     .base_color_texture = texture,
                                     .texture_repeat_m = repeat_m});
    }

    int surface(const std::string& name, const SurfacePictures& pictures, float repeat_m, float roughness) {
        MaterialSpec spec{.name = name, .roughness = roughness};
        spec.base_color_texture = writer_.add_texture(name, pictures.base_color);
        spec.normal_texture = writer_.add_texture(name + " normals", pictures.normal);
        if (!pictures.roughness.bytes.empty()) {
            spec.metallic_roughness_texture = writer_.add_texture(name + " roughness", pictures.roughness);
        }
        spec.texture_repeat_m = repeat_m;
        return writer_.add_material(spec);
    }

    int cloth(const std::string& name, int stripes, const glm::vec3& tint) {
        return writer_.add_material({.name = name,
                                     .base_color = tint,
                                     .roughness = 0.9f,
                                     .specular = 0.3f,
                                     .base_color_texture = stripes,
                                     .double_sided = true});
    }

    int glowing(const std::string& name, const glm::vec3& radiance) {
        return writer_.add_material(
            {.name = name, .base_color = glm::vec3(0.4f), .roughness = 0.8f, .radiance = radiance});
    }

  private:
    GltfWriter& writer_;
};

void add_emitters(GltfWriter& writer, Maker& make, CourtMaterials& m, std::uint64_t seed) {
    m.glow = {make.glowing("lantern amber", {14.0f, 3.6f, 0.4f}),
              make.glowing("lantern gold", {13.0f, 5.6f, 0.9f}),
              make.glowing("lantern red", {13.0f, 0.7f, 0.25f}),
              make.glowing("lantern rose", {12.0f, 1.0f, 3.2f}),
              make.glowing("lantern green", {1.0f, 8.5f, 1.3f}),
              make.glowing("lantern teal", {0.5f, 6.5f, 7.5f}),
              make.glowing("lantern blue", {0.7f, 2.2f, 16.0f}),
              make.glowing("lantern violet", {5.5f, 0.8f, 15.0f})};
    m.lamp = make.glowing("lamp", {52.0f, 23.0f, 6.0f});
    m.bright_lamp = make.glowing("bright lamp", {90.0f, 52.0f, 20.0f});
    const int leaded = writer.add_texture("leaded window", make_leaded_window(SMALL_PX, seed));
    m.window = writer.add_material({.name = "window",
                                    .base_color = glm::vec3(0.02f),
                                    .roughness = 0.15f,
                                    .radiance = glm::vec3(2.4f),
                                    .emission_texture = leaded});
}

}  // namespace

CourtMaterials make_court_materials(GltfWriter& writer, std::uint64_t seed) {
    Maker make(writer);
    CourtMaterials m{};
    m.cobbles = make.surface("cobbles", make_cobbles(LARGE_PX, seed), 2.4f, 1.0f);
    m.ashlar = make.surface("ashlar", make_ashlar(LARGE_PX, seed + 10), 2.4f, 0.85f);
    const int plaster = writer.add_texture("plaster", make_plaster(SMALL_PX, seed + 20));
    m.plaster = make.textured("plaster", plaster, 3.0f, 0.95f);
    m.dressed_stone = make.textured("dressed stone", plaster, 1.5f, 0.7f, {1.0f, 1.05f, 1.1f});
    const int planks = writer.add_texture("planks", make_planks(SMALL_PX, seed + 30));
    m.planks = make.textured("planks", planks, 1.2f, 0.75f);
    m.dark_wood = make.textured("dark wood", planks, 1.2f, 0.6f, {0.42f, 0.36f, 0.33f});
    m.paint_blue = make.textured("painted door", planks, 1.2f, 0.5f, {0.25f, 0.62f, 0.95f});
    m.clay =
        make.textured("clay tiles", writer.add_texture("clay", make_clay(SMALL_PX, seed + 40)), 1.6f, 0.8f);
    m.terracotta = make.plain("terracotta", {0.45f, 0.18f, 0.09f}, 0.65f);
    m.bark = make.plain("bark", {0.11f, 0.075f, 0.05f}, 0.95f);
    m.soil = make.plain("soil", {0.05f, 0.035f, 0.025f}, 1.0f);
    m.brass = make.plain("brass", {0.86f, 0.62f, 0.28f}, 0.22f, 1.0f);
    m.iron = make.plain("iron", {0.18f, 0.17f, 0.16f}, 0.45f, 1.0f);
    m.water = make.plain("water", {0.006f, 0.014f, 0.018f}, 0.06f);
    m.puddle = make.plain("puddle", {0.02f, 0.019f, 0.018f}, 0.04f);
    m.leaves = writer.add_material(
        {.name = "leaves",
         .roughness = 0.7f,
         .specular = 0.5f,
         .base_color_texture = writer.add_texture("leaves", make_leaves(SMALL_PX, seed + 50)),
         .alpha_mask = true,
         .double_sided = true});
    const int stripes = writer.add_texture("stripes", make_stripes(SMALL_PX, seed + 60));
    m.cloth = {make.cloth("red cloth", stripes, {0.62f, 0.06f, 0.05f}),
               make.cloth("ochre cloth", stripes, {0.75f, 0.45f, 0.1f}),
               make.cloth("blue cloth", stripes, {0.08f, 0.18f, 0.5f}),
               make.cloth("green cloth", stripes, {0.1f, 0.35f, 0.16f})};
    m.fruit = {make.plain("oranges", {0.85f, 0.32f, 0.03f}, 0.45f),
               make.plain("apples", {0.55f, 0.04f, 0.03f}, 0.3f),
               make.plain("limes", {0.3f, 0.5f, 0.06f}, 0.4f),
               make.plain("plums", {0.16f, 0.04f, 0.15f}, 0.35f)};
    add_emitters(writer, make, m, seed + 70);
    return m;
}

}  // namespace tarn::content
