#include "bench/results.h"

#include <algorithm>
#include <cmath>

#include "bench/curve_results.h"
#include "bench/error_results.h"
#include "bench/file_names.h"
#include "core/display.h"
#include "core/error.h"
#include "core/statistics.h"
#include "core/version.h"
#include "image_io/image_io.h"
#include "metrics/flip.h"
#include "metrics/heat_map.h"
#include "metrics/seed_statistics.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

// One cell with all its seeds, looked at in one way: its first frames, or the means of its frames.
struct CellView {
    const char* kind;  // "first", "mean" or "budget"
    const Cell* cell;
    std::vector<SequenceMeasure> measures;  // one a seed
    std::vector<Image> pictures;            // one a seed
};

double total_ms(const SequenceMeasure& measure) {
    double sum = 0.0;
    for (const double ms : measure.frame_ms) sum += ms;
    return sum;
}

template <class Get>
std::vector<double> collect(const CellView& view, const Get& get) {
    std::vector<double> values;
    for (const SequenceMeasure& measure : view.measures) values.push_back(get(measure));
    return values;
}

bool is_first(const CellView& view) {
    return std::string_view(view.kind) == "first";
}

std::vector<PictureErrors> picture_errors(const CellView& view) {
    std::vector<PictureErrors> errors;
    for (const SequenceMeasure& measure : view.measures)
        errors.push_back(is_first(view) ? measure.first : measure.mean);
    return errors;
}

// Median and p95 over all frames, and the median of each seed.
Json describe_times(const std::vector<std::vector<double>>& seeds) {
    std::vector<double> all, medians;
    for (const std::vector<double>& seed : seeds) {
        all.insert(all.end(), seed.begin(), seed.end());
        medians.push_back(quantile(seed, 0.5));
    }
    return {{"median", quantile(all, 0.5)}, {"p95", quantile(all, 0.95)}, {"per_seed", medians}};
}

Json describe_passes(const CellView& view) {
    Json passes = Json::array();
    for (const PassSamples& first : view.measures.front().passes) {
        std::vector<std::vector<double>> seeds;
        for (const SequenceMeasure& measure : view.measures) {
            for (const PassSamples& pass : measure.passes) {
                if (pass.name == first.name) seeds.push_back(pass.ms);
            }
        }
        Json pass = {{"name", first.name}};
        pass["ms"] = describe_times(seeds);
        passes.push_back(std::move(pass));
    }
    return passes;
}

Json describe_counts(const CellView& view, std::size_t pixel_count) {
    std::uint64_t rays = 0, repeated = 0, non_finite = 0, frames = 0;
    std::map<std::string, std::uint64_t> dropped;
    for (const SequenceMeasure& measure : view.measures) {
        rays += measure.rays;
        repeated += std::uint64_t(measure.repeated_frames);
        non_finite += is_first(view) ? measure.first.linear.non_finite : measure.mean.linear.non_finite;
        frames += measure.frame_ms.size();
        for (const auto& [name, count] : measure.counters) dropped[name] += count;
    }
    Json counts = {{"rays_per_pixel", double(rays) / double(frames) / double(pixel_count)},
                   {"repeated_frames", repeated},
                   {"non_finite", non_finite}};
    for (const auto& [name, count] : dropped) counts[name] = count;
    return counts;
}

// The first seed's picture for the viewer, and where it differs.
Json write_pictures(const Truth& truth, const Image& radiance, const std::filesystem::path& folder,
                    const std::string& stem) {
    const Image display = display_from_radiance(radiance, truth.exposure_ev);
    write_exr(folder / (stem + ".exr"), radiance, {{"software", describe_program()}});
    write_png(folder / (stem + ".png"), display);
    write_png(folder / (stem + "_flip.png"), heat_map(compute_ldr_flip(truth.display, display)));
    return {{"display", stem + ".png"}, {"radiance", stem + ".exr"}, {"flip", stem + "_flip.png"}};
}

