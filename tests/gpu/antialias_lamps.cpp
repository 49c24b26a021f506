// Antialiasing over time of what is far brighter than white: whether small lamps keep their energy, whether
// large ones spread in motion, whether both become smooth at rest. Oracles: analytic scenes, integrated by
// many rays a pixel.
#include <gtest/gtest.h>

#include "gpu/antialias_sights.h"

namespace tarn {
namespace {

using namespace test;

// ---- Energy of what is smaller than a pixel

// What is a seventh of a pixel wide, on the wall and `gap_m` before it.
struct Spots {
    float radiance;
    bool shine;  // else they reflect
};
constexpr Spots LAMPS{40.0f, true};
constexpr Spots GLINTS{8.0f, false};  // less above the wall than what counts as a stray

SightOf see_spots(float gap_m, const Spots& spots) {
    return [gap_m, spots](const glm::vec3& origin, const glm::vec3& direction) {
        const auto is_spot = [](const glm::vec3& position) {
            const glm::vec2 cell = glm::fract(glm::vec2(position) / 0.61f) * 0.61f;
            return cell.x < 0.045f && cell.y < 0.045f;
        };
        Sight sight = see_edge(origin, direction);
        sight.radiance = glm::vec3(0.1f);
        const glm::vec3 before = meet_plane(origin, direction, -5.0f + gap_m);
        if (is_spot(before) || is_spot(sight.position)) {
            if (is_spot(before)) sight.position = sight.previous = before;
            sight.radiance = glm::vec3(spots.radiance);
            if (spots.shine) sight.emission = sight.radiance;
            sight.instance = 1.0f;
        }
        return sight;
    };
}

// Energy of the pictures while the camera walks, over that of the samples that they are made of.
double find_energy(const std::function<SightOf(int frame)>& sight_of, const glm::vec3& step, bool scene_moves,
                   const Defines& planted = {}) {
    constexpr int WARM_UP = 32, FRAMES = 128;
    AntialiasStage stage(OUTPUT_PX, 1.0);
    stage.plant(planted);
    stage.has_moved = true;
    stage.scene_changed = scene_moves;
    if (scene_moves) stage.change = 0.0f;
    double found = 0.0, expected = 0.0, sample = 0.0;
    stage.spoil = [&](const std::vector<glm::vec4>& radiance) {
        sample = 0.0;
        for (const glm::vec4& value : radiance) sample += value.x;
    };
    for (int frame = 0; frame < WARM_UP + FRAMES; ++frame) {
        stage.move_camera(step);
        const Pixels shown = stage.render(sight_of(frame));
        if (frame < WARM_UP) continue;
        for (const glm::vec3& value : shown) found += value.x;
        expected += sample;
    }
    return found / expected;
}

double find_energy(float gap_m, const glm::vec3& step, const Spots& spots, const Defines& planted = {}) {
    const double energy = find_energy([&](int) { return see_spots(gap_m, spots); }, step, false, planted);
    fmt::print("{} {} m before the wall, step {}: {:.4f} of the energy\n", spots.shine ? "lamps" : "glints",
               gap_m, step.x, energy);
    return energy;
}

TEST(AntialiasLamps, ThoseSmallerThanAPixelKeepTheirEnergyInMotion) {
    for (const float pace : {0.0f, 1.0f, 5.0f}) {
        for (const float gap_m : {0.0f, 0.2f, 1.0f}) {
            EXPECT_NEAR(find_energy(gap_m, pace * WALK, LAMPS), 1.0, 0.01) << pace << ", " << gap_m;
        }
    }
}

// Their light has a past.
TEST(AntialiasLamps, SoDoGlints) {
    EXPECT_NEAR(find_energy(0.0f, glm::vec3(0.0f), GLINTS), 1.0, 0.02);
    EXPECT_NEAR(find_energy(0.0f, WALK, GLINTS), 1.0, 0.05);
    EXPECT_NEAR(find_energy(0.0f, 5.0f * WALK, GLINTS), 1.0, 0.05);
    EXPECT_NEAR(find_energy(0.2f, 5.0f * WALK, GLINTS), 1.0, 0.08)
        << "they overtake the wall by 0.05 pixels a frame";
    EXPECT_NEAR(find_energy(1.0f, WALK, GLINTS), 1.0, 0.05);
    EXPECT_LT(find_energy(1.0f, WALK, GLINTS, {"TARN_PLANT_NO_TRUST"}), 0.8);
}

// A wall full of them that runs past a camera at rest.
TEST(AntialiasLamps, ThoseOfThingsThatMoveKeepTheirEnergy) {
    const auto running = [](int frame) -> SightOf {
        return [frame](const glm::vec3& origin, const glm::vec3& direction) {
            const glm::vec3 run = WALK * float(frame);
            Sight sight = see_spots(0.0f, LAMPS)(origin - run, direction);
            sight.position += run;
            sight.previous = sight.position - WALK;
            return sight;
        };
    };
    EXPECT_NEAR(find_energy(running, glm::vec3(0.0f), true), 1.0, 0.02);
}

// They are infinitely far away.
TEST(AntialiasLamps, StarsKeepTheirEnergy) {
    const auto sky = [](int) -> SightOf {
        return [](const glm::vec3&, const glm::vec3& direction) {
            Sight sight = see_spots(0.0f, LAMPS)(glm::vec3(0.0f), direction);
            sight.is_sky = true;
            return sight;
        };
    };
    EXPECT_NEAR(find_energy(sky, WALK, false), 1.0, 0.02);
}

// ---- Edges

// A lamp of 40 and a few pixels on a wall of 0.1.
Sight see_lamp(const glm::vec3& origin, const glm::vec3& direction) {
    Sight sight = see_edge(origin, direction);
    const glm::vec3& place = sight.position;
    sight.radiance = glm::vec3(0.1f);
    if (std::abs(place.x) < 0.31f && std::abs(place.y + 0.2f * place.x) < 0.23f) {
        sight.radiance = sight.emission = glm::vec3(40.0f);
        sight.instance = 1.0f;
    }
    return sight;
}

// Greatest error of the wall's pixels that the lamp has not touched in this frame, after a walk: of frames,
// the last one's.
double find_halo(const glm::vec3& step, const Defines& planted = {}) {
    AntialiasStage stage(OUTPUT_PX, 1.0);
    stage.plant(planted);
    stage.has_moved = true;
    Pixels found;
    for (int frame = 0; frame < 24; ++frame) {
        stage.move_camera(step);
        found = stage.render(see_lamp);
    }
    const Pixels truth = stage.integrate(see_lamp, 8);
    double greatest = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (truth[i].x < 0.1001f) greatest = std::max(greatest, std::abs(double(found[i].x) - 0.1));
    }
    fmt::print("step {}: beside the lamp up to {:.3f} too much\n", step.x, greatest);
    return greatest;
}

TEST(AntialiasLamps, TheyDoNotSpreadInMotion) {
    for (const float pace : {0.2f, 1.0f, 5.0f}) EXPECT_LT(find_halo(pace * WALK), 0.3) << pace;
    EXPECT_GT(find_halo(WALK, {"TARN_PLANT_LAMPS_WITH_A_PAST"}), 2.0);
}

// Error of the picture over the lamp's radiance, after a walk and so many frames at rest.
double find_error_at_rest(int frames, const Defines& planted = {}) {
    AntialiasStage stage(OUTPUT_PX, 1.0);
    stage.plant(planted);
    stage.has_moved = true;
    Pixels found;
    for (int frame = -12; frame < frames; ++frame) {
        stage.has_moved = frame < 0;
        if (stage.has_moved) stage.move_camera(WALK);
        found = stage.render(see_lamp);
    }
    const double error = rms_error(found, stage.integrate(see_lamp, 16)) / 40.0;
    fmt::print("{} frames at rest: error {:.4f} of the lamp's radiance\n", frames, error);
    return error;
}

TEST(AntialiasLamps, TheyBecomeSmoothOnceAtRest) {
    const double after_walk = find_error_at_rest(0);
    EXPECT_LT(find_error_at_rest(16), 0.25 * after_walk);
    EXPECT_LT(find_error_at_rest(64), 0.1 * after_walk);
    EXPECT_GT(find_error_at_rest(64, {"TARN_PLANT_LATEST_EXCESS"}), 0.5 * after_walk);
}

// Where less is rendered than is shown, pixels without a sample near them take the lamp from those around.
TEST(AntialiasLamps, TheyHaveNoHolesAtSmallerScales) {
    for (const double scale : {0.75, 0.5, 0.33}) {
        AntialiasStage stage(OUTPUT_PX, scale);
        stage.plant({});
        stage.has_moved = true;
        Pixels found;
        for (int frame = 0; frame < 24; ++frame) {
            stage.move_camera(WALK);
            found = stage.render(see_lamp);
        }
        const Pixels truth = stage.integrate(see_lamp, 8);
        const auto is_lamp = [&](int x, int y) { return truth[std::size_t(y * OUTPUT_PX.x + x)].x > 39.9f; };
        int inside = 0;
        double darkest = 40.0;
        constexpr int REACH = 2;  // a pixel of what is rendered
        for (int y = REACH; y < OUTPUT_PX.y - REACH; ++y) {
            for (int x = REACH; x < OUTPUT_PX.x - REACH; ++x) {
                if (!is_lamp(x - REACH, y) || !is_lamp(x + REACH, y)) continue;
                ++inside;
                darkest = std::min(darkest, double(found[std::size_t(y * OUTPUT_PX.x + x)].x));
            }
        }
        EXPECT_GT(inside, 0);
        EXPECT_GT(darkest, 20.0) << scale;
    }
}

// The picture goes on through it.
TEST(AntialiasLamps, AChangeOfScaleCountsThemOnce) {
    for (const double first : {0.5, 1.0}) {
        AntialiasStage stage(OUTPUT_PX, first);
        stage.plant({});
        Pixels found;
        for (int frame = 0; frame < 64; ++frame) {
            if (frame == 32) stage.settings.antialias.scale = first == 1.0 ? 0.5 : 1.0;
            stage.has_moved = frame == 0;
            found = stage.render(see_lamp);
        }
        double sum = 0.0, expected = 0.0;
        for (const glm::vec3& value : found) sum += value.x;
        for (const glm::vec3& value : stage.integrate(see_lamp, 16)) expected += value.x;
        EXPECT_NEAR(sum / expected, 1.0, 0.02) << first;
    }
}

}  // namespace
}  // namespace tarn
