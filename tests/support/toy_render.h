// Renders scenes written in code with the GL renderer, and checks what must hold of every picture.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/log.h"
#include "renderer/renderer.h"
#include "support/toy_scenes.h"

namespace tarn::test {

// Moves all that has no parent: nodes, and with them meshes, lights and cameras.
inline void transform_scene(Scene& scene, const glm::dmat4& ws_from_old) {
    for (Node& node : scene.nodes) {
        if (node.parent.is_set()) continue;
        const Transform& t = node.local;
        const glm::dmat4 local =
            node.matrix.value_or(glm::translate(glm::dmat4(1.0), t.translation) * glm::mat4_cast(t.rotation) *
                                 glm::scale(glm::dmat4(1.0), t.scale));
        node.matrix = ws_from_old * local;
    }
}

// A scene with all that renders it. Needs a current GL context. `planted` reaches every shader
// (TARN_PLANT_*).
class ToyRender {
  public:
    ToyRender(Scene scene, int width_px, int height_px, const WorldOptions& options = {},
              std::vector<std::string> planted = {})
        : scene_(std::move(scene)),
          world_(build_world(scene_, options)),
          tracer_(create_embree_tracer(world_)),
          renderer_(world_, *tracer_, width_px, height_px, std::move(planted)) {
        set_quiet(true);
    }

    RenderSettings settings;  // of the next frames; their mode comes with each call

    const Scene& scene() const { return scene_; }
    const World& world() const { return world_; }
    int width_px() const { return renderer_.width_px(); }
    int height_px() const { return renderer_.height_px(); }
    double aspect() const { return double(width_px()) / height_px(); }

    CameraRecord first_camera() const {
        return scene_camera(scene_, world_, CameraIndex(0), aspect(), -1.0).value();
    }
    CameraRecord look(const glm::dvec3& position_ws, const glm::dvec3& target_ws,
                      double vertical_fov_deg) const {
        return look_at(world_, position_ws, target_ws, vertical_fov_deg, aspect());
    }

    // Mean of `frames` frames from number `first_frame` on; keeps which instance each pixel saw. Fails the
    // test where a frame holds a value that is negative or not finite, or where a counter moved.
    Image render(const CameraRecord& camera, DirectMode mode, int frames = 1, int first_frame = 0) {
        FrameInput input;
        input.camera = camera;
        input.settings = settings;
        input.settings.direct.mode = mode;
        std::vector<double> sums(std::size_t(width_px()) * std::size_t(height_px()) * 3);
        for (int frame = 0; frame < frames; ++frame) {
            input.frame = std::uint32_t(first_frame + frame);
            const FrameOutput output = renderer_.render(input);
            const Image image = renderer_.read_radiance(output.radiance);
            std::size_t bad = 0;
            for (std::size_t i = 0; i < sums.size(); ++i) {
                if (!std::isfinite(image.values[i]) || image.values[i] < 0.0f) ++bad;
                sums[i] += image.values[i];
            }
            EXPECT_EQ(bad, 0u) << "values that are negative or not finite in frame " << frame;
            if (frame == 0) seen_ = output.gbuffer.seen->download<glm::uvec2>();
        }
        for (const auto& [name, value] : renderer_.read_counters()) EXPECT_EQ(value, 0u) << name;
        Image mean(width_px(), height_px(), 3);
        for (std::size_t i = 0; i < sums.size(); ++i) mean.values[i] = float(sums[i] / frames);
        return mean;
    }

    // The instance that the pixel saw at the last render(), INVALID_INDEX for none.
    std::uint32_t seen_instance(int x, int y) const { return seen_[std::size_t(y * width_px() + x)].x; }

    // The ray through the centre of a pixel in double precision, in world space.
    glm::dvec3 ray_direction(const CameraRecord& c, int x, int y) const {
        const double px = 2.0 * (x + 0.5) / width_px() - 1.0, py = 1.0 - 2.0 * (y + 0.5) / height_px();
        return glm::normalize(glm::dvec3(c.forward) + glm::dvec3(c.right) * px + glm::dvec3(c.up) * py);
    }
    glm::dvec3 camera_position_ws(const CameraRecord& c) const {
        return glm::dvec3(c.position) + world_.origin_ws;
    }

  private:
    Scene scene_;
    World world_;
    std::unique_ptr<RayTracer> tracer_;
    Renderer renderer_;
    std::vector<glm::uvec2> seen_;
};

// Mean over all pixels and channels.
inline double mean_of(const Image& image) {
    double sum = 0.0;
    for (const float value : image.values) sum += value;
    return sum / double(image.values.size());
}

// How many values of `image` are not those of `one` times `scale`, to the bit.
inline std::size_t count_off_scale(const Image& one, const Image& image, float scale) {
    std::size_t off = 0;
    for (std::size_t i = 0; i < one.values.size(); ++i) off += image.values[i] != one.values[i] * scale;
    return off;
}

}  // namespace tarn::test
