// What reuse does to numbers over many frames: lights of extreme intensity in the history, a history that
// went bad, samples that never die.
#include <gtest/gtest.h>

#include <cmath>

#include "core/statistics.h"
#include "support/on_context.h"
#include "support/toy_render.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 72;
constexpr int HEIGHT_PX = 48;

class RestirHazards : public OnContext<> {};

// A floor with a wall on it and a lamp over it.
ToyScene make_lamp_stage(float intensity) {
    ToyScene toy;
    toy.add_quad(toy.add_material(lambert_material(glm::vec3(0.5f))), {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
    toy.add_quad(toy.add_material(lambert_material(glm::vec3(0.7f, 0.4f, 0.3f))), {-0.5f, 0, 0.5f}, {1, 0, 0},
                 {0, 1, 0});
    const glm::vec3 radiance = glm::vec3(3.0f, 2.0f, 1.0f) * intensity;
    toy.add_quad(toy.add_material(emissive_material(radiance)), {-1, 2.5f, -1}, {1, 0, 0}, {0, 0, 1});
    return toy;
}

// And a point light beside it.
Scene make_stage(float intensity) {
    ToyScene toy = make_lamp_stage(intensity);
    PunctualLight point;
    point.intensity = glm::vec3(intensity);
    toy.add_light(point, glm::translate(glm::dmat4(1.0), glm::dvec3(1.5, 1.0, 1.0)));
    return toy.scene;
}

CameraRecord look_at_stage(const ToyRender& render) {
    return render.look({0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 50.0);
}

// Light is linear in intensity, and so is all that reservoirs carry from frame to frame: a power of two comes
// out as it went in, bit for bit, unless a floor or an epsilon stands in its way (hazards of weights that
// under- or overflow). 2^-27 is 7.5e-9, 2^27 is 1.3e8.
TEST_F(RestirHazards, HistoriesAreLinearInIntensityOverSixteenDecades) {
    constexpr int FRAMES = 8;
    for (const Preset& preset : preset_table()) {
        const auto picture = [&](float intensity) {
            ToyRender render(make_stage(intensity), WIDTH_PX, HEIGHT_PX);
            render.settings = preset.settings;
            return render.render(look_at_stage(render), DirectMode::RESTIR, FRAMES);
        };
        const Image one = picture(1.0f);
        EXPECT_GT(mean_of(one), 0.01);
        for (const float intensity : {0x1p-27f, 0x1p27f}) {
            EXPECT_EQ(count_off_scale(one, picture(intensity), intensity), 0u)
                << preset.name << " " << intensity;
        }
    }
}

// A history that holds NaN, however it came there, is dropped where it is read, counted, and gone.
TEST_F(RestirHazards, AHistoryThatIsNoNumberIsDroppedAndCounted) {
    constexpr int FRAMES = 12;
    World world = build_world(make_stage(1.0f));
    const auto tracer = create_embree_tracer(world);
    const auto run = [&](const std::vector<std::string>& planted, std::uint64_t& bad) {
        Renderer renderer(world, *tracer, WIDTH_PX, HEIGHT_PX, planted);
        FrameInput input;
        input.camera = look_at(world, {0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 50.0, double(WIDTH_PX) / HEIGHT_PX);
        input.settings = find_preset("unbiased").settings;
        double sum = 0.0;
        for (int frame = 0; frame < FRAMES; ++frame) {
            input.frame = std::uint32_t(frame);
            const Image image = renderer.read_radiance(renderer.render(input).radiance);
            for (const float value : image.values) EXPECT_TRUE(std::isfinite(value));
            sum += mean_of(image);
        }
        bad = renderer.read_counters().at("bad_history");
        return sum / FRAMES;
    };
    std::uint64_t healthy_count = 0, planted_count = 0;
    const double healthy = run({}, healthy_count);
    const double planted = run({"TARN_PLANT_NAN_HISTORY"}, planted_count);
    EXPECT_EQ(healthy_count, 0u);
    EXPECT_GT(planted_count, std::uint64_t(WIDTH_PX * HEIGHT_PX / 16));
    EXPECT_NEAR(planted, healthy, 0.05 * healthy);
}

// Share of the lit pixels that show the same sample in both.
double share_of_same_samples(const Image& before, const Image& after) {
    std::size_t kept = 0, shown = 0;
    for (int y = 0; y < HEIGHT_PX; ++y) {
        for (int x = 0; x < WIDTH_PX; ++x) {
            const float *a = before.pixel(x, y), *b = after.pixel(x, y);
            if (a[0] == 0.0f) continue;
            kept += std::equal(a, a + 3, b);
            ++shown;
        }
    }
    return double(kept) / double(shown);
}

// That share for two frames so far apart, the camera being still.
double share_of_kept_samples(int age_cap, int frames_apart, double confidence_cap = 1000.0) {
    constexpr int WARM_UP = 24;
    ToyRender render(make_lamp_stage(1.0f).scene, WIDTH_PX, HEIGHT_PX);
    render.settings.direct.reuse.reuse = Reuse::TEMPORAL;
    render.settings.direct.reuse.mis = Mis::ONE_OVER_M;
    render.settings.direct.candidates = 128;  // weights that are next to alike
    render.settings.direct.reuse.confidence_cap = confidence_cap;
    render.settings.direct.reuse.age_cap = age_cap;
    render.settings.direct.debug_view = DebugView::SAMPLES;
    const CameraRecord camera = look_at_stage(render);
    render.render(camera, DirectMode::RESTIR, WARM_UP);
    const Image before = render.render(camera, DirectMode::RESTIR, 1, WARM_UP);
    render.render(camera, DirectMode::RESTIR, frames_apart - 1, WARM_UP + 1);
    const Image after = render.render(camera, DirectMode::RESTIR, 1, WARM_UP + frames_apart);
    return share_of_same_samples(before, after);
}

// Places on a lamp never repeat: who shows the same one again has kept it.
TEST_F(RestirHazards, SamplesOlderThanTheCapAreGone) {
    EXPECT_EQ(share_of_kept_samples(6, 8), 0.0);
    EXPECT_GT(share_of_kept_samples(6, 2), 0.3);
    EXPECT_GT(share_of_kept_samples(0, 8), 0.3);
}

// A past that counts four times as much as the fresh sample is kept four times in five, however old it is;
// one that counts for all frames since the first, 24 times in 25.
TEST_F(RestirHazards, TheCapOnConfidenceDecidesHowOftenSamplesAreReplaced) {
    EXPECT_NEAR(share_of_kept_samples(0, 1, 4.0), 4.0 / 5.0, 0.03);
    EXPECT_NEAR(share_of_kept_samples(0, 1, 1000.0), 24.0 / 25.0, 0.02);
}

// In frames in which the camera moved, be it by a hair, a long past counts as much as the motion cap says.
TEST_F(RestirHazards, AMovingCameraShortensThePast) {
    constexpr int FRAMES = 12;
    ToyRender render(make_lamp_stage(1.0f).scene, WIDTH_PX, HEIGHT_PX);
    render.settings.direct.reuse.reuse = Reuse::TEMPORAL;
    render.settings.direct.reuse.mis = Mis::ONE_OVER_M;
    render.settings.direct.candidates = 128;
    render.settings.direct.reuse.motion_cap = 4.0;
    render.settings.direct.reuse.confidence_cap = 1000.0;
    render.settings.direct.debug_view = DebugView::SAMPLES;
    CameraRecord camera = look_at_stage(render);
    Image before, after;
    for (int frame = 0; frame < FRAMES; ++frame) {
        camera.position.x += 1e-6f;
        before = std::move(after);
        after = render.render(camera, DirectMode::RESTIR, 1, frame);
    }
    EXPECT_NEAR(share_of_same_samples(before, after), 4.0 / 5.0, 0.03);
}

// Hundreds of frames in which a point light circles: no counter moves, and the energy of the last frames is
// that of the first.
TEST_F(RestirHazards, ManyFramesLeaveNoTraceInCountersOrEnergy) {
    constexpr int TURNS = 5, FRAMES_A_TURN = 80;
    Scene scene = make_stage(1.0f);
    World world = build_world(scene);
    const auto tracer = create_embree_tracer(world);
    Renderer renderer(world, *tracer, WIDTH_PX, HEIGHT_PX);
    FrameInput input;
    input.camera = look_at(world, {0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 50.0, double(WIDTH_PX) / HEIGHT_PX);
    input.settings = find_preset("unbiased").settings;
    RunningMoments energy[TURNS];
    for (int frame = 0; frame < TURNS * FRAMES_A_TURN; ++frame) {
        const double angle = 2.0 * 3.14159265 * frame / FRAMES_A_TURN;
        const glm::dvec3 place(1.5 * std::cos(angle), 1.0, 1.5 * std::sin(angle));
        at(scene.nodes, scene.light_nodes[0]).matrix = glm::translate(glm::dmat4(1.0), place);
        ++scene.revision;
        update_world(world, scene, 0.0);
        tracer->update(world);
        renderer.update();
        input.frame = std::uint32_t(frame);
        energy[frame / FRAMES_A_TURN].add(mean_of(renderer.read_radiance(renderer.render(input).radiance)));
    }
    for (const auto& [name, value] : renderer.read_counters()) EXPECT_EQ(value, 0u) << name;
    EXPECT_NEAR(energy[TURNS - 1].mean() / energy[1].mean(), 1.0, 0.01);
}

// A black mirror on the ground with a lamp over it, which the camera sees in the mirror alone: the mean of
// some frames.
double mirrored_light(Reuse reuse, Mis mis, const std::vector<std::string>& planted = {}) {
    constexpr int FRAMES = 16;
    ToyScene toy;
    Material mirror = lambert_material(glm::vec3(0.0f));
    mirror.specular = 1.0f;
    mirror.roughness = 0.04f;
    toy.add_quad(toy.add_material(mirror), {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
    toy.add_quad(toy.add_material(emissive_material(glm::vec3(3.0f, 2.0f, 1.0f))), {-0.5f, 3.0f, -3.0f},
                 {1, 0, 0}, {0, 0, 1});
    ToyRender render(toy.scene, WIDTH_PX, HEIGHT_PX, {}, planted);
    render.settings = find_preset("unbiased").settings;
    render.settings.direct.reuse.reuse = reuse;
    render.settings.direct.reuse.mis = mis;
    return mean_of(render.render(look_at_stage(render), DirectMode::RESTIR, FRAMES));
}

// To the neighbours of a mirror's pixel its light is next to impossible to draw, and yet not impossible.
TEST_F(RestirHazards, MirrorsKeepTheirEnergyAmongNeighbours) {
    const double alone = mirrored_light(Reuse::NONE, Mis::PAIRWISE);
    EXPECT_GT(alone, 1e-4);
    for (const Mis mis : {Mis::ONE_OVER_Z, Mis::BALANCE, Mis::PAIRWISE})
        EXPECT_NEAR(mirrored_light(Reuse::SPATIAL, mis) / alone, 1.0, 0.02) << int(mis);
    // Counted all the same, the energy hangs on samples that a run meets too seldom or, by chance, too often.
    const double counted = mirrored_light(Reuse::SPATIAL, Mis::ONE_OVER_Z, {"TARN_PLANT_COUNT_MIRRORS"});
    EXPECT_GT(std::abs(counted / alone - 1.0), 0.1);
}

}  // namespace
}  // namespace tarn::test
