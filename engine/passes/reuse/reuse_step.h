// One step of reuse, as temporal and spatial steps share it: rays that its MIS weights ask for, their
// answers, and the merge, band of rows by band of rows so that the rays of a band fit a storage block.
#pragma once

#include <functional>

#include "passes/reflected_light.h"
#include "passes/reuse/samples.h"
#include "shared/interface/constants/reuse.h"

namespace tarn {

// Where a step reads and what is wanted of it.
struct ReuseInput {
    const GBuffer& gbuffer;
    const SampleSlot& slot;
    const Samples& samples;
    bool tests_samples = false;             // write the rays that test the merged samples
    const ReflectedLight* light = nullptr;  // write what all merged samples send to the viewer
    bool tests_carried_light = false;       // over time: ask again for the light that samples carry
};

struct ReuseKernel {
    ReuseShaders shaders;
    std::uint32_t rays_per_pixel = 0;  // that its weights ask for
    ReuseConstants constants;          // bands and rays are filled in by the step
    // Reads what only this step reads.
    std::function<void(PassRecorder&)> read = [](PassRecorder&) {};
};

Samples run_reuse_step(const FrameContext& frame, const ReuseKernel& kernel, const ReuseInput& input);

}  // namespace tarn
