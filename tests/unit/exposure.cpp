// Automatic exposure against the rule's words: sorted pixels, and what it promises for pictures that are
// hard.
#include <gtest/gtest.h>

#include <functional>

#include "core/display.h"
#include "support/draws.h"
#include "support/exposure_oracle.h"

namespace tarn {
namespace {

using namespace test;

void fill(Image& image, std::size_t from, std::size_t to, const std::function<vec3()>& draw) {
    for (std::size_t i = from; i < to; ++i) {
        const vec3 rgb = draw();
        for (int c = 0; c < 3; ++c) image.values[3 * i + std::size_t(c)] = rgb[c];
    }
}

// Levels around `centre`, spread over `range` stops, in some hue.
std::function<vec3()> spread(Draws& draws, float centre_stops, float range_stops) {
    return [&draws, centre_stops, range_stops] {
        const float level = std::exp2(centre_stops + range_stops * float(draws.uniform(-0.5, 0.5)));
        return level * vec3(float(draws.uniform(0.2, 1.0)), 1.0f, float(draws.uniform(0.2, 1.0)));
    };
}

// `share` of the pixels are a subject `stops` brighter than what is around it.
Image draw_two_levels(double share, float stops, std::uint32_t seed) {
    Draws draws(seed);
    Image image(100, 80, 3);
    const std::size_t subject = std::size_t(share * 8000);
    fill(image, 0, subject, spread(draws, stops - 3.0f, 2.0f));
    fill(image, subject, 8000, spread(draws, -3.0f, 4.0f));
    return image;
}

TEST(AutoExposure, isWhatSortingAllPixelsGives) {
    for (const double share : {0.0, 0.01, 0.03, 0.2, 0.7}) {
        for (const float stops : {0.0f, 3.0f, 5.0f, 10.0f}) {
            const Image image = draw_two_levels(share, stops, 3);
            EXPECT_NEAR(auto_exposure_ev(image), find_exposure_by_sorting(image), EXPOSURE_BIN_STOPS)
                << share << ", " << stops;
            EXPECT_NEAR(auto_exposure_ev(image, ToneCurve::CLIP), find_exposure_by_sorting(image, 1.0f),
                        EXPOSURE_BIN_STOPS)
                << share << ", " << stops;
        }
    }
}

TEST(AutoExposure, aBrightSubjectUnderADimSurroundDoesNotClip) {
    for (const double share : {0.2, 0.3, 0.46, 0.6}) {
        for (const float stops : {2.0f, 4.0f, 6.0f, 12.0f}) {
            const Image image = draw_two_levels(share, stops, 5);
            const std::vector<float> sorted = sort_brightest_channels(image);
            EXPECT_LE(share_of_clipped(sorted, auto_exposure_ev(image)), 0.02f) << share << ", " << stops;
            EXPECT_LE(share_of_clipped(sorted, auto_exposure_ev(image, ToneCurve::CLIP), 1.0f), 0.02f)
                << share << ", " << stops;
            if (share == 0.46 && stops == 6.0f) {
                EXPECT_GT(share_of_clipped(sorted, measuring_exposure_ev(image)), 0.2f)
                    << "the log-average, which knows no white, burns it";
            }
        }
    }
}

// Lamps on eight pixels of a hundred, twelve stops brighter than the room: they clip, and the room stays as
// it was.
TEST(AutoExposure, aFewLampsThatAreSeenDirectlyDragNothingDark) {
    const float without = auto_exposure_ev(draw_two_levels(0.0, 0.0f, 7));
    const Image lamps = draw_two_levels(0.08, 12.0f, 7);
    EXPECT_NEAR(auto_exposure_ev(lamps), without, 0.3f);
    const std::vector<float> sorted = sort_brightest_channels(lamps);
    const float lamp = std::exp2(find_middle_by_sorting(sorted) + 6.0f);
    EXPECT_LE(share_of_clipped(sorted, auto_exposure_ev(lamps), 2.0f, lamp), 0.02f);
    EXPECT_GT(share_of_clipped(sorted, auto_exposure_ev(lamps)), 0.075f);
}

// No step as a lamp comes into view: the exposure moves on steadily from one rule to the other.
TEST(AutoExposure, movesSteadilyAsLampsFillThePicture) {
    float last = auto_exposure_ev(draw_two_levels(0.0, 0.0f, 9));
    for (double share = 0.0025; share < 0.25; share += 0.0025) {
        const float ev = auto_exposure_ev(draw_two_levels(share, 9.0f, 9));
        EXPECT_LT(std::abs(ev - last), 1.0f) << share;
        last = ev;
    }
}

TEST(AutoExposure, knowsPicturesWithNothingInThem) {
    EXPECT_EQ(auto_exposure_ev(Image(7, 5, 3)), 0.0f);
    Image image(1, 1, 3);
    fill(image, 0, 1, [] { return vec3(1e5f); });
    EXPECT_NEAR(auto_exposure_ev(image), std::log2(0.18 / 1e5), EXPOSURE_BIN_STOPS);
    fill(image, 0, 1, [] { return vec3(1e-20f); });
    EXPECT_EQ(auto_exposure_ev(image), 20.0f);
    fill(image, 0, 1, [] { return vec3(1e20f); });
    EXPECT_EQ(auto_exposure_ev(image), -20.0f);
}

TEST(AutoExposure, onePixelDoesNotMoveIt) {
    Draws draws(1);
    Image image(50, 40, 3);
    fill(image, 0, 2000, spread(draws, 0.0f, 3.0f));
    const float ev = auto_exposure_ev(image);
    for (const float odd : {1e6f, std::nanf(""), std::numeric_limits<float>::infinity(), 0.0f, -1.0f}) {
        Image other = image;
        fill(other, 100, 101, [odd] { return vec3(odd, 0.0f, odd); });
        EXPECT_NEAR(auto_exposure_ev(other), ev, 0.01f) << odd;
    }
}

TEST(AutoExposure, aLargePictureIsLookedAtInAGrid) {
    Draws draws(1);
    Image image(1500, 700, 3);
    fill(image, 0, image.pixel_count(), spread(draws, 2.0f, 6.0f));
    EXPECT_NEAR(auto_exposure_ev(image), find_exposure_by_sorting(image), EXPOSURE_BIN_STOPS + 0.02f);
}

}  // namespace
}  // namespace tarn
