#include "compare_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/display.h"
#include "image_io/image_io.h"
#include "metrics/flip.h"
#include "metrics/ssim.h"

namespace tarn {
namespace {

Image linear_from_display(Image display) {
    for (float& value : display.values) value = decode_srgb(value);
    return display;
}

// Display values are finite even where radiance is not: what was left out of the sums is left out here as
// well.
void spoil_non_finite(Pair& pair) {
    for (std::size_t i = 0; i < pair.linear_reference.pixel_count(); ++i) {
        if (is_pixel_finite(pair.linear_reference, pair.linear_image, i)) continue;
        for (std::size_t c = 0; c < 3; ++c) pair.display_image.values[3 * i + c] = std::nanf("");
    }
}

double tile_mean(const Image& map, int left, int top, int side) {
    double sum = 0.0;
    std::size_t count = 0;
    for (int y = top; y < std::min(top + side, map.height); ++y) {
        for (int x = left; x < std::min(left + side, map.width); ++x) {
            const double value = *map.pixel(x, y);
            if (!std::isfinite(value)) continue;
            sum += value;
            ++count;
        }
    }
    return count == 0 ? std::nan("") : sum / double(count);
}

void print_row(const char* name, double value, const char* meaning) {
    fmt::print("{:<16} {:>12.6g}  {}\n", name, value, meaning);
}

}  // namespace

const std::vector<std::string>& compared_keys() {
    static const std::vector<std::string> keys = {
        "mse",  "rmse",      "rel_mse",  "rel_mse_trimmed", "rmspe", "mape",      "mean_ratio",
        "flip", "flip_tile", "flip_ldr", "flip_hdr",        "ssim",  "non_finite"};
    return keys;
}

bool is_png(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& letter : extension) letter = char(std::tolower(static_cast<unsigned char>(letter)));
    return extension == ".png";
}

Image load_picture(const std::filesystem::path& path) {
    return is_png(path) ? read_png(path) : read_radiance(path);
}

Pair prepare_pair(Image reference, Image image, bool is_radiance, std::optional<float> exposure_ev) {
    Pair pair;
    pair.is_radiance = is_radiance;
    if (!is_radiance) {
        pair.linear_reference = linear_from_display(reference);
        pair.linear_image = linear_from_display(image);
        pair.display_reference = std::move(reference);
        pair.display_image = std::move(image);
        return pair;
    }
    pair.exposure_ev = exposure_ev ? *exposure_ev : measuring_exposure_ev(reference);
    pair.scale = exposure_ev ? std::exp2(double(*exposure_ev)) : 1.0;
    pair.display_reference = display_from_radiance(reference, pair.exposure_ev);
    pair.display_image = display_from_radiance(image, pair.exposure_ev);
    pair.linear_reference = std::move(reference);
    pair.linear_image = std::move(image);
    return pair;
}

Comparison compare_pair(Pair& pair) {
    Comparison comparison;
    comparison.errors = compute_image_errors(pair.linear_reference, pair.linear_image, pair.scale);
    spoil_non_finite(pair);
    comparison.ssim = compute_ssim(pair.display_reference, pair.display_image);
    comparison.flip_map = compute_ldr_flip(pair.display_reference, pair.display_image);
    comparison.flip_ldr = mean_error(comparison.flip_map);
    if (pair.is_radiance) {
        comparison.flip_map = compute_hdr_flip(pair.linear_reference, pair.linear_image).map;
        comparison.flip_hdr = mean_error(comparison.flip_map);
    }
    comparison.flip = comparison.flip_hdr.value_or(comparison.flip_ldr);
    comparison.flip_tile = worst_tile(comparison.flip_map, FLIP_TILE_PX);
    return comparison;
}

double worst_tile(const Image& map, int side) {
    // Half a square at a time: else a thing on a corner of four squares would be a quarter of each.
    const int step = std::max(1, side / 2);
    double worst = std::nan("");
    for (int y = 0; y < map.height; y += step) {
        for (int x = 0; x < map.width; x += step) {
            const int left = std::max(0, std::min(x, map.width - side));
            const int top = std::max(0, std::min(y, map.height - side));
            worst = std::fmax(worst, tile_mean(map, left, top, side));  // which passes over NaN
        }
    }
    return worst;
}

void print_comparison(const Pair& pair, const Comparison& comparison) {
    const ImageErrors& errors = comparison.errors;
    fmt::print("{} x {} pixels, {} of them not finite and left out\n", pair.linear_reference.width,
               pair.linear_reference.height, errors.non_finite);
    if (!pair.is_radiance) {
        fmt::print("display values: linear metrics on decoded sRGB, white = 1\n");
    } else {
        fmt::print("linear metrics on radiance * {:g}; display metrics at {:+.3f} EV\n", pair.scale,
                   pair.exposure_ev);
    }
    print_row("mse", errors.mse, "Mean squared error: a few bright pixels decide it.");
    print_row("rmse", errors.rmse, "Root of mse, in units of radiance.");
    print_row("rel_mse", errors.rel_mse,
              "Squared error over squared reference + 0.01: dark and bright count alike.");
    print_row("rel_mse_trimmed", errors.rel_mse_trimmed,
              "rel_mse without the worst 0.1 % of pixels (fireflies).");
    print_row("rmspe", errors.rmspe, "Root mean square error in percent of the reference + 0.01.");
    print_row("mape", errors.mape, "Mean absolute error in percent of the reference + 0.01.");
    print_row("mean_ratio", errors.mean_ratio, "Energy: mean of the image over mean of the reference.");
    print_row("flip_ldr", comparison.flip_ldr,
              "Visible difference on a screen, 0 to 1 (67 pixels per degree).");
    if (comparison.flip_hdr) {
        print_row("flip_hdr", *comparison.flip_hdr, "Visible difference at the worst exposure, 0 to 1.");
    }
    print_row("flip_tile", comparison.flip_tile,
              pair.is_radiance ? "flip_hdr in the worst square of 16 x 16 pixels."
                               : "flip_ldr in the worst square of 16 x 16 pixels.");
    print_row("ssim", comparison.ssim, "Structural similarity of the displayed pictures, 1 for equal ones.");
}

nlohmann::ordered_json describe_comparison(const Pair& pair, const Comparison& comparison) {
    const ImageErrors& errors = comparison.errors;
    nlohmann::ordered_json json;
    json["width"] = pair.linear_reference.width;
    json["height"] = pair.linear_reference.height;
    json["non_finite"] = errors.non_finite;
    json["exposure_ev"] = pair.exposure_ev;
    json["mse"] = errors.mse;
    json["rmse"] = errors.rmse;
    json["rel_mse"] = errors.rel_mse;
    json["rel_mse_trimmed"] = errors.rel_mse_trimmed;
    json["rmspe"] = errors.rmspe;
    json["mape"] = errors.mape;
    json["mean_ratio"] = errors.mean_ratio;
    json["flip"] = comparison.flip;
    json["flip_tile"] = comparison.flip_tile;
    json["flip_ldr"] = comparison.flip_ldr;
    json["flip_hdr"] = comparison.flip_hdr ? nlohmann::ordered_json(*comparison.flip_hdr) : nullptr;
    json["ssim"] = comparison.ssim;
    json["linear_scale"] = pair.scale;
    return json;
}

}  // namespace tarn
