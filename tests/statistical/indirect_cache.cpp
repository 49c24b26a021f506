// Light of many bounces out of a cache: its energy against a closed form and the reference, over many frames;
// its lag; what it lets through a thin wall; its bounds. Mistakes are planted and found.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/log.h"
#include "core/statistics.h"
#include "reference/reference.h"
#include "renderer/renderer.h"
#include "support/on_context.h"
#include "support/toy_render.h"
#include "support/toy_scenes.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 48;
constexpr int HEIGHT_PX = 32;
constexpr float ALBEDO = 0.8f;
constexpr double ROOM_M = 2.0;
constexpr int ALL_BOUNCES = 60;  // 0.8^60 of the light is left out

using Planted = std::vector<std::string>;

// The inside of a cube from -1 to 1.
void add_walls(ToyScene& toy, const Material& material) {
    const MaterialIndex wall = toy.add_material(material);
    const float s = float(ROOM_M);
    toy.add_quad(wall, {-1, -1, 1}, {s, 0, 0}, {0, 0, -s});  // floor
    toy.add_quad(wall, {-1, 1, -1}, {s, 0, 0}, {0, 0, s});   // ceiling
    toy.add_quad(wall, {-1, -1, -1}, {s, 0, 0}, {0, s, 0});  // back
    toy.add_quad(wall, {1, -1, 1}, {-s, 0, 0}, {0, s, 0});   // front
    toy.add_quad(wall, {-1, -1, 1}, {0, 0, -s}, {0, s, 0});  // left
    toy.add_quad(wall, {1, -1, -1}, {0, 0, s}, {0, s, 0});   // right
}

// One lamp under the ceiling.
Scene make_room() {
    ToyScene toy;
    add_walls(toy, lambert_material(glm::vec3(ALBEDO)));
    const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(10.0f)));
    toy.add_quad(lamp, {-0.3f, 0.95f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f});
    return std::move(toy.scene);
}

// All walls emit: their radiance is the same everywhere, emission / (1 - albedo).
constexpr float WALL_EMISSION = 0.25f;

Scene make_furnace() {
    ToyScene toy;
    Material wall = lambert_material(glm::vec3(ALBEDO));
    wall.emission = glm::vec3(WALL_EMISSION);
    add_walls(toy, wall);
    return std::move(toy.scene);
}

RenderSettings make_settings(IndirectCache cache, IndirectMode mode = IndirectMode::PATH) {
    RenderSettings settings;
    settings.direct.mode = DirectMode::RIS;
    settings.direct.candidates = 16;
    settings.indirect.mode = mode;
    settings.indirect.cache = cache;
    return settings;
}

double mean_of_values(const Image& image) {
    double sum = 0.0;
    for (const float value : image.values) sum += value;
    return sum / double(image.values.size());
}

// A scene, its renderer, and one frame after the other.
class CachedRoom {
  public:
    CachedRoom(Scene scene, const RenderSettings& settings, Planted planted = {})
        : scene_(std::move(scene)),
          world_(build_world(scene_)),
          tracer_(create_embree_tracer(world_)),
          renderer_(world_, *tracer_, WIDTH_PX, HEIGHT_PX, std::move(planted)) {
        set_quiet(true);
        input_.settings = settings;
        input_.camera =
            look_at(world_, {0.0, 0.0, 0.9}, {0.2, -0.2, -1.0}, 75.0, double(WIDTH_PX) / HEIGHT_PX);
    }

    void restart(std::uint32_t seed) {
        renderer_.reset_history();
        input_.seed = seed;
        input_.frame = 0;
    }

    Image render() {
        const Image image = renderer_.read_radiance(renderer_.render(input_).radiance);
        ++input_.frame;
        return image;
    }

    double render_mean() { return mean_of_values(render()); }

