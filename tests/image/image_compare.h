// Compares a picture with its golden by two tolerances, and keeps what differs for a person to look at.
#pragma once

#include <filesystem>
#include <string>

#include "core/image.h"

namespace tarn::test {

// How far a picture may be from its golden. The reasons for each value stand in image_cases.cpp.
struct ImageTolerance {
    int max_difference = 0;         // of a channel, in steps of 8 bits
    double exceeding_fraction = 0;  // of the pixels, which may differ by more than that
};

struct ImageDifference {
    bool same_size = false;
    int max_difference = 0;         // of any channel of any pixel, in steps of 8 bits
    double exceeding_fraction = 0;  // of the pixels, beyond ImageTolerance::max_difference

    bool passes(const ImageTolerance& tolerance) const {
        return same_size && exceeding_fraction <= tolerance.exceeding_fraction;
    }
};

// The picture as a PNG file holds it.
Image round_to_8_bits(Image display);

// `expected` and `actual`: display-encoded RGB in [0, 1]; both are rounded to 8 bits first, as a PNG file
// does.
ImageDifference compare_display_images(const Image& expected, const Image& actual,
                                       const ImageTolerance& tolerance);

// Writes NAME_actual.png, NAME_expected.png and NAME_difference.png (absolute difference, eight times) into
// `folder` and returns a line that names them. Without an expected picture, or with one of another size, the
// last is left out.
std::string keep_difference(const std::filesystem::path& folder, const std::string& name,
                            const Image& expected, const Image& actual);

// "greatest difference 3 of 255, 0.02 % of the pixels beyond 2"
std::string describe(const ImageDifference& difference, const ImageTolerance& tolerance);

}  // namespace tarn::test
