#include "stage_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace game {
namespace {

std::string lower_ending(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char letter) { return char(std::tolower(letter)); });
    return ending;
}

}  // namespace

std::unique_ptr<Stage> load_stage(const StageSource& source) {
    SceneOptions options;
    options.environment = source.sky;
    return std::make_unique<Stage>(Scene::load(Scene::find_file(source.scene), options), source.fireflies);
}

StageSource with_file(const StageSource& source, const std::filesystem::path& file) {
    const std::string ending = lower_ending(file);
    if (ending == ".gltf" || ending == ".glb") return {file.string(), {}, source.fireflies};
    if (ending == ".hdr" || ending == ".exr") return {source.scene, file, source.fireflies};
    throw Error(fmt::format("{}: neither a scene (.gltf, .glb) nor a sky (.hdr, .exr)", file.string()));
}

}  // namespace game
