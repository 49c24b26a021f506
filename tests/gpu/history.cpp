// What a frame may know of the one before: where things were, and reservoirs that the frame before wrote by
// the same rules; nothing older, and nothing of another kind.
#include <gtest/gtest.h>

#include <cstring>

#include "rays/ray_tracer.h"
#include "renderer/renderer.h"
#include "shared/math/random.h"
#include "support/moving_scenes.h"
#include "support/on_context.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 64;
constexpr int HEIGHT_PX = 48;

// A moving scene with two renderers: one that has drawn the frames before, and one that has not.
class Stage {
  public:
    explicit Stage(MovingScene moving)
        : moving_(std::move(moving)),
          world_(build_world(moving_.scene)),
          tracer_(create_embree_tracer(world_)),
          camera_(look_at(world_, moving_.camera_ws, moving_.target_ws, 45.0, double(WIDTH_PX) / HEIGHT_PX)),
          experienced_(world_, *tracer_, WIDTH_PX, HEIGHT_PX),
          fresh_(world_, *tracer_, WIDTH_PX, HEIGHT_PX) {}

    void move_to(int frame) {
        moving_.pose(moving_.scene, frame);
        update_world(world_, moving_.scene, 0.0);
        tracer_->update(world_);
        experienced_.update();
        fresh_.update();
    }

    Image render(int frame, const RenderSettings& settings) { return draw(experienced_, frame, settings); }
    Image render_fresh(int frame, const RenderSettings& settings) { return draw(fresh_, frame, settings); }

    // Frames from `first` up to `last`, all moving.
    void render_frames(int first, int last, const RenderSettings& settings) {
        for (int frame = first; frame <= last; ++frame) {
            move_to(frame);
            render(frame, settings);
        }
    }

    MovingScene moving_;
    World world_;
    std::unique_ptr<RayTracer> tracer_;
    CameraRecord camera_;

  private:
    Image draw(Renderer& renderer, int frame, const RenderSettings& settings) const {
        return renderer.read_radiance(renderer.render({camera_, std::uint32_t(frame), 7, settings}).radiance);
    }

    Renderer experienced_;
    Renderer fresh_;
};

bool are_same_bits(const Image& a, const Image& b) {
    return a.values.size() == b.values.size() &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0;
}

RenderSettings settings_of(const char* preset) {
    return find_preset(preset).settings;
}

class History : public OnContext<> {};

// Without this the others would pass in a renderer that never looks back.
TEST_F(History, AFrameThatFollowsLooksBack) {
    for (const char* preset : {"fast", "balanced", "unbiased", "student"}) {
        Stage stage(make_moving_things(0.02, lambert_material(glm::vec3(0.5f))));
        stage.render_frames(0, 4, settings_of(preset));
        stage.move_to(5);
        EXPECT_FALSE(
            are_same_bits(stage.render(5, settings_of(preset)), stage.render_fresh(5, settings_of(preset))))
            << preset;
    }
}

TEST_F(History, AGapOfFramesLeavesNoPast) {
    for (const char* preset : {"fast", "unbiased"}) {
        Stage stage(make_moving_things(0.02, lambert_material(glm::vec3(0.5f))));
        stage.render_frames(0, 3, settings_of(preset));
        stage.move_to(6);
        EXPECT_TRUE(
            are_same_bits(stage.render(6, settings_of(preset)), stage.render_fresh(6, settings_of(preset))))
            << preset;
    }
}

TEST_F(History, ReservoirsDoNotOutliveFramesOfAnotherMethod) {
    RenderSettings other = settings_of("unbiased");
    other.direct.mode = DirectMode::RIS;
    for (const char* preset : {"fast", "unbiased"}) {
        for (const int pause : {1, 2, 5}) {
            Stage stage(make_moving_things(0.02, lambert_material(glm::vec3(0.5f))));
            stage.render_frames(0, 3, settings_of(preset));
            stage.render_frames(4, 3 + pause, other);
            stage.move_to(4 + pause);
            EXPECT_TRUE(are_same_bits(stage.render(4 + pause, settings_of(preset)),
                                      stage.render_fresh(4 + pause, settings_of(preset))))
                << preset << " after " << pause << " frames of ris";
        }
    }
}

