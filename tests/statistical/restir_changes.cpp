// ReSTIR while things change. Lights: switched off, removed and added by the hundred, moved and dimmed every
// frame. The picture of the very next frame, and of 12 frames later, has the mean of the reference for the
// lights as they are now.
#include <gtest/gtest.h>

#include "platform/context.h"
#include "renderer/renderer.h"
#include "support/kept_reference.h"
#include "support/tile_test.h"
#include "support/toy_scenes.h"

namespace tarn {
namespace {

constexpr int WIDTH_PX = 64;
constexpr int HEIGHT_PX = 48;
constexpr int TILE_PX = 16;
constexpr int SEEDS = 136;       // of the next frame, which is the noisiest
constexpr int LATER_SEEDS = 24;  // that go on
constexpr double SIGNIFICANCE = 0.01;
constexpr int WARM_UP_FRAMES = 8;
constexpr int LATER_FRAMES = 12;

PunctualLight point_light(int index) {
    PunctualLight light;
    light.kind = LightKind::POINT;
    light.intensity = 0.5f * glm::vec3(1.0f + float(index % 3), 1.0f + float(index % 5), 2.0f);
    return light;
}

// A place over the floor for light `index`, on a spiral.
glm::dmat4 place_of(int index) {
    const double angle = 2.4 * index, radius = 0.35 * std::sqrt(double(index));
    const glm::dvec3 position(radius * std::cos(angle), 1.2 + 0.1 * (index % 7), radius * std::sin(angle));
    return glm::translate(glm::dmat4(1.0), position);
}

// A floor with a ball and a screen on it, under a wide lamp so that no part of the picture is dark, `count`
// point lights from the spiral's place `first` on, and one emissive quad.
class LightStage {
  public:
    LightStage() {
        toy_.add_quad(toy_.add_material(lambert_material(glm::vec3(0.7f))), {-6, 0, 6}, {12, 0, 0},
                      {0, 0, -12});
        toy_.add_quad(toy_.add_material(lambert_material(glm::vec3(0.4f, 0.6f, 0.8f))), {-0.4f, 0, 0},
                      {0.8f, 0, 0}, {0, 0.6f, 0});
        toy_.add_quad(toy_.add_material(emissive_material(glm::vec3(1.6f, 1.2f, 1.0f))), {-1.5f, 4, -1.5f},
                      {3, 0, 0}, {0, 0, 3});
        toy_.add_instance(
            toy_.add_mesh(toy_.add_material(lambert_material(glm::vec3(0.8f))), sphere_corners(0.5f, 10)),
            glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, 0.4, 0.5)));
        for (int i = 0; i < LIGHTS; ++i) toy_.add_light(point_light(i), place_of(i));
        all_nodes_ = toy_.scene.light_nodes;
        show(0, LIGHTS / 2);
        world_ = build_world(toy_.scene);
        tracer_ = create_embree_tracer(world_);
        camera_ = look_at(world_, {0.0, 2.6, 2.9}, {0.0, 0.0, 0.1}, 45.0, double(WIDTH_PX) / HEIGHT_PX);
    }

    // Lights `first` .. `first + count` are on, all others are not in the scene.
    void show(int first, int count) {
        toy_.scene.light_nodes.assign(all_nodes_.begin() + first, all_nodes_.begin() + first + count);
        ++toy_.scene.revision;
    }
    void dim(int light, float factor) {
        toy_.scene.lights[std::size_t(light)].intensity = point_light(light).intensity * factor;
        ++toy_.scene.revision;
    }
    void move_all(double shift_m) {
        for (int i = 0; i < LIGHTS; ++i) {
            at(toy_.scene.nodes, all_nodes_[std::size_t(i)]).matrix =
                place_of(i) * glm::translate(glm::dmat4(1.0), glm::dvec3(shift_m, 0.0, 0.0));
        }
        ++toy_.scene.revision;
    }
    void update() {
        update_world(world_, toy_.scene, 0.0);
        tracer_->update(world_);
    }

