#include "recent_timings.h"

#include <algorithm>
#include <map>
#include <string>

namespace game {
namespace {

double compute_median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

double FrameCost::compute_tracing_ms() const {
    double ms = 0.0;
    for (const PassTime& pass : passes) ms += pass.traces_rays ? pass.ms : 0.0;
    return ms;
}

void RecentTimings::add(const FrameReport& report) {
    frames_.push_back({report.frame_ms, report.passes});
    if (frames_.size() > limit_) frames_.pop_front();
}

FrameCost RecentTimings::compute_medians() const {
    FrameCost medians;
    std::vector<double> frame_ms;
    std::map<std::string, std::vector<double>> pass_ms;
    for (const FrameCost& frame : frames_) {
        frame_ms.push_back(frame.frame_ms);
        for (const PassTime& pass : frame.passes) {
            std::vector<double>& values = pass_ms[pass.name];
            if (values.empty()) medians.passes.push_back(pass);
            values.push_back(pass.ms);
        }
    }
    medians.frame_ms = compute_median(std::move(frame_ms));
    for (PassTime& pass : medians.passes) pass.ms = compute_median(pass_ms[pass.name]);
    return medians;
}

}  // namespace game
