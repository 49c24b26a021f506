// Convergence: error against time, its slope, and which method reaches an error first.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "bench/sequence.h"

namespace tarn {

// Adds "curve" and "slope" to the description of a method, from the sequences of its seeds.
void add_curve(nlohmann::ordered_json& method, std::span<const SequenceMeasure> seeds, const Truth& truth);

struct TimedError {
    double ms = 0.0;
    double error = 0.0;
};

// What a curve says of one target. `ms` is set where the curve crosses it.
struct TimeToError {
    enum class Kind { CROSSED, FIRST_FRAME_IS_BETTER, NOT_REACHED } kind = Kind::NOT_REACHED;
    double ms = 0.0;  // FIRST_FRAME_IS_BETTER: of that frame; NOT_REACHED: of the whole curve
};

// When `curve` (times increasing) first falls to `error`, by straight lines over logarithms.
TimeToError find_time_to_error(std::span<const TimedError> curve, double error);

}  // namespace tarn
