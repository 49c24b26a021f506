#include "frame/timings.h"

#include "core/statistics.h"

namespace tarn {
void TimingLog::add(const FrameTimings& timings) {
    frame_ms_.push_back(timings.frame_ms);
    for (const PassTiming& pass : timings.passes) {
        if (!pass_ms_.contains(pass.name)) passes_.push_back(pass);
        pass_ms_[pass.name].push_back(pass.ms);
    }
}

double TimingLog::frame_quantile_ms(double q) const {
    return quantile(frame_ms_, q);
}

std::vector<PassTiming> TimingLog::pass_medians() const {
    std::vector<PassTiming> medians = passes_;
    for (PassTiming& pass : medians) pass.ms = quantile(pass_ms_.at(pass.name), 0.5);
    return medians;
}

}  // namespace tarn
