// The benchmark's protocol for one scene: which sequences are rendered, in which order, and what they become.
#pragma once

#include <atomic>
#include <vector>

#include "bench/method.h"
#include "bench/sequence.h"
#include "bench/time_fit.h"
#include "bench/work_folder.h"

namespace tarn {

struct BenchPlan {
    std::vector<Method> methods;
    std::vector<double> budgets_ms;
    int seeds = 8;  // at least 3, so that bias can be told from noise
    std::uint32_t first_seed = 0;
    int frames = 32;      // of the convergence curves: a power of two
    bool moving = false;  // the camera arrives with the one frame that is measured: no curves
};

// One kind of picture: the sequence of the convergence curve, or what a budget pays for.
struct Cell {
    std::size_t method = 0;
    int budget = -1;  // index into budgets_ms; -1: the curve
    TimeFit fit;      // settings and number of frames
};

// All cells of a plan: calibrated, or as an earlier run of the same folder calibrated them. Renders a few
// frames of each method first, so that no shader is compiled later on.
std::vector<Cell> plan_cells(const BenchPlan& plan, FrameSource& source, const WorkFolder& work);

// Under which name the work folder keeps the sequence of a cell and a seed.
std::string unit_name(const Cell& cell, std::uint32_t seed);

// Measures a cell for seed number `k` of the plan, unless the work folder holds it. Throws Error where
// `cancel` is true.
void measure_cell(const BenchPlan& plan, const Cell& cell, int k, FrameSource& source, const Truth& truth,
                  const WorkFolder& work, const std::atomic<bool>& cancel);

// The same for every cell and seed: seed by seed, and within a seed method by method, so that a busy minute
// of the machine falls on all methods alike. Shows progress; what was done when `cancel` turned true is kept.
void measure_cells(const BenchPlan& plan, const std::vector<Cell>& cells, FrameSource& source,
                   const Truth& truth, const WorkFolder& work, const std::atomic<bool>& cancel);

}  // namespace tarn
