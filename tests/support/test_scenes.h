// Scenes that tests load: generated ones from the build folder, and measured ones that a user may not have.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "rays/ray_tracer.h"
#include "scene/gltf_import.h"
#include "world/world.h"

namespace tarn::test {

// A generated scene of content/, by name.
inline std::filesystem::path content_file(const std::string& name) {
    return std::filesystem::path(TARN_BUILD_DIR) / "content" / (name + ".glb");
}

// A scene of the shared folder beside the project; it may be absent.
inline std::filesystem::path shared_file(const std::string& path) {
    return std::filesystem::path(TARN_SHARED_DIR) / "scenes" / path;
}

struct TestScene {
    Scene scene;
    World world;
    std::unique_ptr<RayTracer> tracer;
};

// Loads a scene, moved by `offset_ws`, in its rest pose.
inline std::unique_ptr<TestScene> load_test_scene(const std::filesystem::path& file,
                                                  const glm::dvec3& offset_ws = glm::dvec3(0.0),
                                                  const WorldOptions& options = {}) {
    auto result = std::make_unique<TestScene>();
    result->scene = load_gltf(file);
    for (Node& node : result->scene.nodes) {
        if (node.parent.is_set()) continue;
        if (node.matrix) {
            (*node.matrix)[3] += glm::dvec4(offset_ws, 0.0);
        } else {
            node.local.translation += offset_ws;
        }
    }
    result->world = build_world(result->scene, options);
    result->tracer = create_embree_tracer(result->world);
    return result;
}

// The scene's first camera, or the view that scenes without one get.
inline CameraRecord first_camera(const TestScene& loaded, double aspect) {
    return scene_camera(loaded.scene, loaded.world, CameraIndex(0), aspect, -1.0)
        .value_or(default_camera(loaded.world, aspect));
}

}  // namespace tarn::test