    // Light of so many bounces; 1: direct light.
    TileReference render_truth(int bounces) {
        ReferenceSettings settings;
        settings.width = WIDTH_PX;
        settings.height = HEIGHT_PX;
        settings.camera = camera_;
        settings.bounces = bounces;
        settings.spp = 2048;
        settings.seed = 5;
        const ReferenceResult result = test::find_reference(world_, *tracer_, settings);
        return {result.radiance, result.variance};
    }

    static constexpr int LIGHTS = 200;
    ToyScene toy_;
    std::vector<NodeIndex> all_nodes_;
    World world_;
    std::unique_ptr<RayTracer> tracer_;
    CameraRecord camera_{};
};

class RestirChanges : public testing::Test {
  protected:
    RestirChanges() : context_(create_context({})) {
        input_.settings = find_preset("unbiased").settings;
        input_.settings.direct.candidates = 64;  // less noise for a bias to hide in
        input_.camera = stage_.camera_;
    }

    // Runs `prepare`, a warm-up, `change`, and looks at the next frame and a later one, for each seed.
    template <class Prepare, class Change>
    void run(const Prepare& prepare, const Change& change, const std::vector<std::string>& planted = {}) {
        Renderer renderer(stage_.world_, *stage_.tracer_, WIDTH_PX, HEIGHT_PX, planted);
        TileSamples next(WIDTH_PX, HEIGHT_PX, TILE_PX), later(WIDTH_PX, HEIGHT_PX, TILE_PX);
        TileReference truth;
        for (int seed = 0; seed < (planted.empty() ? seeds_ : LATER_SEEDS); ++seed) {
            input_.seed = std::uint32_t(seed) + 500u;
            input_.frame = 0;
            prepare();
            stage_.update();
            renderer.update();
            renderer.reset_history();
            for (int i = 0; i < WARM_UP_FRAMES; ++i, ++input_.frame) renderer.render(input_);
            change();
            stage_.update();
            renderer.update();
            if (seed == 0) truth = stage_.render_truth(bounces());
            next.add(renderer.read_radiance(renderer.render(input_).radiance));
            if (!planted.empty() && stands_out(next, truth, SIGNIFICANCE)) break;
            if (!planted.empty() || seed >= later_seeds_) continue;
            ++input_.frame;
            for (int i = 1; i < LATER_FRAMES; ++i, ++input_.frame) renderer.render(input_);
            later.add(renderer.read_radiance(renderer.render(input_).radiance));
        }
        next_ = report("next frame", next.test(truth, SIGNIFICANCE));
        if (planted.empty()) {
            later_ = report("12 frames later", later.test(truth, SIGNIFICANCE));
            for (const auto& [name, value] : renderer.read_counters()) EXPECT_EQ(value, 0u) << name;
        }
    }

    // A camera that glides sideways into its place and arrives with the last frame.
    TileTest run_moving_camera(const std::vector<std::string>& planted = {}) {
        Renderer renderer(stage_.world_, *stage_.tracer_, WIDTH_PX, HEIGHT_PX, planted);
        TileSamples samples(WIDTH_PX, HEIGHT_PX, TILE_PX);
        for (int seed = 0; seed < 2 * LATER_SEEDS; ++seed) {
            input_.seed = std::uint32_t(seed) + 900u;
            renderer.reset_history();
            for (int left = WARM_UP_FRAMES; left >= 0; --left) {
                input_.frame = std::uint32_t(WARM_UP_FRAMES - left);
                input_.camera = stage_.camera_;
                input_.camera.position += glm::vec3(-0.07f, 0.03f, 0.0f) * float(left);
                const FrameOutput output = renderer.render(input_);
                if (left == 0) samples.add(renderer.read_radiance(output.radiance));
            }
        }
        return report("moving camera", samples.test(stage_.render_truth(bounces()), SIGNIFICANCE));
    }

    static TileTest report(const char* when, const TileTest& test) {
        fmt::print("{}: {}\n", when, describe(test));
        return test;
    }

