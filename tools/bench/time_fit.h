// Equal time: which value of a method's dial, how many frames or which resolution fill a budget of
// milliseconds.
#pragma once

#include <functional>

#include "bench/method.h"

namespace tarn {

struct TimeFit {
    RenderSettings settings;
    double resolution = 1.0;   // rendered width and height, as a share of the picture's
    int frames = 1;            // whose mean is the picture
    double expected_ms = 0.0;  // of all of them, as calibrated
};

// Times one frame with these settings at this resolution, ms: a median over a few, so that a hiccup does not
// decide.
using FrameTimer = std::function<double(const RenderSettings&, double resolution)>;

// The largest value of the method's dial whose frame fits `budget_ms`, by interpolation and trial; where even
// the dial's maximum leaves time for it, or the method has no dial, the number of frames nearest to the
// budget, at least one. A method whose cheapest frame exceeds the budget by more than a tenth renders fewer
// pixels, down to a quarter of the width and height.
TimeFit fit_budget(const Method& method, double budget_ms, const FrameTimer& time_frame_ms);

}  // namespace tarn
