// Which way `tarn flythrough` flies.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scene/camera_path.h"
#include "world/world.h"

namespace tarn {

struct FlightPath {
    CameraPath path;
    std::string origin;  // "its own path lies beside it: F.flythrough.json"
};

// The path of a file: what `option` (--path) names, a file or one of the project's own; else that of the
// project's scene called `scene`; else STEM.flythrough.json beside the scene's file. Empty `scene`:
// lantern_court. Nothing where the scene has no such file. Throws Error as load_camera_path does.
std::optional<FlightPath> find_path_file(const std::string& option, const std::filesystem::path& scene);

// For a scene without a path: the way of its first camera that is animated, else an orbit of its bounds from
// outside.
FlightPath make_flight_path(const Scene& scene, const World& world, double aspect);

}  // namespace tarn