    Image render_reference() const {
        ReferenceSettings settings;
        settings.width = WIDTH_PX;
        settings.height = HEIGHT_PX;
        settings.camera = input_.camera;
        settings.bounces = ALL_BOUNCES;
        settings.spp = 256;
        settings.seed = 11;
        return tarn::render_reference(world_, *tracer_, settings).radiance;
    }

    void look_from(const glm::dvec3& position, const glm::dvec3& target) {
        input_.camera = look_at(world_, position, target, 60.0, double(WIDTH_PX) / HEIGHT_PX);
    }

    void edit(const std::function<void(Scene&)>& change) {
        change(scene_);
        ++scene_.revision;
        update_world(world_, scene_, -1.0);
        tracer_->update(world_);
        renderer_.update();
    }

    std::map<std::string, std::uint64_t> counters() const { return renderer_.read_counters(); }

  private:
    Scene scene_;
    World world_;
    std::unique_ptr<RayTracer> tracer_;
    Renderer renderer_;
    FrameInput input_;
};

class IndirectCacheTest : public OnContext<> {};

// ---- Energy

constexpr int WARM_UP = 160;  // of a closed white room, the slowest there is
constexpr int FRAMES = 192;

// The deep form takes minutes: more frames for drifts that are slower, more seeds for smaller ones.
bool is_deep() {
    return std::getenv("TARN_TEST_DEEP") != nullptr;
}

int frame_count() {
    return is_deep() ? 1000 : FRAMES;
}

int seed_count() {
    return is_deep() ? 12 : 4;
}

struct Energy {
    RunningMoments ratio;  // over the expected mean, a seed each
    RunningMoments drift;  // of the last quarter of the frames over the one before
};

Energy measure_energy(CachedRoom& room, double expected, int frames = frame_count()) {
    Energy energy;
    for (int seed = 0; seed < seed_count(); ++seed) {
        room.restart(std::uint32_t(seed) + 100u);
        double all = 0.0, third = 0.0, fourth = 0.0;
        for (int frame = 0; frame < WARM_UP + frames; ++frame) {
            const double mean = room.render_mean();
            if (frame < WARM_UP) continue;
            all += mean;
            const int quarter = 4 * (frame - WARM_UP) / frames;
            third += quarter == 2 ? mean : 0.0;
            fourth += quarter == 3 ? mean : 0.0;
        }
        energy.ratio.add(all / frames / expected);
        energy.drift.add(fourth / third - 1.0);
    }
    return energy;
}

double standard_error(const RunningMoments& m) {
    return std::sqrt(m.variance_of_mean());
}

void print(const std::string& what, const Energy& e) {
    fmt::print("{}: {:.4f} of the energy, standard error {:.4f}; drift {:.5f}, standard error {:.5f}\n", what,
               e.ratio.mean(), standard_error(e.ratio), e.drift.mean(), standard_error(e.drift));
}

constexpr double FURNACE_RADIANCE = double(WALL_EMISSION) / (1.0 - double(ALBEDO));
// Stated in docs/indirect.md.
constexpr double WORLD_BIAS = 0.03;

// At 1 %, both sides.
void expect_no_drift(const Energy& e, const std::string& what) {
    const double t = student_t_quantile(0.995, double(seed_count() - 1));
    EXPECT_LE(std::abs(e.drift.mean()), t * standard_error(e.drift)) << what;
}

void expect_energy(const Energy& e, double bias, const std::string& what) {
    EXPECT_NEAR(e.ratio.mean(), 1.0, bias) << what;
    EXPECT_LE(standard_error(e.ratio), bias / 3.0) << what;
    expect_no_drift(e, what);
    EXPECT_LE(standard_error(e.drift), 0.005) << what;
}

TEST_F(IndirectCacheTest, AFurnaceReachesItsClosedFormAndStaysThere) {
    for (const IndirectMode mode : {IndirectMode::PATH, IndirectMode::RESTIR}) {
        CachedRoom room(make_furnace(), make_settings(IndirectCache::WORLD, mode));
        const Energy energy = measure_energy(room, FURNACE_RADIANCE);
        const std::string what = fmt::format("furnace, world, mode {}", int(mode));
        print(what, energy);
        expect_energy(energy, WORLD_BIAS, what);
        for (const auto& [name, value] : room.counters()) EXPECT_EQ(value, 0u) << name;
    }
}

