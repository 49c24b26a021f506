#include "compare_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report.h"
#include "compare_junit.h"
#include "compare_pair.h"
#include "core/display.h"
#include "core/error.h"
#include "core/version.h"
#include "image_io/image_io.h"
#include "markup.h"
#include "metrics/heat_map.h"
#include "output/output_files.h"

namespace tarn {
namespace {

namespace fs = std::filesystem;

// Smaller pictures are shown with their pixels as squares.
constexpr int SMALL_WIDTH_PX = 400;

bool lies_within(const fs::path& folder, const fs::path& outer) {
    const fs::path inside = fs::weakly_canonical(folder).lexically_relative(fs::canonical(outer));
    return !inside.empty() && *inside.begin() != "..";
}

// The error that the heat map shows in its last colour: the least of a few steps that covers 99 % of the
// pixels, so that faint differences are seen, and scales can be compared.
float choose_scale(const Image& flip_map) {
    std::vector<float> values;
    for (const float value : flip_map.values) {
        if (std::isfinite(value)) values.push_back(value);
    }
    if (values.empty()) return 1.0f;
    const auto high = values.begin() + std::ptrdiff_t(double(values.size() - 1) * 0.99);
    std::nth_element(values.begin(), high, values.end());
    for (const float step : {0.1f, 0.25f, 0.5f}) {
        if (*high <= step) return step;
    }
    return 1.0f;
}

// One exposure for both, found from the golden: else a picture that is too bright would look right.
float choose_exposure(const FolderOptions& options, const SeenPictures& seen) {
    if (options.exposure_ev) return *options.exposure_ev;
    for (const SeenPicture* picture : {&seen.expected, &seen.actual}) {
        if (picture->is_radiance && !picture->image.empty()) return auto_exposure_ev(picture->image);
    }
    return 0.0f;
}

// A picture of the row: written as PNG, shown with its caption.
std::string show(const fs::path& folder, const std::string& file, const std::string& caption,
                 const Image& display) {
    create_folder((folder / file).parent_path());
    write_png(folder / file, display);
    const std::string url = escape_url(file);
    return fmt::format(
        "<figure><figcaption>{}</figcaption><a href=\"{}\"><img{} src=\"{}\" width=\"{}\" height=\"{}\" "
        "alt=\"{}\" "
        "loading=\"lazy\"></a></figure>\n",
        escape_markup(caption), url, display.width < SMALL_WIDTH_PX ? " class=\"small\"" : "", url,
        display.width, display.height, escape_markup(caption));
}

std::string show_seen(const fs::path& folder, const std::string& name, const char* role,
                      const SeenPicture& seen, float exposure_ev) {
    const std::string file = fmt::format("pictures/{}.{}.png", name, role);
    if (seen.image.empty()) return "";
    if (!seen.is_radiance) return show(folder, file, role, seen.image);
    return show(folder, file, fmt::format("{}, at {:+.2f} EV", role, exposure_ev),
                display_from_radiance(seen.image, exposure_ev));
}

std::string show_map(const fs::path& folder, const std::string& name, const Image& flip_map) {
    if (flip_map.empty()) return "";
    const float scale = choose_scale(flip_map);
    Image scaled = flip_map;
    for (float& value : scaled.values) value /= scale;
    return show(folder, fmt::format("pictures/{}.flip.png", name),
                fmt::format("FLIP, black 0 to yellow {:g}", scale), heat_map(scaled));
}

std::string show_value(const nlohmann::ordered_json& value) {
    return value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : "&ndash;";
}

// The values that have limits.
std::string make_limit_table(const FolderOptions& options, const PictureResult& result) {
    if (!result.measured.is_object()) return "";
    std::string rows;
    for (const Limit& limit : options.limits) {
        const bool is_beyond =
            std::any_of(result.breaches.begin(), result.breaches.end(), [&](const Breach& breach) {
                return breach.limit.key == limit.key && breach.limit.is_greatest == limit.is_greatest &&
                       breach.limit.value == limit.value;
            });
        rows += fmt::format("<tr><td>{}</td><td{}>{}</td><td>{}</td></tr>\n", limit.key,
                            is_beyond ? " class=\"mark\"" : "", show_value(result.measured.at(limit.key)),
                            describe_limit(limit));
    }
    return "<div class=\"scroll\"><table><tr><th>value</th><th>measured</th><th>allowed</th></tr>\n" + rows +
           "</table></div>\n";
}

std::string make_value_list(const PictureResult& result) {
    if (!result.measured.is_object()) return "";
    std::string rows;
    for (const auto& [key, value] : result.measured.items())
        rows += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", key, show_value(value));
    return "<details><summary>All numbers</summary><div class=\"scroll\"><table>\n" + rows +
           "</table></div></details>\n";
}

std::string make_passed_list(const FolderOptions& options, const std::vector<PictureResult>& results) {
    std::string head = "<tr><th>picture</th>", rows;
    for (const Limit& limit : options.limits)
        head += fmt::format("<th>{}<br>{}</th>", limit.key, describe_limit(limit));
    for (const PictureResult& result : results) {
        if (result.verdict != Verdict::PASSED) continue;
        rows += "<tr><td>" + escape_markup(result.name) + "</td>";
        for (const Limit& limit : options.limits)
            rows += "<td>" + show_value(result.measured.at(limit.key)) + "</td>";
        rows += "</tr>\n";
    }
    if (rows.empty()) return "";
    return fmt::format(
        "<details class=\"passed\"><summary>{} passed</summary><div "
        "class=\"scroll\"><table>{}</tr>\n{}</table></div>"
        "</details>\n",
        results.size() - count_failures(results), head, rows);
}

}  // namespace

ComparePage::ComparePage(const fs::path& folder, const FolderOptions& options)
    : folder_(folder), options_(options) {
    for (const fs::path& compared : {options.goldens, options.actual}) {
        if (!lies_within(folder, compared)) continue;
        throw Error("{}: lies within {}: the page's pictures would be compared the next time",
                    folder.string(), compared.string());
    }
    create_folder(folder);
}

void ComparePage::add(const PictureResult& result, const SeenPictures& seen) {
    results_.push_back(result);
    if (result.verdict == Verdict::PASSED) return;
    const float exposure_ev = choose_exposure(options_, seen);
    failures_ +=
        fmt::format("<section>\n<h2>{} <span class=\"mark\">{}</span></h2>\n<p>{}</p>\n<div class=\"row\">\n",
                    escape_markup(result.name), verdict_name(result.verdict), escape_markup(result.message));
    failures_ += show_seen(folder_, result.name, "expected", seen.expected, exposure_ev);
    failures_ += show_seen(folder_, result.name, "actual", seen.actual, exposure_ev);
    failures_ += show_map(folder_, result.name, seen.flip_map);
    failures_ += "</div>\n" + make_limit_table(options_, result) + make_value_list(result) + "</section>\n";
}

void ComparePage::write() const {
    const std::size_t failures = count_failures(results_);
    const std::string title = failures == 0
                                  ? std::string("All pictures passed")
                                  : fmt::format("{} of {} pictures did not pass", failures, results_.size());
    std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
    page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    page += fmt::format("<title>{}</title>\n<style>\n{}{}</style>\n</head>\n<body>\n", title,
                        load_page_part("page.css"), load_page_part("compare.css"));
    page += fmt::format(
        "<header><h1>{}</h1>\n<p class=\"quiet\">{}, compared with {}. {}.</p></header>\n<main>\n", title,
        escape_markup(options_.actual.string()), escape_markup(options_.goldens.string()),
        summarize(results_));
    page += failures_ + make_passed_list(options_, results_);
    page +=
        "</main>\n<footer class=\"quiet\"><p>FLIP is the difference that a person sees when the two pictures "
        "alternate, 0 to 1; flip_tile is its mean in the worst square of 16 x 16 pixels. Cyan: pixels that "
        "are "
        "not finite. ";
    static_assert(FLIP_TILE_PX == 16, "the sentence above and that of print_comparison say so");
    page += escape_markup(describe_program()) + "</p></footer>\n</body>\n</html>\n";
    write_file(folder_ / "index.html", page);
}

}  // namespace tarn
