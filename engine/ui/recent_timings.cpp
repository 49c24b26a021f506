#include "ui/recent_timings.h"

namespace tarn {

void RecentTimings::add(const FrameTimings& timings) {
    frames_.push_back(timings);
    if (frames_.size() > limit_) frames_.pop_front();
}

FrameTimings RecentTimings::medians() const {
    TimingLog log;
    for (const FrameTimings& frame : frames_) log.add(frame);
    return {log.frame_quantile_ms(0.5), log.pass_medians()};
}

}  // namespace tarn
