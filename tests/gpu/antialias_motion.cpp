// Antialiasing over time while the camera, things or lights move: what stays sharp, what leaves a ghost, what
// crawls. Oracles: analytic scenes, integrated by many rays a pixel.
#include <gtest/gtest.h>

#include "gpu/antialias_sights.h"

namespace tarn {
namespace {

using namespace test;

// ---- Texture

struct WaveErrors {
    double found = 0.0;
    double enlarged = 0.0;  // of one frame, enlarged bilinearly
};

// Of waves while the camera walks, or stands in a scene where something else moves; over that of an even
// grey.
WaveErrors find_wave_errors(double scale, const glm::vec3& step, const Defines& planted = {}) {
    AntialiasStage stage(OUTPUT_PX, scale);
    stage.plant(planted);
    stage.has_moved = true;
    Pixels found;
    for (int frame = 0; frame < 24; ++frame) {
        stage.move_camera(step);
        found = stage.render(see_waves);
    }
    const Pixels truth = stage.integrate(see_waves, 8);
    const double contrast = rms_error(truth, Pixels(truth.size(), glm::vec3(0.5f)));
    WaveErrors errors{rms_error(found, truth) / contrast, 0.0};
    if (scale < 1.0) errors.enlarged = rms_error(stage.enlarged(), truth) / contrast;
    fmt::print("scale {}, step {}: {:.3f} of the contrast, enlarged {:.3f}\n", scale, step.x, errors.found,
               errors.enlarged);
    return errors;
}

// Waves of five pixels, which each frame reads anew from the last.
TEST(AntialiasMotion, FineTextureStaysSharpInMotion) {
    EXPECT_LT(find_wave_errors(1.0, glm::vec3(0.0f)).found, 0.1);
    EXPECT_LT(find_wave_errors(1.0, WALK).found, 0.25);
    for (const glm::vec3& step : {glm::vec3(0.0f), WALK}) {
        const WaveErrors errors = find_wave_errors(0.5, step);
        EXPECT_LT(errors.found, 0.75 * errors.enlarged);
    }
}

TEST(AntialiasMotion, APastThatIsReadWithTheJitterIsFound) {
    EXPECT_GT(find_wave_errors(1.0, glm::vec3(0.0f), {"TARN_PLANT_NO_UNJITTER"}).found, 0.25);
}

// A board of 1 before a wall of 0.1, which runs to the right by `step_m` a frame.
SightOf see_board(int frame, float step_m) {
    return [frame, step_m](const glm::vec3& origin, const glm::vec3& direction) {
        const float middle = -1.0f + step_m * float(frame);
        Sight sight;
        sight.position = meet_plane(origin, direction, -2.0f);
        sight.radiance = glm::vec3(1.0f);
        sight.previous = sight.position - glm::vec3(step_m, 0.0f, 0.0f);
        if (std::abs(sight.position.x - middle) < 0.25f && std::abs(sight.position.y) < 0.5f) return sight;
        sight.position = sight.previous = meet_plane(origin, direction, -5.0f);
        sight.radiance = glm::vec3(0.1f);
        return sight;
    };
}

// The board runs, or the camera walks past it.
struct Pace {
    float board_m;  // a frame; a pixel of the board is 0.05 m wide
    float camera_m;
};

// How far the wall is from its radiance where the board was two frames ago and longer, and not since.
double ghost(double scale, const Pace& pace, const Defines& planted = {}) {
    constexpr int AFTER = 2;
    const int frames = int(1.8f / std::max(pace.board_m, pace.camera_m));
    AntialiasStage stage(OUTPUT_PX, scale);
    stage.plant(planted);
    stage.has_moved = true;
    stage.scene_changed = pace.board_m > 0.0f;
    if (stage.scene_changed) stage.change = 0.0f;
    std::vector<Pixels> shown;
    Pixels found;
    for (int frame = 0; frame < frames; ++frame) {
        stage.move_camera({-pace.camera_m, 0.0f, 0.0f});
        found = stage.render(see_board(frame, pace.board_m));
        shown.push_back(stage.integrate(see_board(frame, pace.board_m), 4));
    }
    double greatest = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        bool is_free = true, was_hidden = false;
        for (int frame = 0; frame < frames; ++frame) {
            const bool hidden = shown[std::size_t(frame)][i].x > 0.1001f;
            was_hidden = was_hidden || hidden;
            if (frame >= frames - AFTER) is_free = is_free && !hidden;
        }
        if (is_free && was_hidden) greatest = std::max(greatest, std::abs(double(found[i].x) - 0.1));
    }
    fmt::print("scale {}, board {} m, camera {} m a frame: ghost of {:.4f}\n", scale, pace.board_m,
               pace.camera_m, greatest);
    return greatest;
}

constexpr Pace FAST_BOARD{0.15f, 0.0f};

TEST(AntialiasMotion, AMovingEdgeLeavesNoGhostAfterTwoFrames) {
    for (const double scale : SCALES) EXPECT_LT(ghost(scale, FAST_BOARD), 0.01) << scale;
}

// Parallax of 3, 1, 0.5 and 0.3 pixels a frame.
TEST(AntialiasMotion, WhatAWalkLaysBareShowsNoGhost) {
    for (const float step_m : {0.25f, 0.083f, 0.042f, 0.025f})
        EXPECT_LT(ghost(1.0, {0.0f, step_m}), 0.1) << step_m;
    for (const float step_m : {0.05f, 0.025f, 0.015f}) EXPECT_LT(ghost(1.0, {step_m, 0.0f}), 0.1) << step_m;
    for (const float step_m : {0.083f, 0.042f, 0.025f})
        EXPECT_LT(ghost(0.33, {0.0f, step_m}), 0.18) << step_m;
}

TEST(AntialiasMotion, APastThatIsNotClippedIsFound) {
    EXPECT_GT(ghost(1.0, FAST_BOARD, {"TARN_PLANT_NO_CLIP"}), 0.1);
    EXPECT_GT(ghost(1.0, {0.0f, 0.25f}, {"TARN_PLANT_NO_CLIP"}), 0.1);
}

// ---- Light that changes

// How far a wall, or a lamp, is from what it became after 2 frames.
double find_lag(bool is_lamp, std::optional<float> change, const Defines& planted = {}) {
    AntialiasStage stage(OUTPUT_PX, 1.0);
    stage.plant(planted);
    stage.has_moved = stage.scene_changed = true;
    stage.change = change;
    Pixels found;
    for (int frame = 0; frame < 18; ++frame) {
        found = stage.render([&](const glm::vec3& origin, const glm::vec3& direction) {
            Sight sight = see_edge(origin, direction);
            sight.radiance = glm::vec3(frame < 16 ? 1.0f : 0.1f);
            if (is_lamp) sight.emission = sight.radiance;
            return sight;
        });
    }
    return greatest_difference(found, Pixels(found.size(), glm::vec3(0.1f)));
}

// The same where nothing of the scene has changed: what a smooth surface mirrors moves in its own way.
double find_mirror_lag(float alpha) {
    AntialiasStage stage(OUTPUT_PX, 1.0);
    stage.plant({});
    stage.has_moved = true;
    Pixels found;
    for (int frame = 0; frame < 18; ++frame) {
        found = stage.render([&](const glm::vec3& origin, const glm::vec3& direction) {
            Sight sight = see_edge(origin, direction);
            sight.radiance = glm::vec3(frame < 16 ? 1.0f : 0.1f);
            sight.alpha = alpha;
            return sight;
        });
    }
    return greatest_difference(found, Pixels(found.size(), glm::vec3(0.1f)));
}

TEST(AntialiasMotion, WhatASmoothSurfaceMirrorsIsFollowed) {
    EXPECT_LT(find_mirror_lag(0.01f), 0.01);
    EXPECT_GT(find_mirror_lag(0.5f), 0.1);
}

TEST(AntialiasMotion, ChangedLightIsShownAtOnce) {
    EXPECT_LT(find_lag(false, std::nullopt), 0.01) << "nobody knows where";
    EXPECT_LT(find_lag(false, 0.9f), 0.01) << "it is known";
    EXPECT_LT(find_lag(true, 0.0f), 0.01) << "a lamp";
    EXPECT_GT(find_lag(false, 0.0f), 0.1) << "a change that was overlooked";
    EXPECT_GT(find_lag(true, 0.0f, {"TARN_PLANT_STEADY_LAMPS"}), 0.1);
}

// ---- Crawling

// Stripes of less than two pixels.
Sight see_stripes(const glm::vec3& origin, const glm::vec3& direction) {
    Sight sight = see_edge(origin, direction);
    const float across = sight.position.x + 0.2f * sight.position.y;
    sight.radiance = glm::vec3(std::sin(30.0f * across) > 0.0f ? 1.0f : 0.1f);
    return sight;
}

// Mean of |a - 2 b + c| of three pictures in a row, as the display shows them.
double second_difference(const std::vector<Pixels>& pictures) {
    const auto shown = [](double value) { return std::pow(std::clamp(value, 0.0, 1.0), 1.0 / 2.2); };
    double sum = 0.0;
    for (std::size_t f = 2; f < pictures.size(); ++f) {
        for (std::size_t i = 0; i < pictures[f].size(); ++i) {
            sum += std::abs(shown(pictures[f - 2][i].x) - 2.0 * shown(pictures[f - 1][i].x) +
                            shown(pictures[f][i].x));
        }
    }
    return sum / double((pictures.size() - 2) * pictures[0].size());
}

// What a camera that walks a ninth of a pixel a frame sees crawl beyond what the integral over each pixel
// does: with antialiasing, over that of single samples.
double find_crawling(const SightOf& sight) {
    AntialiasStage stage(OUTPUT_PX, 1.0);
    stage.plant({});
    stage.has_moved = true;
    std::vector<Pixels> single, smooth, truth;
    for (int frame = 0; frame < 24; ++frame) {
        stage.move_camera({0.013f, 0.0f, 0.0f});
        const Pixels found = stage.render(sight);
        if (frame < 12) continue;
        smooth.push_back(found);
        single.push_back(stage.integrate(sight, 1));
        truth.push_back(stage.integrate(sight, 8));
    }
    const double before = second_difference(single), after = second_difference(smooth);
    const double least = second_difference(truth);
    fmt::print("second difference: single samples {:.4f}, antialiased {:.4f}, integral {:.4f}\n", before,
               after, least);
    return (after - least) / (before - least);
}

TEST(AntialiasMotion, EdgesAndFineTextureCrawlLess) {
    EXPECT_LT(find_crawling(see_edge), 1.0 / 3.0);
    EXPECT_LT(find_crawling(see_stripes), 0.25);
}

}  // namespace
}  // namespace tarn