TEST_F(IndirectCacheTest, AWhiteRoomHasTheReferencesEnergyAndDoesNotDrift) {
    CachedRoom room(make_room(), make_settings(IndirectCache::WORLD));
    const Energy energy = measure_energy(room, mean_of_values(room.render_reference()));
    print("room, world", energy);
    expect_energy(energy, WORLD_BIAS, "room, world");
    for (const auto& [name, value] : room.counters()) EXPECT_EQ(value, 0u) << name;
}

// What is out of view has one bounce: the picture is darker, but never brighter.
TEST_F(IndirectCacheTest, WhatWasInViewGivesPartOfTheLightAndDoesNotDrift) {
    CachedRoom room(make_room(), make_settings(IndirectCache::OFF));
    const double expected = mean_of_values(room.render_reference());
    const Energy without = measure_energy(room, expected, 32);
    print("room, off", without);
    CachedRoom cached(make_room(), make_settings(IndirectCache::SCREEN));
    const Energy energy = measure_energy(cached, expected);
    print("room, screen", energy);
    EXPECT_GT(energy.ratio.mean(), without.ratio.mean() + 0.05);
    EXPECT_LE(energy.ratio.mean(), 1.0 + 3.0 * standard_error(energy.ratio));
    expect_no_drift(energy, "room, screen");
}

TEST_F(IndirectCacheTest, EmissionThatCountsTwiceAndAlbedoThatCountsTwiceAreFound) {
    for (const char* bug : {"TARN_PLANT_COUNT_EMISSION", "TARN_PLANT_ALBEDO_TWICE"}) {
        CachedRoom room(make_furnace(), make_settings(IndirectCache::WORLD), {bug});
        const Energy energy = measure_energy(room, FURNACE_RADIANCE, 32);
        print(bug, energy);
        EXPECT_GT(std::abs(energy.ratio.mean() - 1.0), WORLD_BIAS + 3.0 * standard_error(energy.ratio))
            << bug;
    }
}

// ---- Lag

// Frames after the lamp went out until a tenth of the light is left; -1: not within the limit.
int find_lag(const Planted& planted, int limit) {
    CachedRoom room(make_room(), make_settings(IndirectCache::WORLD), planted);
    room.restart(3);
    double before = 0.0;
    for (int frame = 0; frame < 64; ++frame) before = room.render_mean();
    room.edit([](Scene& scene) { scene.materials.back().emission = glm::vec3(0.0f); });
    for (int frame = 0; frame < limit; ++frame) {
        if (room.render_mean() < 0.1 * before) return frame;
    }
    return -1;
}

constexpr int LAG_LIMIT = 96;

TEST_F(IndirectCacheTest, ALampThatGoesOutIsForgotten) {
    const int lag = find_lag({}, LAG_LIMIT);
    fmt::print("lag: {} frames to a tenth\n", lag);
    EXPECT_GE(lag, 1);
    EXPECT_LE(lag, LAG_LIMIT);
}

TEST_F(IndirectCacheTest, CellsThatNeverAgeAreFound) {
    EXPECT_EQ(find_lag({"TARN_PLANT_CACHE_NEVER_AGES"}, LAG_LIMIT), -1);
}

// ---- Leaks

