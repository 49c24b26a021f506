// How many threads work: TBB's limit on parallelism, for as long as a WorkerLimit lives.
#include <tbb/global_control.h>
#include <tbb/info.h>

#include "rays/ray_tracer.h"

namespace tarn {

struct WorkerLimit::State {
    tbb::global_control control;
};

WorkerLimit::WorkerLimit(int threads)
    : state_(new State{tbb::global_control(
          tbb::global_control::max_allowed_parallelism,
          threads > 0 ? std::size_t(threads) : std::size_t(tbb::info::default_concurrency()))}) {}

WorkerLimit::~WorkerLimit() = default;

}  // namespace tarn
