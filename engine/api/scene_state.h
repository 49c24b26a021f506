// What a public scene is made of, and who looks at it.
#pragma once

#include <memory>
#include <vector>

#include "rays/ray_tracer.h"
#include "scene/scene.h"
#include "tarn/scene.h"
#include "world/world.h"

namespace tarn::api {

// Told when the world has moved, or was built anew with other geometry; see SceneState::update.
class SceneFollower {
  public:
    virtual ~SceneFollower() = default;
    virtual void follow_scene() = 0;
    virtual void rebuild() = 0;
};

struct SceneState {
    tarn::Scene scene;
    World world;
    std::unique_ptr<RayTracer> tracer;  // once a view needs it
    double time_s = -1.0;
    bool is_stale = false;                  // the world lags behind scene and time
    bool is_outgrown = false;               // and has to be built anew: things or materials came or went
    std::vector<SceneFollower*> followers;  // all views of this scene

    RayTracer& find_tracer();
    // Brings world, rays and all views to what scene and time say.
    void update();

  private:
    void build_anew();
};

// A public vector or placement as GLM's, and back.
inline glm::dvec3 from_public(const Vec3& v) {
    return {v.x, v.y, v.z};
}
inline Vec3 to_public(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

// The record that the renderer takes. Error where the camera's numbers make no picture.
CameraRecord make_record(const Camera& camera, const World& world, double aspect);

}  // namespace tarn::api
