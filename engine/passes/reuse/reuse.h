// Reuse as a whole: over time, over neighbours, and what the next frame may start from. Which samples these
// are, a stage of light says by its shaders.
#pragma once

#include "passes/reuse/reuse_step.h"

namespace tarn {

// A stage of light that reuses its samples.
struct ReuseStage {
    std::string name;  // "direct": of its values and passes
    const ReusePlan& plan;
    const ReuseSettings& settings;
    ReuseShaders temporal;
    ReuseShaders boiling_filter;
    ReuseShaders spatial;
    // In this frame reuse over time asks again whether the light that samples carry reaches them.
    bool tests_carried_light = false;
};

struct ReusedSamples {
    Samples samples;  // with the rays that test them, where the plan tests chosen samples and any were merged
    ReflectedLight light;  // of all merged samples, where the plan shades them all; else none
};

// Merges `fresh` with what `kept` has of the last frame, then with neighbours; leaves in `kept` what the next
// frame finds.
ReusedSamples reuse_samples(const FrameContext& frame, const ReuseStage& stage, const GBuffer& gbuffer,
                            const SampleSlot& slot, const Samples& fresh, History<KeptSamples>& kept);

}  // namespace tarn
