// tarn compare REFERENCE IMAGE: every metric that needs two images, as a table and as JSON. With two folders:
// a verdict for each picture, for people and for CI services.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "compare_folders.h"
#include "compare_junit.h"
#include "compare_page.h"
#include "compare_pair.h"
#include "core/error.h"
#include "core/image.h"
#include "image_io/image_io.h"
#include "interrupt.h"
#include "metrics/heat_map.h"
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
    std::filesystem::path junit;
    std::filesystem::path html;
    std::optional<float> exposure_ev;
    std::vector<Limit> limits;
};

Pair load_pair(const CompareOptions& options) {
    const bool is_radiance = !is_png(options.reference);
    if (is_png(options.reference) != is_png(options.image)) {
        throw Error("{} and {}: a PNG compares only with a PNG, radiance only with radiance",
                    options.reference.string(), options.image.string());
    }
    if (options.exposure_ev && !is_radiance)
        throw Error("--exposure applies to radiance, {} is a PNG", options.reference.string());
    Image reference = load_picture(options.reference);
    Image image = load_picture(options.image);
    if (reference.width != image.width || reference.height != image.height) {
        throw Error("{} has {} x {} pixels, {} has {} x {}: only pictures of one size compare",
                    options.reference.string(), reference.width, reference.height, options.image.string(),
                    image.width, image.height);
    }
    return prepare_pair(std::move(reference), std::move(image), is_radiance, options.exposure_ev);
}

void run_pair(const CompareOptions& options) {
    if (!options.junit.empty() || !options.html.empty())
        throw UsageError("--junit and --html are for two folders; --json and --difference for two pictures");
    Pair pair = load_pair(options);
    const Comparison comparison = compare_pair(pair);
    const nlohmann::ordered_json json = describe_comparison(pair, comparison);
    if (!options.json.empty()) write_json(options.json, json);
    if (!options.difference.empty()) write_png(options.difference, heat_map(comparison.flip_map));
    print_comparison(pair, comparison);
    check_limits(json, options.limits);
}

// The number that decided, and its limit: the first that is beyond, or the first of all where none is.
void print_result(const FolderOptions& options, const PictureResult& result, std::size_t name_width) {
    std::string decided = result.message;
    if (result.measured.is_object()) {
        const Limit& limit = result.breaches.empty() ? options.limits.front() : result.breaches.front().limit;
        decided = fmt::format("{:<15} {:>12.6g}  {}", limit.key, result.measured.at(limit.key).get<double>(),
                              describe_limit(limit));
        if (result.breaches.size() > 1) decided += fmt::format(", and {} more", result.breaches.size() - 1);
    }
    fmt::print("{:<{}}  {:<10}  {}\n", result.name, name_width, verdict_name(result.verdict), decided);
    std::fflush(stdout);
}

std::vector<PictureResult> judge_pictures(const FolderOptions& options, const std::vector<PictureCase>& cases,
                                          ComparePage* page) {
    std::size_t name_width = 0;
    for (const PictureCase& picture : cases) name_width = std::max(name_width, picture.name.size());
    std::vector<PictureResult> results;
    for (const PictureCase& picture : cases) {
        if (interrupt_flag()) {
            throw Error("interrupted after {} of {} pictures; no report was written", results.size(),
                        cases.size());
        }
        SeenPictures seen;
        results.push_back(judge_case(options, picture, seen));
        if (page) page->add(results.back(), seen);
        print_result(options, results.back(), name_width);
    }
    return results;
}

void run_folders(const CompareOptions& options) {
    if (!options.difference.empty())
        throw UsageError("--difference is for two pictures; --html shows folders");
    FolderOptions folders{options.reference, options.image, options.exposure_ev, options.limits};
    if (folders.limits.empty()) folders.limits = default_limits();
    check_folders(folders);
    const std::vector<PictureCase> cases = find_cases(folders);
    std::optional<ComparePage> page;
    if (!options.html.empty()) page.emplace(options.html, folders);

    const std::vector<PictureResult> results = judge_pictures(folders, cases, page ? &*page : nullptr);
    if (!options.json.empty()) write_json(options.json, make_folder_json(folders, results));
    if (!options.junit.empty()) write_file(options.junit, make_junit(folders, results));
    if (page) page->write();
    fmt::print("{}\n", summarize(results));
    std::fflush(stdout);
    const std::size_t failures = count_failures(results);
    if (failures > 0)
        throw LimitPassed(fmt::format("{} of {} pictures did not pass", failures, results.size()));
}

void run_compare(const CompareOptions& options) {
    for (const std::filesystem::path& file : {options.json, options.difference, options.junit})
        check_output_folder(file);
    for (const std::filesystem::path& path : {options.reference, options.image}) {
        if (!std::filesystem::exists(path)) throw Error("{}: no such file or folder", path.string());
    }
    const bool is_folder = std::filesystem::is_directory(options.reference);
    if (is_folder != std::filesystem::is_directory(options.image)) {
        throw Error("{} is {}, {} is {}: a folder compares only with a folder", options.reference.string(),
                    is_folder ? "a folder" : "a file", options.image.string(),
                    is_folder ? "a file" : "a folder");
    }
    is_folder ? run_folders(options) : run_pair(options);
}

std::string describe_default_limits() {
    std::string text;
    for (const Limit& limit : default_limits())
        text += fmt::format(" {} {}={:g}", limit.is_greatest ? "--max" : "--min", limit.key, limit.value);
    return text;
}

}  // namespace

void add_compare_command(CLI::App& app) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand(
        "compare", "Measure an image against a reference, or a folder of images against a folder of goldens");
    command
        ->add_option("REFERENCE", options->reference,
                     "The reference: .exr, .hdr or .png; or a folder of goldens")
        ->required();
    command
        ->add_option(
            "IMAGE", options->image,
            "The picture under test, of the same kind and size; or a folder of pictures with the same "
            "paths in it")
        ->required();
    command->add_option("--json", options->json, "Write the numbers to this JSON file");
    command->add_option("--difference", options->difference,
                        "Two pictures: write the FLIP heat map to this PNG file");
    command->add_option("--junit", options->junit, "Two folders: write a JUnit report to this XML file");
    command->add_option(
        "--html", options->html,
        "Two folders: write a page into this folder (index.html) that shows what did not pass");
    command
        ->add_option("--exposure", options->exposure_ev,
                     "Scale radiance by 2^EV for all metrics, not PNGs; without it the linear metrics take "
                     "raw radiance and the "
                     "display metrics an exposure found from the reference")
        ->check(make_finite_range(MIN_EXPOSURE_EV, MAX_EXPOSURE_EV))
        ->type_name("EV");
    add_limit_options(*command, compared_keys(), options->limits);
    command->footer(
        fmt::format("Two folders: missing and extra pictures, and those of another size or kind, do not pass "
                    "either. Limits "
                    "hold for each picture.\nWithout --max and --min they are:{}\nflip is flip_hdr of "
                    "radiance and flip_ldr "
                    "of PNGs; flip_tile is its mean in the worst square of {} x {} pixels.",
                    describe_default_limits(), FLIP_TILE_PX, FLIP_TILE_PX));
    command->callback([options] { run_compare(*options); });
}

}  // namespace tarn
