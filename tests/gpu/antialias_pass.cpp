// Antialiasing over time and enlarging with it: what it must leave alone, what it converges to, what must
// leave no trace, and that mistakes are found. Oracles: analytic scenes, integrated by many rays a pixel.
#include <gtest/gtest.h>

#include <limits>

#include "gpu/antialias_stage.h"

namespace tarn {
namespace {

using namespace test;

constexpr glm::ivec2 OUTPUT_PX(62, 43);  // no multiple of a group
constexpr double SCALES[] = {1.0, 0.75, 0.5, 0.33};

// ---- Places in a pixel

TEST(AntialiasJitter, TheMeanIsTheCentreAndThePlacesAreEven) {
    for (const int count : {16, 32, 256}) {
        glm::dvec2 sum(0.0);
        for (int i = 0; i < count; ++i) sum += glm::dvec2(find_jitter(std::uint32_t(5 * count + i), count));
        EXPECT_LT(glm::length(sum), 1e-5) << count;
        // Each box of 2^-a x 2^-b = 1 / count holds one place; +1/2 / count undoes the move to the centre.
        for (int columns = 1; columns <= count; columns *= 2) {
            const int rows = count / columns;
            std::vector<int> hits(std::size_t(count), 0);
            for (int i = 0; i < count; ++i) {
                const glm::dvec2 place = glm::dvec2(find_jitter(std::uint32_t(i), count)) + 0.5;
                ++hits[std::size_t(int(place.y * rows) * columns + int(place.x * columns))];
            }
            for (const int n : hits) EXPECT_EQ(n, 1) << columns << " of " << count;
        }
    }
    EXPECT_EQ(find_jitter(7, 1), glm::vec2(0.0f));
}

// ---- What each ray meets

glm::vec3 meet_plane(const glm::vec3& origin, const glm::vec3& direction, float z) {
    return origin + direction * ((z - origin.z) / direction.z);
}

// A wall at 5 m with a slanted edge: 1 on one side, 0.1 on the other.
Sight see_edge(const glm::vec3& origin, const glm::vec3& direction) {
    Sight sight;
    sight.position = sight.previous = meet_plane(origin, direction, -5.0f);
    sight.radiance = glm::vec3(sight.position.x + 0.37f * sight.position.y > 0.2f ? 1.0f : 0.1f);
    return sight;
}

// The same wall in waves of some pixels.
Sight see_waves(const glm::vec3& origin, const glm::vec3& direction) {
    Sight sight = see_edge(origin, direction);
    sight.radiance = glm::vec3(0.5f) + 0.4f * glm::vec3(std::sin(11.0f * sight.position.x),
                                                        std::sin(9.0f * sight.position.y), 0.0f);
    return sight;
}

SightOf see_even(const glm::vec3& radiance) {
    return [radiance](const glm::vec3& origin, const glm::vec3& direction) {
        Sight sight = see_edge(origin, direction);
        sight.is_sky = sight.position.y > 0.5f;
        sight.radiance = radiance;
        return sight;
    };
}

TEST(AntialiasPass, EvenLightStaysWhatItIsAtRestAndInMotion) {
    const glm::vec3 even(3.0f, 700.0f, 1e-3f);
    for (const double scale : SCALES) {
        for (const bool moves : {false, true}) {
            AntialiasStage stage(OUTPUT_PX, scale);
            stage.plant({});
            stage.has_moved = moves;
            const Pixels expected(std::size_t(OUTPUT_PX.x) * OUTPUT_PX.y, glm::vec3(1.0f));
            for (int frame = 0; frame < 8; ++frame) {
                if (moves) stage.move_camera({0.013f, 0.007f, -0.01f});
                Pixels found = stage.render(see_even(even));
                for (glm::vec3& value : found) value /= even;
                EXPECT_LT(greatest_difference(found, expected), 1e-5) << scale << ", moves: " << moves;
            }
            EXPECT_EQ(stage.count(COUNTER_BAD_PICTURE), 0u);
        }
    }
}

// ---- At rest

// Error at an edge after 64 frames, over that of a single sample a pixel or of bilinear enlarging.
double edge_error(double scale, const Defines& planted = {}) {
    AntialiasStage stage(OUTPUT_PX, scale);
    stage.plant(planted);
    const Pixels truth = stage.integrate(see_edge, 16);
    double before = rms_error(stage.integrate(see_edge, 1), truth);
    Pixels found;
    for (int frame = 0; frame < 64; ++frame) {
        stage.has_moved = frame == 0;
        found = stage.render(see_edge);
        if (scale < 1.0 && frame == 0) before = rms_error(stage.enlarged(), truth);
    }
    const double after = rms_error(found, truth);
    fmt::print("scale {}: error {:.4f}, without {:.4f}\n", scale, after, before);
    return after / before;
}

TEST(AntialiasPass, AtRestAnEdgeBecomesItsIntegralOverThePixels) {
    EXPECT_LT(edge_error(1.0), 1.0 / 8.0);
}

TEST(AntialiasPass, AtRestALargerPictureBecomesThatOfFullSize) {
    for (const double scale : {0.75, 0.5, 0.33}) EXPECT_LT(edge_error(scale), 1.0 / 4.0) << scale;
}

TEST(AntialiasPass, SamplesTakenToBeWhereTheyAreNotAreFound) {
    EXPECT_GT(edge_error(0.5, {"TARN_PLANT_FLIPPED_JITTER"}), 1.0 / 4.0);
}

TEST(AntialiasPass, NoEnergyIsLostAtEdgesOfLamps) {
    const SightOf see_lamp = [](const glm::vec3& origin, const glm::vec3& direction) {
        Sight sight = see_edge(origin, direction);
        if (sight.radiance.x == 1.0f) sight.radiance = sight.emission = glm::vec3(500.0f);
        return sight;
    };
    for (const double scale : {1.0, 0.5}) {
        AntialiasStage stage(OUTPUT_PX, scale);
        stage.plant({});
        Pixels found;
        for (int frame = 0; frame < 64; ++frame) {
            stage.has_moved = frame == 0;
            found = stage.render(see_lamp);
        }
        double sum = 0.0, expected = 0.0;
        for (const glm::vec3& value : found) sum += value.x;
        for (const glm::vec3& value : stage.integrate(see_lamp, 16)) expected += value.x;
        EXPECT_NEAR(sum / expected, 1.0, 2e-3) << scale;
    }
}

// ---- In motion

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

constexpr glm::vec3 WALK(0.031f, 0.017f, 0.0f);  // parts of a pixel, which is 0.12 m wide

// Waves of five pixels, which each frame reads anew from the last.
TEST(AntialiasPass, FineTextureStaysSharpInMotion) {
    EXPECT_LT(find_wave_errors(1.0, glm::vec3(0.0f)).found, 0.1);
    EXPECT_LT(find_wave_errors(1.0, WALK).found, 0.25);
    for (const glm::vec3& step : {glm::vec3(0.0f), WALK}) {
        const WaveErrors errors = find_wave_errors(0.5, step);
        EXPECT_LT(errors.found, 0.75 * errors.enlarged);
    }
}

TEST(AntialiasPass, APastThatIsReadWithTheJitterIsFound) {
    EXPECT_GT(find_wave_errors(1.0, glm::vec3(0.0f), {"TARN_PLANT_NO_UNJITTER"}).found, 0.25);
}

// A board of 1 before a wall of 0.1 runs through the picture, 3 pixels a frame.
SightOf see_board(int frame) {
    return [frame](const glm::vec3& origin, const glm::vec3& direction) {
        const float step = 0.15f;
        const float middle = -1.0f + step * float(frame);
        Sight sight;
        sight.position = meet_plane(origin, direction, -2.0f);
        sight.radiance = glm::vec3(1.0f);
        sight.previous = sight.position - glm::vec3(step, 0.0f, 0.0f);
        if (std::abs(sight.position.x - middle) < 0.25f && std::abs(sight.position.y) < 0.5f) return sight;
        sight.position = sight.previous = meet_plane(origin, direction, -5.0f);
        sight.radiance = glm::vec3(0.1f);
        return sight;
    };
}

// How far the wall is from its radiance where the board was two frames ago and longer, and not since.
double ghost(double scale, const Defines& planted = {}) {
    constexpr int FRAMES = 12, AFTER = 2;
    AntialiasStage stage(OUTPUT_PX, scale);
    stage.plant(planted);
    stage.has_moved = true;
    std::vector<Pixels> shown;
    Pixels found;
    for (int frame = 0; frame < FRAMES; ++frame) {
        found = stage.render(see_board(frame));
        shown.push_back(stage.integrate(see_board(frame), 4));
    }
    double greatest = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        bool is_free = true, was_hidden = false;
        for (int frame = 0; frame < FRAMES; ++frame) {
            const bool hidden = shown[std::size_t(frame)][i].x > 0.1001f;
            was_hidden = was_hidden || hidden;
            if (frame >= FRAMES - AFTER) is_free = is_free && !hidden;
        }
        if (is_free && was_hidden) greatest = std::max(greatest, std::abs(double(found[i].x) - 0.1));
    }
    return greatest;
}

TEST(AntialiasPass, AMovingEdgeLeavesNoGhostAfterTwoFrames) {
    for (const double scale : SCALES) EXPECT_LT(ghost(scale), 0.01) << scale;
}

TEST(AntialiasPass, APastThatIsNotClippedIsFound) {
    EXPECT_GT(ghost(1.0, {"TARN_PLANT_NO_CLIP"}), 0.1);
}

// ---- What must not come in

// Greatest error in the frames after the one in which one pixel in the middle was `bad`.
double trace_of(const glm::vec4& bad, double scale, bool moves, const Defines& planted = {}) {
    AntialiasStage stage(OUTPUT_PX, scale);
    stage.plant(planted);
    const Pixels expected(std::size_t(OUTPUT_PX.x) * OUTPUT_PX.y, glm::vec3(0.5f));
    double error = 0.0;
    for (int frame = 0; frame < 8; ++frame) {
        stage.has_moved = moves || frame == 0;
        if (moves) stage.move_camera({0.031f, 0.0f, 0.0f});
        const bool spoils = frame == 4 || frame == 0;
        stage.spoil = [&](std::vector<glm::vec4>& radiance) {
            if (spoils) radiance[std::size_t(stage.size_px().x) * (stage.size_px().y / 2) + 9] = bad;
        };
        const Pixels found = stage.render(see_even(glm::vec3(0.5f)));
        if (!spoils) error = std::max(error, greatest_difference(found, expected));
    }
    if (planted.empty()) {
        EXPECT_GT(stage.count(COUNTER_BAD_PICTURE), 0u);
    }
    return error;
}

const glm::vec4 BAD_RADIANCE[] = {
    {std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.0f, 1.0f},
    {0.0f, std::numeric_limits<float>::infinity(), 0.0f, 1.0f},
    {1e6f, 1e6f, 1e6f, 1.0f},
    {-1.0f, 0.0f, 0.0f, 1.0f},
    {0.0f, 0.0f, 0.0f, 0.0f},  // what composite found not to be finite
};

TEST(AntialiasPass, WhatIsNoLightLeavesNoTraceAndIsCounted) {
    for (const double scale : {1.0, 0.5}) {
        for (const bool moves : {false, true}) {
            for (const glm::vec4& bad : BAD_RADIANCE)
                EXPECT_LT(trace_of(bad, scale, moves), 1e-5) << bad.x << ", " << scale << ", " << moves;
        }
    }
}

TEST(AntialiasPass, APastThatTakesEverythingIsFound) {
    EXPECT_GT(trace_of(BAD_RADIANCE[0], 1.0, false, {"TARN_PLANT_UNSANITIZED"}), 0.1);
    EXPECT_GT(trace_of(BAD_RADIANCE[2], 1.0, false, {"TARN_PLANT_UNSANITIZED"}), 0.1);
}

// How far the first frame of another size is from one that has no past at all.
double resize_error(const Defines& planted = {}) {
    std::vector<Pixels> resized;
    for (const bool forgets : {false, true}) {
        AntialiasStage stage(OUTPUT_PX, 1.0);
        stage.plant(planted);
        stage.render(see_edge);
        stage.set_output({50, 60});
        if (forgets) stage.forget();
        resized.push_back(stage.render(see_edge));
    }
    return greatest_difference(resized[0], resized[1]);
}

TEST(AntialiasPass, APictureOfAnotherSizeIsNoPast) {
    EXPECT_EQ(resize_error(), 0.0);
    EXPECT_GT(resize_error({"TARN_PLANT_FOREIGN_SIZE"}), 0.1);
}

// Lamps far brighter than white: what the display shows of their edge is the mean of what it would show of
// each sample.
double lamp_error(AntialiasMean mean) {
    const auto shown = [](const glm::vec3& radiance) { return radiance / (1.0f + radiance); };
    // A bar of few pixels: the exposure goes by the wall.
    const SightOf see_lamp = [](const glm::vec3& origin, const glm::vec3& direction) {
        Sight sight = see_edge(origin, direction);
        const float across = sight.position.x + 0.37f * sight.position.y;
        sight.radiance = glm::vec3(0.5f);
        if (across > 0.2f && across < 0.6f) sight.radiance = sight.emission = glm::vec3(500.0f);
        return sight;
    };
    AntialiasStage stage(OUTPUT_PX, 1.0);
    stage.settings.antialias.mean = mean;
    stage.plant({});
    Pixels found;
    for (int frame = 0; frame < 32; ++frame) {
        stage.has_moved = frame == 0;
        found = stage.render(see_lamp);
    }
    for (glm::vec3& value : found) value = shown(value);
    return rms_error(found, stage.integrate(
                                [&](const glm::vec3& origin, const glm::vec3& direction) {
                                    Sight sight = see_lamp(origin, direction);
                                    sight.radiance = shown(sight.radiance);
                                    return sight;
                                },
                                16));
}

TEST(AntialiasPass, TheMeanOfTheDisplaySmoothsTheEdgesOfLamps) {
    const double stairs = lamp_error(AntialiasMean::RADIANCE), smooth = lamp_error(AntialiasMean::DISPLAY);
    fmt::print("error of what is shown: {:.4f} of radiance, {:.4f} of the display\n", stairs, smooth);
    EXPECT_LT(smooth, 0.5 * stairs);
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

TEST(AntialiasPass, EdgesAndFineTextureCrawlLess) {
    EXPECT_LT(find_crawling(see_edge), 1.0 / 3.0);
    EXPECT_LT(find_crawling(see_stripes), 0.25);
}

}  // namespace
}  // namespace tarn
