// The list of honoured extensions, and what becomes of the others.
#include "scene/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace tarn {
namespace {

constexpr std::array<std::string_view, 7> HONOURED = {
    "KHR_lights_punctual",   "KHR_materials_emissive_strength",
    "KHR_materials_ior",     "KHR_materials_specular",
    "KHR_materials_unlit",   "KHR_mesh_quantization",
    "KHR_texture_transform",
};

}  // namespace

bool is_honoured_extension(std::string_view name) {
    return std::find(HONOURED.begin(), HONOURED.end(), name) != HONOURED.end();
}

void check_required_extensions(const nlohmann::json& root) {
    const auto required = root.find("extensionsRequired");
    if (required == root.end() || !required->is_array()) return;
    std::string names;
    for (const auto& entry : *required) {
        if (!entry.is_string() || is_honoured_extension(entry.get_ref<const std::string&>())) continue;
        names += (names.empty() ? "" : ", ") + entry.get<std::string>();
    }
    if (!names.empty()) throw Error("requires {}, which is not supported", names);
}

void list_extensions(GltfDocument& document, Scene& scene) {
    scene.extensions_used = document.model.extensionsUsed;
    for (const std::string& name : scene.extensions_used) {
        if (is_honoured_extension(name)) {
            scene.extensions_honoured.push_back(name);
        } else if (name == "KHR_materials_transmission") {
            scene.extensions_approximated.push_back(name);
            document.warn("extension " + name + " is approximated: light goes straight through");
        } else {
            scene.extensions_ignored.push_back(name);
            document.warn("extension " + name + " is not supported, it is ignored");
        }
    }
}

}  // namespace tarn
