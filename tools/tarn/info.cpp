// tarn info SCENE: what a glTF file holds, as a table and as JSON.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands.h"
#include "output/output_files.h"
#include "scene/gltf_import.h"
#include "scene/pose.h"
#include "scene_options.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    std::filesystem::path scene;
    std::filesystem::path json;
    int scene_index = -1;
};

struct LightCounts {
    std::size_t point = 0;
    std::size_t spot = 0;
    std::size_t directional = 0;
    std::size_t emissive_triangles = 0;
};

bool is_emissive(const Material& material) {
    return material.emission != glm::vec3(0.0f);
}

std::size_t count_triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        count += at(scene.meshes, instance.mesh).triangles.size();
    return count;
}

std::size_t count_unique_triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += mesh.triangles.size();
    return count;
}

LightCounts count_lights(const Scene& scene) {
    LightCounts counts;
    for (const NodeIndex node : scene.light_nodes) {
        const LightKind kind = at(scene.lights, at(scene.nodes, node).light).kind;
        if (kind == LightKind::POINT) ++counts.point;
        if (kind == LightKind::SPOT) ++counts.spot;
        if (kind == LightKind::DIRECTIONAL) ++counts.directional;
    }
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = at(scene.meshes, instance.mesh);
        if (is_emissive(at(scene.materials, mesh.material)))
            counts.emissive_triangles += mesh.triangles.size();
    }
    return counts;
}

