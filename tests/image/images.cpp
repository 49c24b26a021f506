// Small pictures of generated scenes against goldens, at frames 1, 16 and 64, and proof that the comparison
// would notice a dropped cosine and a shift by one pixel.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <set>

#include "image/image_cases.h"
#include "image_io/image_io.h"
#include "support/on_context.h"

namespace tarn::test {

void PrintTo(const ImageSequence& sequence, std::ostream* out) {
    *out << sequence.name();
}

namespace {

Image read_golden(const std::string& name) {
    const std::filesystem::path file = golden_file(name);
    return std::filesystem::exists(file) ? read_png(file) : Image();
}

std::filesystem::path artefact_folder() {
    return std::filesystem::path(TARN_BUILD_DIR) / "image_artefacts";
}

const ImageSequence& find_sequence(const std::string& name) {
    for (const ImageSequence& sequence : image_sequences()) {
        if (sequence.name() == name) return sequence;
    }
    throw std::out_of_range(name);
}

class Images : public OnContext<testing::TestWithParam<ImageSequence>> {};

TEST_P(Images, MatchTheirGoldens) {
    const ImageSequence& sequence = GetParam();
    std::size_t seen = 0;
    render_sequence(sequence, [&](const std::string& name, const Image& actual) {
        const Image expected = read_golden(name);
        const ImageDifference difference = compare_display_images(expected, actual, sequence.tolerance);
        std::printf("%s: %s\n", name.c_str(), describe(difference, sequence.tolerance).c_str());
        EXPECT_TRUE(difference.passes(sequence.tolerance))
            << name << ": " << describe(difference, sequence.tolerance) << ", allowed are "
            << fmt::format("{:.3g} %; ", 100.0 * sequence.tolerance.exceeding_fraction)
            << keep_difference(artefact_folder(), name, expected, actual);
        ++seen;
    });
    EXPECT_EQ(seen, sequence.frames.size());
}

INSTANTIATE_TEST_SUITE_P(Golden, Images, testing::ValuesIn(image_sequences()),
                         [](const auto& info) { return info.param.name(); });

// ---- Would the comparison notice? ---------------------------------------------------------------

class NegativeControls : public Images {};

TEST_P(NegativeControls, ADroppedCosineIsNoticed) {
    const ImageSequence& sequence = GetParam();
    const auto expect_noticed = [&](const std::string& name, const Image& wrong) {
        EXPECT_FALSE(
            compare_display_images(read_golden(name), wrong, sequence.tolerance).passes(sequence.tolerance));
    };
    ImageSequence first_frame = sequence;
    first_frame.frames = {1};
    render_sequence(first_frame, expect_noticed, {"TARN_PLANT_DROP_COSINE"});
}

TEST_P(NegativeControls, AShiftByOnePixelIsNoticed) {
    const ImageSequence& sequence = GetParam();
    const Image golden = read_golden(sequence.golden_name(1));
    ASSERT_FALSE(golden.empty());
    Image right = golden, down = golden;
    for (int y = 1; y < golden.height; ++y) {
        for (int x = 1; x < golden.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                right.pixel(x, y)[c] = golden.pixel(x - 1, y)[c];
                down.pixel(x, y)[c] = golden.pixel(x, y - 1)[c];
            }
        }
    }
    const ImageTolerance& tolerance = sequence.tolerance;
    EXPECT_TRUE(compare_display_images(golden, golden, tolerance).passes(tolerance));
    EXPECT_FALSE(compare_display_images(golden, right, tolerance).passes(tolerance));
    EXPECT_FALSE(compare_display_images(golden, down, tolerance).passes(tolerance));
}

INSTANTIATE_TEST_SUITE_P(Golden, NegativeControls,
                         testing::Values(find_sequence("cornell_main_ris"),
                                         find_sequence("lantern_court_main_uniform"),
                                         find_sequence("lantern_court_main_balanced"),
                                         find_sequence("point_over_plane_main_ris")),
                         [](const auto& info) { return info.param.name(); });

// ---- The comparison itself ----------------------------------------------------------------------

TEST(ImageComparison, BothTolerancesCount) {
    Image a(10, 10, 3);
    Image b = a;
    b.pixel(3, 4)[1] = 3.0f / 255.0f;
    const ImageDifference one = compare_display_images(a, b, {2, 0.0});
    EXPECT_EQ(one.max_difference, 3);
    EXPECT_DOUBLE_EQ(one.exceeding_fraction, 0.01);
    EXPECT_FALSE(one.passes({2, 0.009}));
    EXPECT_TRUE(one.passes({2, 0.01}));
    EXPECT_TRUE(compare_display_images(a, b, {3, 0.0}).passes({3, 0.0}));
    EXPECT_FALSE(compare_display_images(a, Image(10, 9, 3), {255, 1.0}).passes({255, 1.0}));
}

TEST(ImageComparison, EveryGoldenHasACase) {
    std::set<std::string> expected, found;
    for (const ImageSequence& sequence : image_sequences()) {
        for (const int frame : sequence.frames)
            expected.insert(golden_file(sequence.golden_name(frame)).filename());
    }
    for (const auto& entry : std::filesystem::directory_iterator(golden_file("any").parent_path())) {
        found.insert(entry.path().filename());
    }
    EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace tarn::test
