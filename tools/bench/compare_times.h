// Times of two runs against each other. The speed of a machine varies between runs, and the seeds of one run
// do not show by how much: what most passes share counts as the machine, what stands out from that as a
// change.
#pragma once

#include <vector>

#include "bench/finding.h"

namespace tarn {

// How the two runs differ if only the machine does.
struct MachineDrift {
    double factor = 1.0;        // by which frames took longer, the median over all cells
    double pass_scatter = 0.0;  // standard deviation of single passes around their cell's own factor, a share
};

// Adds a finding for the frame of each cell and, where it has at least three, for each of its passes. Cells
// of equal settings alone are looked at.
MachineDrift compare_times(const std::vector<CellPair>& pairs, std::vector<Finding>& findings);

}  // namespace tarn
