// Methods side by side over one moving scene: their mean in its last frame against the reference at that
// moment.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "renderer/renderer.h"
#include "shared/math/random.h"
#include "support/kept_reference.h"
#include "support/moving_scenes.h"
#include "support/on_context.h"
#include "support/tile_test.h"

namespace tarn::test {

constexpr int WIDTH_PX = 64;
constexpr int HEIGHT_PX = 48;
constexpr int TILE_PX = 16;
constexpr double SIGNIFICANCE = 0.01;
// What a test must be able to find, nine times in ten.
struct Power {
    double in_picture = 0.01;
    double in_tile = 0.03;
};

// What a method does in each frame; `planted` are mistakes for its shaders (TARN_PLANT_*).
struct MotionMethod {
    std::string name;
    std::function<RenderSettings(int frame)> settings;
    std::vector<std::string> planted = {};
    bool draws_all_frames = false;  // also those that leave nothing for the last one
};

struct MotionResult {
    TileTest picture;  // as one tile
    TileTest tiles;
    double energy = 0.0;  // mean over the reference's
};

class MotionTest : public OnContext<> {
  protected:
    // Independent runs of each method: more of them find smaller biases.
    static constexpr int SEEDS = 32;
    static constexpr int SEEDS_OF_BOUNDS = 8;

    // At most `seeds` runs, fewer where a planted mistake stands out, or where all methods have the power
    // that is asked for.
    static std::vector<MotionResult> run(MovingScene moving, const std::vector<MotionMethod>& methods,
                                         int seeds = SEEDS, Power power = {}) {
        moving.pose(moving.scene, LAST_FRAME);
        World world = build_world(moving.scene, moving.options);
        const auto tracer = create_embree_tracer(world);
        const double aspect = double(WIDTH_PX) / HEIGHT_PX;
        const CameraRecord camera = look_at(world, moving.camera_ws, moving.target_ws, 45.0, aspect);
        const IndirectSettings indirect = methods.front().settings(LAST_FRAME).indirect;  // alike for all
        TileReference truth =
            render_truth(world, *tracer, camera, indirect.runs() ? 1 + indirect.bounces : 1);
        const std::set<std::uint32_t> left_out = find_silhouettes(world, *tracer, camera);
        for (Image* image : {&truth.mean, &truth.variance}) clear(*image, left_out);
        std::vector<Runner> runners;
        for (const MotionMethod& method : methods) runners.emplace_back(world, *tracer, method);
        for (int seed = 0; seed < seeds; ++seed) {
            for (int frame = 0; frame <= LAST_FRAME; ++frame) {
                moving.pose(moving.scene, frame);
                update_world(world, moving.scene, 0.0);
                tracer->update(world);
                for (Runner& runner : runners)
                    runner.render(camera, std::uint32_t(seed) + 100u, frame, left_out);
            }
            const auto knows_enough = [&](const Runner& runner) { return runner.knows_enough(truth, power); };
            if (std::all_of(runners.begin(), runners.end(), knows_enough)) break;
        }
        std::vector<MotionResult> results;
        for (Runner& runner : runners) results.push_back(runner.finish(truth));
        return results;
    }

    // The reference's mean, in the picture and in every tile, by a test that could tell otherwise.
    static void expect_no_bias(const MovingScene& moving, const std::vector<MotionMethod>& methods,
                               int seeds = SEEDS, Power power = {}) {
        const std::vector<MotionResult> results = run(moving, methods, seeds, power);
        for (std::size_t i = 0; i < methods.size(); ++i) {
            EXPECT_TRUE(results[i].picture.passes) << methods[i].name;
            EXPECT_TRUE(results[i].tiles.passes) << methods[i].name;
            EXPECT_LE(results[i].picture.detectable_bias, power.in_picture) << methods[i].name;
            EXPECT_LE(results[i].tiles.detectable_bias, power.in_tile) << methods[i].name;
        }
    }

    // The same test fails on the method with a mistake planted in it, with half the seeds.
    static void expect_found(const MovingScene& moving, MotionMethod method, const std::string& planted,
                             int seeds = SEEDS / 2) {
        method.planted = {planted};
        method.name += ", " + planted;
        const std::vector<MotionResult> results = run(moving, {method}, seeds);
        EXPECT_FALSE(results[0].picture.passes && results[0].tiles.passes) << planted;
    }

    // Presets whose bias is bounded, not zero.
    static void expect_within_bounds(const MovingScene& moving) {
        std::vector<const Preset*> presets;
        std::vector<MotionMethod> methods;
        for (const Preset& preset : preset_table()) {
            // The reference is that of direct light.
            if (preset.energy_bound == 0.0 || preset.settings.indirect.runs()) continue;
            presets.push_back(&preset);
            methods.push_back({preset.name, [&preset](int) { return preset.settings; }});
        }
        const std::vector<MotionResult> results = run(moving, methods, SEEDS_OF_BOUNDS);
        for (std::size_t i = 0; i < presets.size(); ++i) {
            EXPECT_NEAR(results[i].energy, 1.0, presets[i]->energy_bound) << presets[i]->name;
        }
    }

  private:
    static TileReference render_truth(const World& world, const RayTracer& tracer, const CameraRecord& camera,
                                      int bounces) {
        ReferenceSettings settings;
        settings.width = WIDTH_PX;
        settings.height = HEIGHT_PX;
        settings.camera = camera;
        settings.bounces = bounces;
        settings.spp = bounces > 1 ? 1024 : 2048;  // indirect light is noisier on the other side
        settings.seed = 5;
        const ReferenceResult result = find_reference(world, tracer, settings);
        return {result.radiance, result.variance};
    }

