// tarn compare REFERENCE IMAGE: every metric that needs two images, as a table and as JSON.
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "core/display.h"
#include "core/error.h"
#include "core/image.h"
#include "image_io/image_io.h"
#include "metrics/flip.h"
#include "metrics/heat_map.h"
#include "metrics/image_error.h"
#include "metrics/ssim.h"
#include "output/output_files.h"
#include "scene_options.h"
#include "verdict.h"

namespace tarn {
namespace {

struct CompareOptions {
    std::filesystem::path reference;
    std::filesystem::path image;
    std::filesystem::path json;
    std::filesystem::path difference;
    std::optional<float> exposure_ev;
    std::vector<Limit> limits;
};

// What may have a limit, as JSON names it.
const std::vector<std::string> KEYS = {"mse",      "rmse", "rel_mse",    "rel_mse_trimmed",
                                       "rmspe",    "mape", "mean_ratio", "flip_ldr",
                                       "flip_hdr", "ssim", "non_finite"};

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
    Image flip_map;  // what --difference shows: HDR-FLIP for radiance, LDR-FLIP for PNG
    double flip_ldr = 0;
    std::optional<double> flip_hdr;
    double ssim = 0;
};

bool is_png(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& letter : extension) letter = char(std::tolower(static_cast<unsigned char>(letter)));
    return extension == ".png";
}

Image linear_from_display(Image display) {
    for (float& value : display.values) value = decode_srgb(value);
    return display;
}

void check_same_size(const CompareOptions& options, const Image& reference, const Image& image) {
    if (reference.width == image.width && reference.height == image.height) return;
    throw Error("{} has {} x {} pixels, {} has {} x {}: only pictures of one size compare",
                options.reference.string(), reference.width, reference.height, options.image.string(),
                image.width, image.height);
}

Pair load_pngs(const CompareOptions& options) {
    if (options.exposure_ev)
        throw Error("--exposure applies to radiance, {} is a PNG", options.reference.string());
    Pair pair;
    pair.is_radiance = false;
    pair.display_reference = read_png(options.reference);
    pair.display_image = read_png(options.image);
    check_same_size(options, pair.display_reference, pair.display_image);
    pair.linear_reference = linear_from_display(pair.display_reference);
    pair.linear_image = linear_from_display(pair.display_image);
    return pair;
}

Pair load_radiance(const CompareOptions& options) {
    Pair pair;
    pair.linear_reference = read_radiance(options.reference);
    pair.linear_image = read_radiance(options.image);
    check_same_size(options, pair.linear_reference, pair.linear_image);
    pair.exposure_ev =
        options.exposure_ev ? *options.exposure_ev : measuring_exposure_ev(pair.linear_reference);
    pair.scale = options.exposure_ev ? std::exp2(double(*options.exposure_ev)) : 1.0;
    pair.display_reference = display_from_radiance(pair.linear_reference, pair.exposure_ev);
    pair.display_image = display_from_radiance(pair.linear_image, pair.exposure_ev);
    return pair;
}

Pair load_pair(const CompareOptions& options) {
    if (is_png(options.reference) != is_png(options.image)) {
        throw Error("{} and {}: a PNG compares only with a PNG, radiance only with radiance",
                    options.reference.string(), options.image.string());
    }
    return is_png(options.reference) ? load_pngs(options) : load_radiance(options);
}

// Display values are finite even where radiance is not: what was left out of the sums is left out here as
// well.
void spoil_non_finite(Pair& pair) {
    for (std::size_t i = 0; i < pair.linear_reference.pixel_count(); ++i) {
        if (is_pixel_finite(pair.linear_reference, pair.linear_image, i)) continue;
        for (std::size_t c = 0; c < 3; ++c) pair.display_image.values[3 * i + c] = std::nanf("");
    }
}

Comparison compare(Pair& pair) {
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
    return comparison;
}

void print_row(const char* name, double value, const char* meaning) {
    fmt::print("{:<16} {:>12.6g}  {}\n", name, value, meaning);
}

void print_table(const Pair& pair, const Comparison& comparison) {
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
    print_row("ssim", comparison.ssim, "Structural similarity of the displayed pictures, 1 for equal ones.");
}

nlohmann::ordered_json make_json(const Pair& pair, const Comparison& comparison) {
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
    json["flip_ldr"] = comparison.flip_ldr;
    json["flip_hdr"] = comparison.flip_hdr ? nlohmann::ordered_json(*comparison.flip_hdr) : nullptr;
    json["ssim"] = comparison.ssim;
    json["linear_scale"] = pair.scale;
    return json;
}

void run_compare(const CompareOptions& options) {
    check_output_folder(options.json);
    check_output_folder(options.difference);
    Pair pair = load_pair(options);
    const Comparison comparison = compare(pair);
    const nlohmann::ordered_json json = make_json(pair, comparison);
    if (!options.json.empty()) write_json(options.json, json);
    if (!options.difference.empty()) write_png(options.difference, heat_map(comparison.flip_map));
    print_table(pair, comparison);
    check_limits(json, options.limits);
}

}  // namespace

void add_compare_command(CLI::App& app) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand("compare", "Measure an image against a reference");
    command->add_option("REFERENCE", options->reference, "The reference: .exr, .hdr or .png")->required();
    command->add_option("IMAGE", options->image, "The picture under test, of the same kind and size")
        ->required();
    command->add_option("--json", options->json, "Write the numbers to this JSON file");
    command->add_option("--difference", options->difference, "Write the FLIP heat map to this PNG file");
    command
        ->add_option(
            "--exposure", options->exposure_ev,
            "Scale radiance by 2^EV for all metrics; without it the linear metrics take raw radiance and the "
            "display metrics an exposure found from the reference")
        ->check(make_finite_range(MIN_EXPOSURE_EV, MAX_EXPOSURE_EV))
        ->type_name("EV");
    add_limit_options(*command, KEYS, options->limits);
    command->callback([options] { run_compare(*options); });
}

}  // namespace tarn
