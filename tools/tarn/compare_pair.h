// Two pictures measured against each other: every metric that needs two images.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "metrics/image_error.h"

namespace tarn {

// The side of the squares in which `flip_tile` looks for the worst place, in pixels.
inline constexpr int FLIP_TILE_PX = 16;

// A pair of pictures: linear for the sums, display-encoded for the eye.
struct Pair {
    Image linear_reference;
    Image linear_image;
    Image display_reference;
    Image display_image;
    bool is_radiance = true;  // false for PNG
    float exposure_ev = 0;    // of the display transform
    double scale = 1;         // of the linear metrics
};

struct Comparison {
    ImageErrors errors;
    Image flip_map;        // HDR-FLIP for radiance, LDR-FLIP for PNG
    double flip = 0;       // its mean
    double flip_tile = 0;  // its mean in the worst square of FLIP_TILE_PX
    double flip_ldr = 0;
    std::optional<double> flip_hdr;
    double ssim = 0;
};

// What may have a limit, as JSON names it.
const std::vector<std::string>& compared_keys();

// Whether a file is one by its name's ending, in either case.
bool is_png(const std::filesystem::path& path);

// Display values of a PNG, radiance of anything else. Throws Error naming the file.
Image load_picture(const std::filesystem::path& path);

// Pictures as load_picture gives them, of one size. Without an exposure the linear metrics take raw radiance
// and the display metrics an exposure found from the reference. PNGs have none.
Pair prepare_pair(Image reference, Image image, bool is_radiance, std::optional<float> exposure_ev);

// Spoils the display values of pixels that are not finite: they are left out of all metrics alike. Throws
// Error where no pixel is finite.
Comparison compare_pair(Pair& pair);

// The greatest mean of the finite pixels in any square of `side` pixels, at every half of a side; those at
// the right and the lower border are moved inwards, so that all are whole where the map is large enough. NaN
// where no pixel is finite.
double worst_tile(const Image& map, int side);

nlohmann::ordered_json describe_comparison(const Pair& pair, const Comparison& comparison);

void print_comparison(const Pair& pair, const Comparison& comparison);

}  // namespace tarn
