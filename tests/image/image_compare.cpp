#include "image/image_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image_io/image_io.h"

namespace tarn::test {
namespace {

int to_8_bits(float value) {
    return int(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

bool have_same_size(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.channels == b.channels;
}

Image exaggerated_difference(const Image& expected, const Image& actual) {
    Image difference(actual.width, actual.height, 3);
    for (std::size_t i = 0; i < difference.values.size(); ++i) {
        difference.values[i] = std::min(1.0f, 8.0f * std::abs(expected.values[i] - actual.values[i]));
    }
    return difference;
}

}  // namespace

Image round_to_8_bits(Image display) {
    for (float& value : display.values) value = float(to_8_bits(value)) / 255.0f;
    return display;
}

ImageDifference compare_display_images(const Image& expected, const Image& actual,
                                       const ImageTolerance& tolerance) {
    ImageDifference result;
    result.same_size = have_same_size(expected, actual);
    if (!result.same_size) return result;
    std::size_t exceeding = 0;
    for (std::size_t pixel = 0; pixel < actual.pixel_count(); ++pixel) {
        int worst = 0;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            worst = std::max(worst, std::abs(to_8_bits(expected.values[i]) - to_8_bits(actual.values[i])));
        }
        result.max_difference = std::max(result.max_difference, worst);
        if (worst > tolerance.max_difference) ++exceeding;
    }
    result.exceeding_fraction = double(exceeding) / double(actual.pixel_count());
    return result;
}

std::string keep_difference(const std::filesystem::path& folder, const std::string& name,
                            const Image& expected, const Image& actual) {
    std::filesystem::create_directories(folder);
    const auto file = [&](const char* what) { return folder / fmt::format("{}_{}.png", name, what); };
    write_png(file("actual"), actual);
    std::string kept = file("actual").string();
    if (!expected.empty()) {
        write_png(file("expected"), expected);
        kept += ", " + file("expected").string();
    }
    if (have_same_size(expected, actual)) {
        write_png(file("difference"), exaggerated_difference(expected, actual));
        kept += ", " + file("difference").string();
    }
    return "look at " + kept;
}

std::string describe(const ImageDifference& difference, const ImageTolerance& tolerance) {
    if (!difference.same_size) return "another size";
    return fmt::format("greatest difference {} of 255, {:.3f} % of the pixels beyond {}",
                       difference.max_difference, 100.0 * difference.exceeding_fraction,
                       tolerance.max_difference);
}

}  // namespace tarn::test