Json describe_view(const BenchPlan& plan, const CellView& view, const Truth& truth) {
    const Cell& cell = *view.cell;
    const std::vector<double> ms = collect(view, [&](const SequenceMeasure& m) {
        return is_first(view) ? quantile(m.frame_ms, 0.5) : total_ms(m);
    });
    Json json = {{"kind", view.kind}, {"budget_ms", nullptr}};
    if (cell.budget >= 0) json["budget_ms"] = plan.budgets_ms[std::size_t(cell.budget)];
    json["frames"] = is_first(view) ? 1 : cell.fit.frames;
    json["resolution"] = cell.fit.resolution;
    json["settings"] = describe_settings(cell.fit.settings);
    json["ms"] = {{"median", quantile(ms, 0.5)}, {"p95", quantile(ms, 0.95)}, {"per_seed", ms}};
    json["errors"] = describe_errors(picture_errors(view), truth);
    json["bias"] = describe_bias(view.pictures, truth);
    json["relative_bias"] = describe_relative_bias(view.pictures, truth);
    json["flicker"] = describe_values(collect(view, [](const SequenceMeasure& m) { return m.flicker; }));
    if (cell.budget < 0) {
        json["shared_samples"] =
            describe_values(collect(view, [](const SequenceMeasure& m) { return m.shared_samples; }));
    }
    json["counts"] = describe_counts(view, truth.radiance.pixel_count());
    json["frame_ms"] = describe_times([&] {
        std::vector<std::vector<double>> seeds;
        for (const SequenceMeasure& measure : view.measures) seeds.push_back(measure.frame_ms);
        return seeds;
    }());
    json["passes"] = describe_passes(view);
    return json;
}

SequenceMeasure load_or_fail(const WorkFolder& work, const std::string& name) {
    if (auto measure = work.load_measure(name)) return *std::move(measure);
    throw Error("{}: the sequence is missing", name);
}

CellView load_view(const BenchPlan& plan, const char* kind, const Cell& cell, const WorkFolder& work) {
    CellView view{kind, &cell, {}, {}};
    for (int k = 0; k < plan.seeds; ++k) {
        const std::string name = unit_name(cell, plan.first_seed + std::uint32_t(k));
        view.measures.push_back(load_or_fail(work, name));
        view.pictures.push_back(is_first(view) ? work.load_first(name) : work.load_mean(name));
    }
    return view;
}

}  // namespace

Json describe_settings(const RenderSettings& settings) {
    Json json;
    for (const Setting& setting : setting_table()) {
        if (setting.choices.empty()) {
            json[setting.name] = setting.get(settings);
        } else {
            json[setting.name] = setting.format(settings);
        }
    }
    return json;
}

Json describe_methods(const BenchPlan& plan, const std::vector<Cell>& cells, const Truth& truth,
                      const WorkFolder& work, const std::filesystem::path& picture_folder,
                      const std::string& picture_prefix) {
    Json methods = Json::array();
    for (std::size_t m = 0; m < plan.methods.size(); ++m) {
        const Method& method = plan.methods[m];
        Json json = {{"label", method.label},
                     {"sentence", method.sentence},
                     {"dial", method.dial},
                     {"warm_up_frames", method.warm_up_frames}};
        json["settings"] = describe_settings(method.settings);
        json["cells"] = Json::array();
        const auto add = [&](const char* kind, const Cell& cell) {
            const CellView view = load_view(plan, kind, cell, work);
            Json described = describe_view(plan, view, truth);
            const std::string stem = file_stem(fmt::format(
                "{}_{}_{}", picture_prefix, method.label,
                cell.budget < 0 ? kind : fmt::format("{:g}ms", plan.budgets_ms[std::size_t(cell.budget)])));
            described["pictures"] = write_pictures(truth, view.pictures.front(), picture_folder, stem);
            json["cells"].push_back(std::move(described));
            if (std::string_view(kind) == "mean") add_curve(json, view.measures, truth);
        };
        for (const Cell& cell : cells) {
            if (cell.method != m) continue;
            if (cell.budget < 0) {
                add("first", cell);
                add("mean", cell);
            } else {
                add("budget", cell);
            }
        }
        methods.push_back(std::move(json));
    }
    return methods;
}

Json describe_truth(const Truth& truth, const std::filesystem::path& picture_folder,
                    const std::string& picture_prefix) {
    const std::string stem = file_stem(picture_prefix + "_reference");
    write_exr(picture_folder / (stem + ".exr"), truth.picture, {{"software", describe_program()}});
    write_png(picture_folder / (stem + ".png"), display_from_radiance(truth.picture, truth.exposure_ev));
    return {{"spp", truth.spp},
            {"relative_error", truth.relative_error},
            {"mean_variance", std::exp2(2.0 * double(truth.exposure_ev)) * truth.mean_variance},
            {"noise_rel_mse", truth.noise_rel_mse},
            {"exposure_ev", truth.exposure_ev},
            {"left_out_pixels", truth.left_out},
            {"pictures", {{"display", stem + ".png"}, {"radiance", stem + ".exr"}}}};
}

}  // namespace tarn