Json list_of(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json describe_lights(const Scene& scene) {
    const LightCounts counts = count_lights(scene);
    Json json = {{"point", counts.point},
                 {"spot", counts.spot},
                 {"directional", counts.directional},
                 {"emissive_triangles", counts.emissive_triangles},
                 {"punctual", Json::array()}};
    constexpr std::array<const char*, 3> KINDS = {"point", "spot", "directional"};
    for (const NodeIndex node : scene.light_nodes) {
        const PunctualLight& light = at(scene.lights, at(scene.nodes, node).light);
        json["punctual"].push_back({{"name", light.name},
                                    {"kind", KINDS[std::size_t(light.kind)]},
                                    {"node", node.value},
                                    {"intensity", list_of(glm::dvec3(light.intensity))}});
    }
    return json;
}

Json describe_materials(const Scene& scene) {
    constexpr std::array<const char*, 3> ALPHA_MODES = {"OPAQUE", "MASK", "BLEND"};
    Json list = Json::array();
    for (const Material& material : scene.materials) {
        list.push_back({{"name", material.name},
                        {"alpha_mode", ALPHA_MODES[std::size_t(material.alpha_mode)]},
                        {"double_sided", material.double_sided},
                        {"unlit", material.unlit},
                        {"emission", list_of(glm::dvec3(material.emission))},
                        {"base_color_map", material.base_color_map.texture.is_set()},
                        {"metallic_roughness_map", material.metallic_roughness_map.texture.is_set()},
                        {"normal_map", material.normal_map.texture.is_set()},
                        {"emission_map", material.emission_map.texture.is_set()}});
    }
    return list;
}

Json describe_textures(const Scene& scene) {
    Json list = Json::array();
    for (const Texture& texture : scene.textures) {
        const TextureImage& image = at(scene.images, texture.image);
        list.push_back({{"name", image.name}, {"width_px", image.width}, {"height_px", image.height}});
    }
    return list;
}

Json describe_cameras(const Scene& scene) {
    Json list = Json::array();
    for (const Camera& camera : scene.cameras) {
        Json json = {
            {"name", camera.name}, {"orthographic", camera.orthographic}, {"node", camera.node.value}};
        if (camera.orthographic) {
            json["half_height_m"] = camera.half_height_m;
        } else {
            json["vertical_fov_deg"] = glm::degrees(camera.vertical_fov_rad);
        }
        list.push_back(json);
    }
    return list;
}

Json describe_animations(const Scene& scene) {
    Json list = Json::array();
    for (const Animation& animation : scene.animations) {
        list.push_back({{"name", animation.name},
                        {"channels", animation.channels.size()},
                        {"duration_s", animation.duration_s}});
    }
    return list;
}

Json describe_bounds(const Bounds& bounds) {
    if (bounds.empty()) return nullptr;
    return {{"lower", list_of(bounds.lower)}, {"upper", list_of(bounds.upper)}};
}

Json describe_scene(const InfoOptions& options, const Scene& scene) {
    return {{"file", options.scene.string()},
            {"scene", scene.name},
            {"triangles", count_triangles(scene)},
            {"unique_triangles", count_unique_triangles(scene)},
            {"instances", scene.instances.size()},
            {"meshes", scene.meshes.size()},
            {"nodes", scene.nodes.size()},
            {"skins", scene.skins.size()},
            {"lights", describe_lights(scene)},
            {"materials", describe_materials(scene)},
            {"textures", describe_textures(scene)},
            {"images", scene.images.size()},
            {"cameras", describe_cameras(scene)},
            {"animations", describe_animations(scene)},
            {"bounds_m", describe_bounds(compute_bounds(scene, evaluate_pose(scene, -1.0)))},
            {"extensions",
             {{"used", scene.extensions_used},
              {"honoured", scene.extensions_honoured},
              {"approximated", scene.extensions_approximated},
              {"ignored", scene.extensions_ignored}}}};
}

void print_row(const char* label, const std::string& value) {
    fmt::print("{:<16}{}\n", label, value);
}

std::string join_names(const Json& list) {
    std::string text;
    for (const Json& entry : list) {
        const std::string name =
            entry.is_string() ? entry.get<std::string>() : entry["name"].get<std::string>();
        text += (text.empty() ? "" : ", ") + (name.empty() ? std::string("(unnamed)") : name);
    }
    return text;
}

// "2: left, right", or "0".
std::string count_and_names(const Json& list) {
    return list.empty() ? "0" : fmt::format("{}: {}", list.size(), join_names(list));
}

std::string shown_bounds(const Json& bounds) {
    if (bounds.is_null()) return "none";
    const auto corner = [&](const char* key) {
        const Json& c = bounds[key];
        return fmt::format("({:.6g}, {:.6g}, {:.6g})", c[0].get<double>(), c[1].get<double>(),
                           c[2].get<double>());
    };
    return corner("lower") + " to " + corner("upper") + " m";
}

void print_info(const Json& info) {
    const Json& lights = info["lights"];
    print_row("file", info["file"]);
    print_row("scene", info["scene"]);
    print_row("triangles", fmt::format("{} ({} before instancing)", info["triangles"].get<std::size_t>(),
                                       info["unique_triangles"].get<std::size_t>()));
    print_row("instances", fmt::format("{} of {} meshes, {} skins", info["instances"].get<std::size_t>(),
                                       info["meshes"].get<std::size_t>(), info["skins"].get<std::size_t>()));
    print_row("lights", fmt::format("{} point, {} spot, {} directional, {} emissive triangles",
                                    lights["point"].get<std::size_t>(), lights["spot"].get<std::size_t>(),
                                    lights["directional"].get<std::size_t>(),
                                    lights["emissive_triangles"].get<std::size_t>()));
    print_row("materials", std::to_string(info["materials"].size()));
    print_row("textures",
              fmt::format("{} of {} images", info["textures"].size(), info["images"].get<std::size_t>()));
    print_row("cameras", count_and_names(info["cameras"]));
    print_row("animations", count_and_names(info["animations"]));
    print_row("bounds", shown_bounds(info["bounds_m"]));
    print_row("extensions", count_and_names(info["extensions"]["used"]));
    print_row("  honoured", count_and_names(info["extensions"]["honoured"]));
    print_row("  approximated", count_and_names(info["extensions"]["approximated"]));
    print_row("  ignored", count_and_names(info["extensions"]["ignored"]));
}

void run_info(const InfoOptions& options) {
    check_output_folder(options.json);
    const Scene scene = load_gltf(resolve_scene_path(options.scene), {.scene_index = options.scene_index});
    const Json info = describe_scene(options, scene);
    print_info(info);
    if (!options.json.empty()) write_json(options.json, info);
}

}  // namespace

void add_info_command(CLI::App& app) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* command =
        app.add_subcommand("info", "List what a glTF scene holds and which extensions are honoured");
    command->add_option("scene", options->scene, "A .gltf or .glb file")->required()->type_name("SCENE");
    command->add_option("--json", options->json, "Write everything as JSON to this file")->type_name("FILE");
    command
        ->add_option("--scene", options->scene_index, "Index of the scene (default: the file's own choice)")
        ->check(CLI::NonNegativeNumber)
        ->type_name("N");
    command->callback([options] { run_info(*options); });
}

}  // namespace tarn
