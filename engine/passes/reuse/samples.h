// Samples in reservoirs, one a pixel, as the steps of reuse hand them on. What a sample is, only the shaders
// know.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "frame/history.h"
#include "passes/frame_context.h"
#include "passes/gbuffer.h"

namespace tarn {

struct Samples {
    Rows reservoirs;  // RESERVOIR_ROWS and the rows of a sample, a pixel
    Rows rays;  // RAY_ROWS rows a pixel, shared with the CPU: they test the samples; null: nobody asked for
                // them
};

// One of the samples that a pixel takes in a frame, independent of the others: they differ in random numbers,
// or in the channel that their target looks at.
struct SampleSlot {
    std::uint32_t index = 0;  // of the frame's samples of each pixel
    std::size_t lane = 0;     // of the targets
    // Of the channels in the target (p-hat); w = 1: the target of light that arrives, not of what is
    // reflected.
    glm::vec4 target_weights;
    CoverageKey shadow_key;  // decides what its rays meet
};

// By which rules samples were weighed: those of other rules have other densities and are no history.
struct SampleMeaning {
    glm::vec4 target_weights;
    Mis mis;
    bool traces_in_mis;
    FinalVisibility final_visibility;
    bool drops_occluded;
    bool filters_boiling;
    int step_px;  // of which pixels they are

    bool operator==(const SampleMeaning&) const = default;
};

SampleMeaning meaning_of(const ReusePlan& plan, const glm::vec4& target_weights);

// What the next frame finds.
struct KeptSamples {
    Rows reservoirs;
    SampleMeaning meaning;
};

// The last frame's samples, where they were weighed by this frame's rules and the tracer can still answer
// what their weights ask for.
std::optional<Previous<KeptSamples>> find_previous(const FrameContext& frame, const ReusePlan& plan,
                                                   const History<KeptSamples>& history,
                                                   const glm::vec4& target_weights);

// The shaders of a stage that reuses: of one kind of sample.
struct ReuseShaders {
    std::string name;  // "direct/temporal": of the pass
    std::function<const Program&(ReuseRun run)> program;
    std::size_t sample_rows = 0;  // of a sample, behind those of its reservoir
};

}  // namespace tarn
