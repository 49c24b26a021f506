// Antialiasing over time and enlarging with it: what it must leave alone, what it converges to, what must
// leave no trace, and that mistakes are found. Oracles: analytic scenes, integrated by many rays a pixel.
#include <gtest/gtest.h>

#include <limits>

#include "gpu/antialias_sights.h"

namespace tarn {
namespace {

using namespace test;

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

}  // namespace
}  // namespace tarn