    // Pixels in which the rasterizer and the reference's ray round to different triangles.
    static std::set<std::uint32_t> find_silhouettes(World& world, const RayTracer& tracer,
                                                    const CameraRecord& camera) {
        Renderer renderer(world, tracer, WIDTH_PX, HEIGHT_PX);
        const auto seen = renderer.render({camera, 0, 0, {}}).gbuffer.seen->download<glm::uvec2>();
        std::set<std::uint32_t> found;
        for (std::uint32_t pixel = 0; pixel < seen.size(); ++pixel) {
            const glm::vec2 centre(float(pixel % WIDTH_PX) + 0.5f, float(pixel / WIDTH_PX) + 0.5f);
            const PixelRay view = camera_ray(camera, centre, glm::vec2(WIDTH_PX, HEIGHT_PX));
            const RayRecord ray{view.origin, RAY_INFINITY, view.direction, pixel};
            const auto hit = tracer.trace_closest(ray, {0, 0, RAY_CAMERA}, BackFaces::PASS);
            if (seen[pixel] != (hit ? glm::uvec2(hit->instance, hit->primitive) : glm::uvec2(INVALID_INDEX)))
                found.insert(pixel);
        }
        EXPECT_LE(found.size(), seen.size() / 200);
        return found;
    }

    static void clear(Image& image, const std::set<std::uint32_t>& pixels) {
        for (const std::uint32_t pixel : pixels) {
            for (int c = 0; c < 3; ++c) image.values[3 * std::size_t(pixel) + std::size_t(c)] = 0.0f;
        }
    }

    class Runner {
      public:
        Runner(World& world, const RayTracer& tracer, const MotionMethod& method)
            : method_(method),
              renderer_(std::make_unique<Renderer>(world, tracer, WIDTH_PX, HEIGHT_PX, method.planted)) {}

        void render(const CameraRecord& camera, std::uint32_t seed, int frame,
                    const std::set<std::uint32_t>& left_out) {
            renderer_->update();
            if (frame == 0) renderer_->reset_history();
            const RenderSettings settings = method_.settings(frame);
            const bool looks_back = settings.direct.reuses() || settings.indirect.uses_restir();
            if (!looks_back && frame != LAST_FRAME && !method_.draws_all_frames) return;
            const FrameOutput output = renderer_->render({camera, std::uint32_t(frame), seed, settings});
            if (frame != LAST_FRAME) return;
            Image image = renderer_->read_radiance(output.radiance);
            clear(image, left_out);
            tiles_.add(image);
            picture_.add(image);
        }

        // Not before 16 seeds: the spread of fewer says little. It is known before the last one, and no look
        // at the mean decides, so that stopping favours no result.
        bool knows_enough(const TileReference& truth, const Power& power) const {
            constexpr int FEWEST = 16, LOOK_EVERY = 4;
            if (!method_.planted.empty()) {
                return stands_out(picture_, truth, SIGNIFICANCE) || stands_out(tiles_, truth, SIGNIFICANCE);
            }
            const int seeds = picture_.seed_count();
            if (std::getenv("TARN_TEST_SEEDS") != nullptr) return false;  // asks for more
            if (seeds < FEWEST || seeds % LOOK_EVERY != 0) return false;
            return picture_.test(truth, SIGNIFICANCE).detectable_bias <= power.in_picture &&
                   tiles_.test(truth, SIGNIFICANCE).detectable_bias <= power.in_tile;
        }

        MotionResult finish(const TileReference& truth) const {
            if (method_.planted.empty()) {
                for (const auto& [name, value] : renderer_->read_counters()) {
                    EXPECT_EQ(value, 0u) << method_.name << ": " << name;
                }
            }
            MotionResult result{picture_.test(truth, SIGNIFICANCE), tiles_.test(truth, SIGNIFICANCE)};
            result.energy = result.picture.mean / result.picture.reference_mean;
            fmt::print(
                "{}: energy {:.4f} +- {:.4f}, finds {:.2g} % ({:.0f} % of the variance the reference's); "
                "{}\n",
                method_.name, result.energy, result.picture.standard_error / result.picture.reference_mean,
                100.0 * result.picture.detectable_bias, 100.0 * result.picture.reference_share,
                describe(result.tiles));
            return result;
        }

      private:
        MotionMethod method_;
        std::unique_ptr<Renderer> renderer_;
        TileSamples tiles_{WIDTH_PX, HEIGHT_PX, TILE_PX};
        TileSamples picture_{WIDTH_PX, HEIGHT_PX, WIDTH_PX};
    };
};

// The preset `unbiased` with other weights, and with what else a case changes. Many candidates cost little
// here and leave less noise for a bias to hide in.
inline MotionMethod unbiased(const std::string& name, Mis mis = Mis::PAIRWISE,
                             const std::function<void(RenderSettings&)>& change = {}) {
    RenderSettings settings = find_preset("unbiased").settings;
    settings.direct.reuse.mis = mis;
    settings.direct.candidates = 64;
    settings.direct.reuse.motion_cap =
        settings.direct.reuse.confidence_cap;  // a long history shows its faults
    if (change) change(settings);
    return {name, [settings](int) { return settings; }};
}

inline std::vector<MotionMethod> unbiased_methods() {
    return {unbiased("pairwise", Mis::PAIRWISE), unbiased("balance", Mis::BALANCE)};
}

}  // namespace tarn::test