    // Direct light without history: it would be the noisier part of the next frame.
    void use_indirect_light() {
        input_.settings.direct.mode = DirectMode::RIS;
        input_.settings.indirect.mode = IndirectMode::RESTIR;
        input_.settings.indirect.reuse.mis_visibility = true;
        input_.settings.indirect.reuse.radius_px = 10.0;
        seeds_ = 5 * LATER_SEEDS;
        later_seeds_ = 2 * LATER_SEEDS;
    }
    int bounces() const { return input_.settings.indirect.runs() ? 2 : 1; }

    // Twenty lamps that all but go out: what old path samples remember of them is far more than what is left.
    void run_dimming(const std::vector<std::string>& planted) {
        const auto dim_all = [&](float factor) {
            for (int i = 0; i < 20; ++i) stage_.dim(i, factor);
        };
        run(
            [&] {
                stage_.show(0, 20);
                dim_all(4.0f);
            },
            [&] { dim_all(0.05f); }, planted);
    }

    void expect_both_pass() const {
        EXPECT_TRUE(next_.passes);
        EXPECT_TRUE(later_.passes);
        EXPECT_LE(next_.detectable_bias, 0.03);
        EXPECT_LE(later_.detectable_bias, 0.03);
    }

    std::unique_ptr<Context> context_;
    LightStage stage_;
    FrameInput input_;
    int seeds_ = SEEDS;
    int later_seeds_ = LATER_SEEDS;
    TileTest next_;
    TileTest later_;
};

TEST_F(RestirChanges, OnesThatAreSwitchedOffDarkenTheNextFrame) {
    run([&] { stage_.show(0, 20); }, [&] { stage_.show(10, 10); });
    expect_both_pass();
}

TEST_F(RestirChanges, AHundredRemovedAndAHundredAddedInOneFrameLeaveNoTrace) {
    run([&] { stage_.show(0, 100); }, [&] { stage_.show(100, 100); });
    expect_both_pass();
}

TEST_F(RestirChanges, OnesThatStayKeepTheirSamplesWhateverTheirIndex) {
    run([&] { stage_.show(0, 100); }, [&] { stage_.show(50, 100); });
    expect_both_pass();
}

TEST_F(RestirChanges, OnesThatMoveAndDimInOneFrameAreFollowed) {
    run(
        [&] {
            stage_.show(0, 100);
            stage_.move_all(0.0);
            for (int i = 0; i < 100; ++i) stage_.dim(i, 1.0f);
        },
        [&] {
            stage_.move_all(0.5);
            for (int i = 0; i < 100; i += 2) stage_.dim(i, 0.125f);
        });
    expect_both_pass();
}

// On the way to the present alone: to take index for identity both ways is a shift as good as any other, only
// noisier.
TEST_F(RestirChanges, NegativeControlIndicesTakenForIdentitiesAreFound) {
    run([&] { stage_.show(0, 100); }, [&] { stage_.show(50, 100); }, {"TARN_PLANT_NO_REMAP"});
    EXPECT_FALSE(next_.passes);
}

TEST_F(RestirChanges, IndirectLightOfLampsThatGoOutIsGoneInTheNextFrame) {
    use_indirect_light();
    run_dimming({});
    expect_both_pass();
}

TEST_F(RestirChanges, NegativeControlIndirectLightThatIsRememberedIsFound) {
    use_indirect_light();
    run_dimming({"TARN_PLANT_STALE_LIGHT"});
    EXPECT_FALSE(next_.passes);
}

TEST_F(RestirChanges, AMovingCameraFindsTheSameLight) {
    EXPECT_TRUE(run_moving_camera().passes);
}

TEST_F(RestirChanges, NegativeControlThePreviousNormalIsFoundUnderAMovingCamera) {
    EXPECT_FALSE(run_moving_camera({"TARN_PLANT_PREVIOUS_NORMAL"}).passes);
}

}  // namespace
}  // namespace tarn