// A reservoir that was weighed by other rules has another density.
TEST_F(History, ReservoirsOfAnotherMeaningAreNoPast) {
    RenderSettings per_channel = settings_of("unbiased");
    per_channel.direct.per_channel = true;
    const std::vector<std::pair<RenderSettings, RenderSettings>> switches = {
        {settings_of("balanced"), settings_of("unbiased")},
        {settings_of("student"), settings_of("balanced")},
        {settings_of("unbiased"), settings_of("fast")},
        {settings_of("unbiased"), per_channel},
        {per_channel, settings_of("unbiased")},
    };
    for (std::size_t i = 0; i < switches.size(); ++i) {
        const auto& [before, after] = switches[i];
        Stage stage(make_moving_things(0.02, lambert_material(glm::vec3(0.5f))));
        stage.render_frames(0, 3, before);
        stage.move_to(4);
        EXPECT_TRUE(are_same_bits(stage.render(4, after), stage.render_fresh(4, after))) << "switch " << i;
    }
}

// The weights of the fresh and of the past sample sum to 1 where lamps grow, fade, move and deform; a
// Jacobian that is left out shows.
TEST_F(History, WeightsOverTimeSumToOne) {
    const auto count_wrong_sums = [](const MovingScene& moving, Mis mis, const std::string& planted) {
        Stage stage(moving);
        Renderer renderer(stage.world_, *stage.tracer_, WIDTH_PX, HEIGHT_PX, {"TARN_CHECK_MIS", planted});
        RenderSettings settings = settings_of("unbiased");
        settings.direct.reuse.mis = mis;
        for (int frame = 0; frame < 5; ++frame) {
            stage.move_to(frame);
            const glm::mat3 turn(glm::rotate(glm::dmat4(1.0), 0.05, glm::dvec3(0, 1, 0)));
            stage.camera_.right = turn * stage.camera_.right;
            stage.camera_.up = turn * stage.camera_.up;
            stage.camera_.forward = turn * stage.camera_.forward;
            renderer.update();
            renderer.render({stage.camera_, std::uint32_t(frame), 7, settings});
        }
        return renderer.read_counters().at("mis_sums");
    };
    for (const MovingScene& moving :
         {make_fading_veils(), make_deforming_things(), make_textured_lamps(), make_lamp_that_is_lit(),
          make_moving_things(0.02, glossy_material(glm::vec3(0.1f), 0.2f))}) {
        EXPECT_EQ(count_wrong_sums(moving, Mis::PAIRWISE, "TARN_PLANT_NOTHING"), 0u);
    }
    for (const Mis mis : {Mis::BALANCE, Mis::PAIRWISE}) {
        EXPECT_EQ(count_wrong_sums(make_breathing_lamp(0.1), mis, "TARN_PLANT_NOTHING"), 0u);
    }
    for (const char* planted : {"TARN_PLANT_DROP_FRESH_JACOBIAN", "TARN_PLANT_DROP_PREVIOUS_JACOBIAN"}) {
        EXPECT_GT(count_wrong_sums(make_breathing_lamp(0.1), Mis::PAIRWISE, planted), 100u) << planted;
    }
}

RenderSettings indirect_settings(IndirectResolution resolution) {
    RenderSettings settings;
    settings.direct.mode = DirectMode::RIS;
    settings.indirect.mode = IndirectMode::RESTIR;
    settings.indirect.resolution = resolution;
    settings.indirect.lights = PathLights::POWER;  // a light tree that was fitted anew keeps its old shape
    return settings;
}

