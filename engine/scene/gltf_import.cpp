// The sequence of a glTF import: take the file apart, then fill one table after the other.
#include "scene/gltf_import.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/log.h"
#include "scene/gltf_animations.h"
#include "scene/gltf_document.h"
#include "scene/gltf_extensions.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_meshes.h"
#include "scene/gltf_nodes.h"

namespace tarn {
namespace {

std::vector<bool> find_used_materials(const Scene& scene) {
    std::vector<bool> is_used(scene.materials.size(), false);
    for (const Mesh& mesh : scene.meshes) is_used[mesh.material.value] = true;
    return is_used;
}

Scene build_scene(GltfDocument& document, const GltfOptions& options) {
    Scene scene;
    list_extensions(document, scene);
    add_materials(document, scene);
    const auto meshes = add_meshes(document, scene);
    add_nodes(document, scene);
    add_skins(document, scene);
    const std::vector<bool> is_shown = find_shown_nodes(document, options.scene_index, scene);
    add_instances(document, is_shown, meshes, scene);
    add_cameras(document, is_shown, scene);
    add_lights(document, is_shown, scene);
    add_animations(document, scene);
    drop_unused_meshes(scene);
    add_textures(document, find_used_materials(scene), scene);
    if (scene.name.empty()) scene.name = document.path.stem().string();
    return scene;
}

// Scenes of formats that people have at hand, by their name.
void refuse_other_formats(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 11> OTHERS = {".obj", ".fbx",  ".dae",  ".stl",   ".ply", ".3ds",
                                                         ".usd", ".usda", ".usdc", ".blend", ".usdz"};
    std::string extension = path.extension().string();
    for (char& letter : extension) letter = char(std::tolower(static_cast<unsigned char>(letter)));
    if (std::find(OTHERS.begin(), OTHERS.end(), extension) == OTHERS.end()) return;
    throw Error("Tarn reads glTF 2.0 alone (.gltf, .glb); Blender writes it: File, Export, glTF 2.0");
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const GltfOptions& options) {
    try {
        refuse_other_formats(path);
        GltfDocument document = load_gltf_document(path);
        Scene scene = build_scene(document, options);
        for (const std::string& warning : document.warnings) warn_once(path.string() + ": " + warning);
        return scene;
    } catch (const std::bad_alloc&) {
        throw Error("{}: needs more memory than there is", path.string());
    } catch (const std::exception& error) {
        std::string line = error.what();
        for (char& c : line) {
            if (static_cast<unsigned char>(c) < 0x20) c = ' ';
        }
        throw Error("{}: {}", path.string(), line);
    }
}

}  // namespace tarn
