// From a scene's name to its builder.
#include "content/scenes.h"

#include "core/error.h"

namespace tarn::content {
namespace {

struct Entry {
    const char* name;
    void (*build)(GltfWriter&, const SceneOptions&);
};

constexpr Entry ENTRIES[] = {
    {"lantern_court", build_lantern_court},
    {"cornell", build_cornell},
    {"corner", build_corner},
    {"furnace", build_furnace},
    {"furnace_ggx", build_furnace_ggx},
    {"point_over_plane", build_point_over_plane},
    {"rectangle_over_plane", build_rectangle_over_plane},
    {"many_lights", build_many_lights},
    {"coloured_lights", build_coloured_lights},
    {"tinted_lights", build_tinted_lights},
};

}  // namespace

std::vector<std::string> list_scenes() {
    std::vector<std::string> names;
    for (const Entry& entry : ENTRIES) names.emplace_back(entry.name);
    return names;
}

std::string generate_scene(const std::string& name, const SceneOptions& options) {
    for (const Entry& entry : ENTRIES) {
        if (name != entry.name) continue;
        GltfWriter writer(name, options.seed);
        entry.build(writer, options);
        return writer.to_bytes();
    }
    throw Error("there is no scene \"{}\"; tarn-content --help lists them", name);
}

}  // namespace tarn::content
