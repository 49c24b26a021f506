// A flythrough: camera keys in time, joined by a smooth curve, and nodes of the scene that move along
// paths of their own.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tarn {

struct CameraKey {
    double time_s = 0.0;
    glm::dvec3 position_ws{0.0};
    glm::dvec3 target_ws{0.0, 0.0, -1.0};
    double vertical_fov_deg = 60.0;
};

// Where a node is at a moment, relative to its parent as its own placement is; what is not given stays.
struct NodeKey {
    double time_s = 0.0;
    std::optional<glm::dvec3> position_ns;
    std::optional<glm::dvec3> rotation_deg;  // about x, then y, then z
};

// The path of one node, such as a light or an object, and of all its children.
struct NodeTrack {
    std::string node;           // its name
    std::vector<NodeKey> keys;  // at least one, times strictly increasing
};

struct CameraPath {
    std::string name;
    std::string scene;  // the scene it was made for; a name or a path
    double duration_s = 0.0;
    std::vector<CameraKey> keys;  // at least one, times strictly increasing
    std::vector<NodeTrack> tracks;
};

// Reads a path file (JSON; content/README.md describes it). Throws Error that names the file and what is
// wrong.
CameraPath load_camera_path(const std::filesystem::path& file);

// The camera at `time_s`, clamped to the path: a Catmull-Rom curve through the keys, with tangents that
// respect uneven key times.
CameraKey evaluate_camera_path(const CameraPath& path, double time_s);

}  // namespace tarn
