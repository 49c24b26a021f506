// What render, reference and flythrough have in common: which scene, from where, how large.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "world/world.h"

namespace tarn {

struct SceneOptions {
    std::filesystem::path scene;
    int width = 640;
    int height = 360;
    std::string camera;  // empty: the scene's first, or a view of the whole
    std::optional<std::filesystem::path> environment;
    std::optional<float> sky;  // even sky of this radiance; an environment map goes first
    std::uint32_t seed = 0;
    int threads = 0;       // 0: one per core
    double time_s = -1.0;  // < 0: the rest pose
    int scene_index = -1;  // -1: the file's own choice
};

inline constexpr double MIN_EXPOSURE_EV = -40.0;
inline constexpr double MAX_EXPOSURE_EV = 40.0;
inline constexpr double MAX_GLARE_STRENGTH = 8.0;

// A check of an option: a number from `minimum` to `maximum`. CLI11's own Range takes "nan" for one.
CLI::Validator make_finite_range(double minimum, double maximum);

// Adds SCENE and the options above to a command. `options` must outlive the parsing.
void add_scene_options(CLI::App& command, SceneOptions& options);

// The file that SCENE means: a path, or the bare name of one of the project's own scenes, which lie in the
// folder TARN_CONTENT_DIR (environment variable), else beside the program, under ../share/tarn, or where the
// build put them. Throws Error that lists these where a bare name is none of them.
std::filesystem::path resolve_scene_path(const std::filesystem::path& scene);

struct LoadedScene {
    Scene scene;
    World world;
};

// Changes a scene after it was read and before anything is made of it.
using SceneEdit = std::function<void(Scene&)>;

// Loads the scene and flattens it, with the environment map if there is one. Throws Error naming what is
// wrong.
LoadedScene load_scene(const SceneOptions& options, const SceneEdit& edit = {});

// What --camera means where the scene has cameras of these names: one of them, or a free view.
struct CameraChoice {
    std::optional<std::size_t> index;
    std::array<double, 3> position_ws = {};  // the rest is for a free view
    std::array<double, 3> target_ws = {};
    double vertical_fov_deg = 0.0;
};

// Throws Error that lists the names where `text` is neither one of them, an index nor seven numbers that make
// a view.
CameraChoice parse_camera(const std::string& text, const std::vector<std::string>& names);

// The camera that `options.camera` means: a name, an index, or x,y,z,tx,ty,tz,fov_deg. Throws Error listing
// the scene's cameras where there is no such one.
CameraRecord choose_camera(const SceneOptions& options, const Scene& scene, const World& world);

}  // namespace tarn