TEST_F(History, PathSamplesOfAnotherResolutionAreNoPast) {
    using enum IndirectResolution;
    for (const IndirectResolution before : {FULL, HALF, QUARTER}) {
        for (const IndirectResolution now : {FULL, HALF, QUARTER}) {
            Stage stage(make_moving_things(0.02, lambert_material(glm::vec3(0.5f))));
            stage.render_frames(0, 2, indirect_settings(before));
            stage.move_to(3);
            EXPECT_EQ(are_same_bits(stage.render(3, indirect_settings(now)),
                                    stage.render_fresh(3, indirect_settings(now))),
                      before != now)
                << int(before) << " to " << int(now);
        }
    }
}

// The tracer keeps the geometry of one moment before the present. Modes that would ask for an older one start
// anew.
TEST_F(History, GeometryThatTheTracerHasForgottenIsNoPast) {
    Stage stage(make_moving_things(0.02, lambert_material(glm::vec3(0.5f))));
    stage.render_frames(0, 3, settings_of("unbiased"));
    stage.move_to(4);
    stage.move_to(5);
    EXPECT_TRUE(are_same_bits(stage.render(4, settings_of("unbiased")),
                              stage.render_fresh(4, settings_of("unbiased"))));
}

// Where the surface of each pixel was, found from a copy of the world as it was. Three frames, since what a
// frame leaves behind for the next shows in the second.
TEST_F(History, TheGBufferSaysWhereSurfacesWere) {
    for (const MovingScene& moving :
         {make_moving_things(0.05, lambert_material(glm::vec3(0.5f))), make_deforming_things()}) {
        Stage stage(moving);
        Renderer renderer(stage.world_, *stage.tracer_, WIDTH_PX, HEIGHT_PX);
        for (int frame = 0; frame < 4; ++frame) {
            const World before = stage.world_;
            stage.move_to(frame);
            renderer.update();
            const GBuffer gbuffer = renderer.render({stage.camera_, std::uint32_t(frame), 7, {}}).gbuffer;
            if (frame == 0) continue;  // nothing was drawn before
            const auto seen = gbuffer.seen->download<glm::uvec2>();
            const auto motion = gbuffer.surfaces->download(LAYER_MOTION);
            const auto position = gbuffer.surfaces->download(LAYER_POSITION);
            int moved = 0;
            for (std::uint32_t pixel = 0; pixel < seen.size(); ++pixel) {
                if (seen[pixel].x == INVALID_INDEX) continue;
                const glm::vec2 centre(float(pixel % WIDTH_PX) + 0.5f, float(pixel / WIDTH_PX) + 0.5f);
                const PixelRay view = camera_ray(stage.camera_, centre, glm::vec2(WIDTH_PX, HEIGHT_PX));
                const RayRecord ray{view.origin, RAY_INFINITY, view.direction, pixel};
                const auto hit = stage.tracer_->trace_closest(ray, {}, BackFaces::PASS);
                if (!hit || glm::uvec2(hit->instance, hit->primitive) != seen[pixel]) continue;
                const WorldInstance& instance = before.instances[hit->instance];
                const WorldMesh& mesh = before.meshes[instance.mesh];
                const glm::uvec3 corners = before.triangles[mesh.first_triangle + hit->primitive];
                const auto corner = [&](int i) {
                    return row_xyz(before.vertex_rows[(mesh.first_vertex + corners[i]) * VERTEX_ROWS]);
                };
                const glm::vec3 position_os = corner(0) * (1.0f - hit->barycentrics.x - hit->barycentrics.y) +
                                              corner(1) * hit->barycentrics.x +
                                              corner(2) * hit->barycentrics.y;
                const glm::vec3 was(instance.world_from_object * glm::vec4(position_os, 1.0f));
                EXPECT_LT(glm::length(glm::vec3(motion[pixel]) - was), 1e-4f) << "frame " << frame;
                moved += glm::length(was - glm::vec3(position[pixel])) > 0.005f;
            }
            EXPECT_GT(moved, 50) << "frame " << frame;
        }
    }
}

}  // namespace
}  // namespace tarn::test
