#include "bench/compare_times.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/statistics.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

// Of a pass between two runs, roughly: below it a longer pass is worth no more than a shorter one.
constexpr double TYPICAL_SCATTER = 0.05;
// By which any time varies, however short: threads wake up sooner or later.
constexpr double TIME_JITTER_MS = 0.05;

// Logarithms of one time, one a seed, before and after.
struct TimeSeries {
    std::string name;
    std::vector<double> before;
    std::vector<double> after;

    double change() const { return quantile(after, 0.5) - quantile(before, 0.5); }
    // By which it varies whatever it does, as a logarithm.
    double jitter() const { return TIME_JITTER_MS / std::exp(quantile(before, 0.5)); }
    // What it is worth among others.
    double weight() const { return 1.0 / (jitter() * jitter() + TYPICAL_SCATTER * TYPICAL_SCATTER); }
};

struct Weighted {
    double value = 0.0;
    double weight = 1.0;
};

// Where half of the weight lies below.
double weighted_median(std::vector<Weighted> values) {
    std::sort(values.begin(), values.end(),
              [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    double total = 0.0, below = 0.0;
    for (const Weighted& v : values) total += v.weight;
    for (const Weighted& v : values) {
        below += v.weight;
        if (below >= 0.5 * total) return v.value;
    }
    return 0.0;
}

// All times of one cell. Its passes ran side by side, so a busy machine slowed them alike.
struct CellTimes {
    std::vector<TimeSeries> passes;
    TimeSeries frame;
    double factor = 0.0;  // logarithm of how much longer its passes took on the whole

    // Fewer cannot tell which of them changed.
    bool judges_passes() const { return passes.size() >= 3; }
};

std::vector<double> logarithms(const Json& times) {
    std::vector<double> logs = per_seed(times);
    for (double& value : logs) value = std::log(std::max(value, 1e-6));
    return logs;
}

CellTimes collect_times(const CellPair& pair) {
    CellTimes times;
    for (const Json& pass : pair.after->at("passes")) {
        for (const Json& old : pair.before->at("passes")) {
            if (old.at("name") != pass.at("name")) continue;
            times.passes.push_back({pair.name + ": pass " + pass.at("name").get<std::string>(),
                                    logarithms(old.at("ms")), logarithms(pass.at("ms"))});
        }
    }
    times.frame = {pair.name + ": frame", logarithms(pair.before->at("frame_ms")),
                   logarithms(pair.after->at("frame_ms"))};
    return times;
}

// Takes off each seed's share of slowness: the median over the passes of how far they lie above their own
// medians then.
void remove_slow_seeds(std::vector<TimeSeries>& series, std::vector<double> TimeSeries::*side) {
    std::size_t seeds = series.empty() ? 0 : (series.front().*side).size();
    for (const TimeSeries& s : series) seeds = std::min(seeds, (s.*side).size());
    std::vector<double> medians;
    for (const TimeSeries& s : series) medians.push_back(quantile(s.*side, 0.5));
    for (std::size_t seed = 0; seed < seeds; ++seed) {
        std::vector<Weighted> above;
        for (std::size_t i = 0; i < series.size(); ++i)
            above.push_back({(series[i].*side)[seed] - medians[i], series[i].weight()});
        const double slowness = weighted_median(std::move(above));
        for (TimeSeries& s : series) (s.*side)[seed] -= slowness;
    }
}

double median_change(const std::vector<TimeSeries>& series) {
    std::vector<Weighted> changes;
    for (const TimeSeries& s : series) changes.push_back({s.change(), s.weight()});
    return weighted_median(std::move(changes));
}

// Cells of equal settings alone: another number of candidates takes another time.
std::vector<CellTimes> collect_cells(const std::vector<CellPair>& pairs) {
    std::vector<CellTimes> cells;
    for (const CellPair& pair : pairs) {
        // First frame and mean of frames are the same sequence.
        if (pair.after->at("kind") == "first" || pair.before->at("settings") != pair.after->at("settings"))
            continue;
        CellTimes times = collect_times(pair);
        if (times.judges_passes()) {
            remove_slow_seeds(times.passes, &TimeSeries::before);
            remove_slow_seeds(times.passes, &TimeSeries::after);
            times.factor = median_change(times.passes);
        } else {
            times.factor = times.frame.change();
        }
        cells.push_back(std::move(times));
    }
    return cells;
}

constexpr double NORMAL_SD_PER_MAD = 1.4826;  // standard deviation over median absolute deviation

// What is known of the scatter before a comparison is made: passes of equal work differ by so much between
// two runs on a machine that nobody else uses (standard deviation of logarithms), as if so many passes had
// shown it.
constexpr double EXPECTED_SCATTER = 0.02;
constexpr double EXPECTED_SCATTER_FREEDOM = 8.0;

// How numbers scatter around a centre that was found as their median.
struct Scatter {
    double deviation = 0.0;  // standard deviation, if they are normal but for a few
    double degrees_of_freedom = 0.0;
};

Scatter find_scatter(std::vector<Weighted> residuals, std::size_t centres) {
    for (Weighted& residual : residuals) residual.value = std::abs(residual.value);
    const double count = double(residuals.size()), freedom = count - double(centres);
    if (freedom <= 0.0) return {};
    return {NORMAL_SD_PER_MAD * weighted_median(std::move(residuals)) * std::sqrt(count / freedom), freedom};
}

// What was found and what was expected, by their degrees of freedom: a handful of passes alone says little of
// how far the next one may stray (the moderated t-statistic of Smyth 2004, section 3).
Scatter moderate(const Scatter& found) {
    const double freedom = EXPECTED_SCATTER_FREEDOM + found.degrees_of_freedom;
    const double variance = (EXPECTED_SCATTER_FREEDOM * EXPECTED_SCATTER * EXPECTED_SCATTER +
                             found.degrees_of_freedom * found.deviation * found.deviation) /
                            freedom;
    return {std::sqrt(variance), freedom};
}

// How the two runs differ where nothing but the machine does.
struct Drift {
    double factor = 0.0;  // logarithm: median over all cells
    Scatter cells;        // of cells around it
    Scatter passes;       // of passes around their cell
};

Drift find_drift(const std::vector<CellTimes>& cells) {
    Drift drift;
    std::vector<double> factors;
    std::vector<Weighted> cell_residuals, pass_residuals;
    for (const CellTimes& cell : cells) factors.push_back(cell.factor);
    drift.factor = quantile(factors, 0.5);
    std::size_t judging = 0;
    for (const CellTimes& cell : cells) {
        cell_residuals.push_back({cell.factor - drift.factor});
        if (!cell.judges_passes()) continue;
        ++judging;
        for (const TimeSeries& s : cell.passes)
            pass_residuals.push_back({s.change() - cell.factor, s.weight()});
    }
    drift.cells = find_scatter(std::move(cell_residuals), 1);
    drift.passes = find_scatter(std::move(pass_residuals), judging);
    return drift;
}

// Where the seeds of a run lie, and how surely. A machine that does something else for a moment spoils a seed
// or two: the median does not mind.
struct Middle {
    double value = 0.0;
    double variance = 0.0;  // of the value, were the seeds normal but for a few
};

Middle find_middle(const std::vector<double>& seeds) {
    const double median = quantile(seeds, 0.5);
    std::vector<double> distances;
    for (const double value : seeds) distances.push_back(std::abs(value - median));
    const double deviation = NORMAL_SD_PER_MAD * quantile(std::move(distances), 0.5);
    return {median, 0.5 * std::numbers::pi * deviation * deviation / double(seeds.size())};
}

// How likely a time moves so far from `factor` by chance. Seeds tell how it varies within a run; between runs
// caches, clocks and neighbours are others, which no seed knows of: `found` tells that.
Finding judge_time(const TimeSeries& s, double factor, const Scatter& found) {
    const Scatter scatter = moderate(found);
    const Middle before = find_middle(s.before), after = find_middle(s.after);
    Finding finding{s.name, std::exp(before.value), std::exp(after.value - factor), 1.0, true};
    finding.is_worse = finding.after > finding.before;
    const double variance =
        before.variance + after.variance + scatter.deviation * scatter.deviation + s.jitter() * s.jitter();
    if (found.degrees_of_freedom > 0.0) {  // else the machine's part in it is not known
        finding.p_value = student_t_two_sided_p_value(
            std::log(finding.after / finding.before) / std::sqrt(variance), scatter.degrees_of_freedom);
    }
    return finding;
}

}  // namespace

MachineDrift compare_times(const std::vector<CellPair>& pairs, std::vector<Finding>& findings) {
    const std::vector<CellTimes> cells = collect_cells(pairs);
    const Drift drift = find_drift(cells);
    for (const CellTimes& cell : cells) {
        findings.push_back(judge_time(cell.frame, drift.factor, drift.cells));
        if (!cell.judges_passes()) continue;
        for (const TimeSeries& s : cell.passes) findings.push_back(judge_time(s, cell.factor, drift.passes));
    }
    return {std::exp(drift.factor), drift.passes.deviation};
}

}  // namespace tarn
