// The scenes that tarn-content knows, by name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "content/gltf_writer.h"

namespace tarn::content {

struct SceneOptions {
    std::uint64_t seed = 1;
    int count = 1000;             // many_lights: how many emissive triangles, 1 to 1 000 000
    double moving_percent = 0.0;  // many_lights: how many of them drift, in groups of up to 100
    double saturation = 1.0;  // many_lights, coloured_lights: of the lights, 0 (all white) to 1 (pure hues)
};

// Scene names, in the order in which --help lists them.
std::vector<std::string> list_scenes();

// The whole .glb file of a scene; the same arguments give the same bytes. Throws Error for an unknown name or
// a count out of range.
std::string generate_scene(const std::string& name, const SceneOptions& options);

void build_lantern_court(GltfWriter& writer, const SceneOptions& options);
void build_cornell(GltfWriter& writer, const SceneOptions& options);
void build_corner(GltfWriter& writer, const SceneOptions& options);
void build_furnace(GltfWriter& writer, const SceneOptions& options);
void build_furnace_ggx(GltfWriter& writer, const SceneOptions& options);
void build_point_over_plane(GltfWriter& writer, const SceneOptions& options);
void build_rectangle_over_plane(GltfWriter& writer, const SceneOptions& options);
void build_many_lights(GltfWriter& writer, const SceneOptions& options);
void build_coloured_lights(GltfWriter& writer, const SceneOptions& options);
void build_tinted_lights(GltfWriter& writer, const SceneOptions& options);

}  // namespace tarn::content
