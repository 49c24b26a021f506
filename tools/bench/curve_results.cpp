#include "bench/curve_results.h"

#include <cmath>

#include "bench/results.h"
#include "core/statistics.h"
#include "metrics/seed_statistics.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

double mean_frame_ms(std::span<const SequenceMeasure> seeds) {
    RunningMoments ms;
    for (const SequenceMeasure& seed : seeds) {
        for (const double frame_ms : seed.frame_ms) ms.add(frame_ms);
    }
    return ms.mean();
}

Json describe(const Estimate& estimate) {
    return {{"mean", estimate.mean}, {"low", estimate.low}, {"high", estimate.high}};
}

template <class Get>
Estimate estimate_point(std::span<const SequenceMeasure> seeds, std::size_t point, const Get& get) {
    std::vector<double> values;
    for (const SequenceMeasure& seed : seeds) values.push_back(get(seed.curve[point]));
    return estimate_mean(values);
}

// Slope of the mean curve of all seeds but number `left_out`. The noise of the reference adds the same to
// every point, and is taken off.
double fit_slope(std::span<const SequenceMeasure> seeds, std::size_t left_out, double reference_mse) {
    std::vector<double> frames, errors;
    for (std::size_t point = 0; point < seeds.front().curve.size(); ++point) {
        RunningMoments mse;
        for (std::size_t seed = 0; seed < seeds.size(); ++seed) {
            if (seed != left_out) mse.add(seeds[seed].curve[point].mse);
        }
        frames.push_back(seeds.front().curve[point].frames);
        errors.push_back(mse.mean() - reference_mse);
    }
    return fit_power_law(frames, errors);
}

// With an interval by the jackknife over seeds. Time is proportional to frames, so the slope is the same.
// Null where one point makes no curve.
Json describe_slope(std::span<const SequenceMeasure> seeds, double reference_mse) {
    if (seeds.front().curve.size() < 2) return {{"mean", nullptr}, {"low", nullptr}, {"high", nullptr}};
    return describe(estimate_jackknife(
        seeds.size(), [&](std::size_t left_out) { return fit_slope(seeds, left_out, reference_mse); }));
}

std::vector<TimedError> read_curve(const Json& method) {
    std::vector<TimedError> curve;
    for (const Json& point : method.at("curve")) {
        curve.push_back({point.at("ms"), point.at("rel_mse").at("mean")});
    }
    return curve;
}

Json describe_time(const std::string& label, const TimeToError& time) {
    switch (time.kind) {
        case TimeToError::Kind::CROSSED:
            return {{"label", label}, {"ms", time.ms}, {"is", "reached"}};
        case TimeToError::Kind::FIRST_FRAME_IS_BETTER:
            return {{"label", label}, {"ms", time.ms}, {"is", "better from the first frame on"}};
        case TimeToError::Kind::NOT_REACHED:
            return {{"label", label}, {"ms", time.ms}, {"is", "not reached within the curve"}};
    }
    return {};
}

}  // namespace

void add_curve(Json& method, std::span<const SequenceMeasure> seeds, const Truth& truth) {
    const double frame_ms = mean_frame_ms(seeds);
    Json curve = Json::array();
    for (std::size_t i = 0; i < seeds.front().curve.size(); ++i) {
        const int frames = seeds.front().curve[i].frames;
        Json point = {{"frames", frames}, {"ms", frames * frame_ms}};
        point["mse"] = describe(estimate_point(seeds, i, [](const CurvePoint& p) { return p.mse; }));
        point["rel_mse"] = describe(estimate_point(seeds, i, [](const CurvePoint& p) { return p.rel_mse; }));
        point["rel_mse_trimmed"] =
            describe(estimate_point(seeds, i, [](const CurvePoint& p) { return p.rel_mse_trimmed; }));
        curve.push_back(std::move(point));
    }
    method["curve"] = std::move(curve);
    method["slope"] = describe_slope(seeds, std::exp2(2.0 * double(truth.exposure_ev)) * truth.mean_variance);
}

TimeToError find_time_to_error(std::span<const TimedError> curve, double error) {
    if (curve.front().error <= error) return {TimeToError::Kind::FIRST_FRAME_IS_BETTER, curve.front().ms};
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const TimedError &before = curve[i - 1], &after = curve[i];
        if (after.error > error) continue;
        if (after.error <= 0.0) return {TimeToError::Kind::CROSSED, after.ms};
        const double share = std::log(before.error / error) / std::log(before.error / after.error);
        return {TimeToError::Kind::CROSSED, before.ms * std::pow(after.ms / before.ms, share)};
    }
    return {TimeToError::Kind::NOT_REACHED, curve.back().ms};
}

Json describe_equal_error(const Json& methods) {
    const std::vector<TimedError> baseline = read_curve(methods.front());
    Json targets = Json::array();
    for (const std::size_t point : {std::size_t(0), baseline.size() / 2, baseline.size() - 1}) {
        Json target = {{"rel_mse", baseline[point].error}, {"times", Json::array()}};
        for (const Json& method : methods) {
            target["times"].push_back(describe_time(
                method.at("label"), find_time_to_error(read_curve(method), baseline[point].error)));
        }
        targets.push_back(std::move(target));
    }
    return {{"baseline", methods.front().at("label")}, {"targets", std::move(targets)}};
}

}  // namespace tarn