// A thin wall between two corners that open towards the camera; a lamp on one side. No light reaches the
// other side.
Scene make_thin_wall() {
    ToyScene toy;
    const MaterialIndex white = toy.add_material(lambert_material(glm::vec3(ALBEDO)));
    const float left = 0.005f, right = 0.015f;
    toy.add_quad(white, {left, -1, -1}, {0, 0, 3}, {0, 3, 0});   // the wall's left side, facing -x
    toy.add_quad(white, {right, -1, 2}, {0, 0, -3}, {0, 3, 0});  // and its right side
    toy.add_quad(white, {-1, -1, 1}, {1.005f, 0, 0}, {0, 0, -2});
    toy.add_quad(white, {right, -1, 1}, {1, 0, 0}, {0, 0, -2});
    toy.add_quad(white, {-1, -1, -1}, {1.005f, 0, 0}, {0, 2, 0});
    toy.add_quad(white, {right, -1, -1}, {1, 0, 0}, {0, 2, 0});
    const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(10.0f)));
    toy.add_quad(lamp, {-0.8f, 0.95f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f});
    return std::move(toy.scene);
}

constexpr double TIGHT = 0.003;

// Light right of the wall over that on its left.
double find_leak(const Planted& planted) {
    CachedRoom room(make_thin_wall(), make_settings(IndirectCache::WORLD), planted);
    room.look_from({0.01, 0.2, 3.5}, {0.01, -0.2, 0.0});
    room.restart(5);
    double left = 0.0, right = 0.0;
    for (int frame = 0; frame < 64; ++frame) {
        const Image image = room.render();
        for (std::size_t i = 0; i < image.values.size(); ++i) {
            (int(i / 3) % WIDTH_PX < WIDTH_PX / 2 ? left : right) += image.values[i];
        }
    }
    return right / left;
}

TEST_F(IndirectCacheTest, AThinWallIsTight) {
    const double leak = find_leak({});
    fmt::print("through a wall of 1 cm: {:.5f}\n", leak);
    EXPECT_LE(leak, TIGHT);
}

TEST_F(IndirectCacheTest, NormalsThatAreIgnoredAreFound) {
    const double leak = find_leak({"TARN_PLANT_IGNORE_CACHE_NORMALS"});
    fmt::print("without normals: {:.5f}\n", leak);
    EXPECT_GT(leak, TIGHT);
}

// ---- Bounds and bits

std::vector<float> render_frames(const RenderSettings& settings, int frames, const Planted& planted,
                                 std::map<std::string, std::uint64_t>* counters = nullptr) {
    CachedRoom room(make_room(), settings, planted);
    room.restart(9);
    Image last;
    for (int frame = 0; frame < frames; ++frame) last = room.render();
    if (counters != nullptr) *counters = room.counters();
    for (const float value : last.values) EXPECT_TRUE(std::isfinite(value) && value >= 0.0f);
    return last.values;
}

TEST_F(IndirectCacheTest, TwoRunsHaveTheSameBits) {
    for (const IndirectCache cache : {IndirectCache::SCREEN, IndirectCache::WORLD}) {
        const RenderSettings settings = make_settings(cache, IndirectMode::RESTIR);
        EXPECT_EQ(render_frames(settings, 12, {}), render_frames(settings, 12, {})) << int(cache);
    }
}

TEST_F(IndirectCacheTest, AGridThatIsTooSmallTurnsCellsAwayAndKeepsItsBits) {
    const Planted small = {"TARN_SMALL_CACHE"};
    const RenderSettings settings = make_settings(IndirectCache::WORLD);
    std::map<std::string, std::uint64_t> counters;
    const std::vector<float> first = render_frames(settings, 24, small, &counters);
    EXPECT_GT(counters.at("cache_full"), 0u);
    EXPECT_EQ(first, render_frames(settings, 24, small));
}

TEST_F(IndirectCacheTest, WhatIsNoNumberStaysOutAndIsCounted) {
    std::map<std::string, std::uint64_t> counters;
    render_frames(make_settings(IndirectCache::WORLD), 12, {"TARN_PLANT_NOT_A_NUMBER"}, &counters);
    EXPECT_GT(counters.at("bad_cache"), 0u);
    EXPECT_EQ(counters.at("bad_radiance"), 0u);
}

}  // namespace
}  // namespace tarn::test
