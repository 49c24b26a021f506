// The default scene: a courtyard with arcades, stairs and a market at night, lit by hundreds of lanterns.
#include "content/court.h"
#include "content/scenes.h"

namespace tarn::content {

void build_lantern_court(GltfWriter& writer, const SceneOptions& options) {
    const Random random(options.seed);
    const CourtMaterials materials = make_court_materials(writer, options.seed);
    add_architecture(writer, materials);
    add_stairs(writer, materials);
    add_fountain(writer, materials);
    add_furnishings(writer, materials, random);
    add_stalls(writer, materials, random);
    add_plants(writer, materials, random);
    add_lanterns(writer, materials, random);
    writer.add_directional_light("moon", {0.45f, -0.8f, -0.35f}, {0.55f, 0.72f, 1.0f}, 0.15);
    writer.add_camera("main", {9.0f, 1.7f, 9.4f}, {-2.6f, 2.75f, -4.0f}, 58.0);
    writer.add_camera("arcade", {-12.8f, 1.8f, -13.9f}, {4.0f, 1.9f, -12.9f}, 60.0);
    writer.add_camera("balcony", {-13.7f, 5.6f, -2.3f}, {4.0f, 1.6f, 0.4f}, 65.0);
    writer.add_camera("closeup", {-2.9f, 1.55f, -6.1f}, {-4.5f, 1.15f, -8.9f}, 50.0);
}

}  // namespace tarn::content
