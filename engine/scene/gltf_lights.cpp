// Point, spot and directional lights.
#include "scene/gltf_lights.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tarn {
namespace {

LightKind kind_of(const std::string& type, std::size_t index) {
    if (type == "point") return LightKind::POINT;
    if (type == "spot") return LightKind::SPOT;
    if (type == "directional") return LightKind::DIRECTIONAL;
    throw Error("light {} is of type '{}', point, spot and directional are known", index, type);
}

PunctualLight read_light(const tinygltf::Light& source, std::size_t index) {
    PunctualLight light;
    light.name = source.name;
    light.kind = kind_of(source.type, index);
    for (int c = 0; c < 3; ++c) {
        const double color = source.color.size() == 3 ? source.color[std::size_t(c)] : 1.0;
        light.intensity[c] = float(std::min(std::max(color, 0.0) * std::max(source.intensity, 0.0), 1e30));
    }
    light.range_m = std::max(source.range, 0.0);
    if (light.kind == LightKind::SPOT) {
        light.outer_cone_rad = std::clamp(source.spot.outerConeAngle, 0.0, M_PI / 2);
        light.inner_cone_rad = std::clamp(source.spot.innerConeAngle, 0.0, light.outer_cone_rad);
    }
    return light;
}

}  // namespace

void add_lights(const GltfDocument& document, const std::vector<bool>& is_shown, Scene& scene) {
    const tinygltf::Model& model = document.model;
    for (std::size_t i = 0; i < model.lights.size(); ++i)
        scene.lights.push_back(read_light(model.lights[i], i));
    for (std::size_t i = 0; i < is_shown.size(); ++i) {
        const auto extension = model.nodes[i].extensions.find("KHR_lights_punctual");
        if (extension == model.nodes[i].extensions.end()) continue;
        scene.nodes[i].light = LightIndex(extension->second.Get("light").GetNumberAsInt());
        if (is_shown[i]) scene.light_nodes.push_back(NodeIndex(i));
    }
}

}  // namespace tarn
