// Direct light, the part of THE FRAME between G-buffer and picture: candidates, reuse over time, reuse over
// space, visibility, shading.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "passes/direct/boiling_filter.h"
#include "passes/direct/brdf_candidates.h"
#include "passes/direct/candidates.h"
#include "passes/direct/light_tiles.h"
#include "passes/direct/shade.h"
#include "passes/direct/spatial.h"
#include "passes/direct/temporal.h"
#include "passes/visibility.h"

namespace tarn {

class DirectLight {
  public:
    DirectLight(ProgramLibrary& programs, int width_px, int height_px);

    // RGBA32F: emission and direct light, W sr^-1 m^-2. `direct.target_weights` is set here, channel by
    // channel where the settings ask for that.
    // `light_tree`: its rows, where the settings draw from it.
    const Texture2D& record(DirectFrame direct, const RowBuffer* light_tree);

    // Ends a frame: its reservoirs become the last frame's.
    void advance();

    // Rays since the last call, rejected ones of both kinds together.
    struct Rays {
        RayBatchResult shadow;
        std::uint64_t closest = 0;
    };
    Rays take_rays();

  private:
    // What a kept sample means: samples of another meaning have other densities.
    struct Meaning {
        explicit Meaning(const DirectFrame& direct);
        bool operator==(const Meaning&) const = default;

        glm::vec3 target_weights;
        Mis mis;
        bool traces_in_mis;
        SampleVisibility visibility;
        bool discard_occluded;
        bool filters_boiling;
    };

    // What one target keeps from frame to frame, and who wrote it.
    struct Lane {
        Lane(int width_px, int height_px);
        History<RowBuffer> reservoirs;
        std::optional<std::uint32_t> frame;
        std::optional<Meaning> meaning;
    };

    void record_sample(DirectFrame& direct, CandidateSources sources);
    void record_lane(const DirectFrame& direct, std::size_t lane, const CandidateSources& sources);
    CandidateSources find_sources(const DirectFrame& direct, const RowBuffer* light_tree);
    const RowBuffer& trace_brdf(const DirectFrame& direct);
    const RowBuffer& reuse(const DirectFrame& direct, Lane& lane, const Candidates& fresh);
    static bool has_past(const DirectFrame& direct, const Lane& lane);
    const RowBuffer& trace(const DirectFrame& direct, const std::string& name, const Buffer& rays);

    int width_px_;
    int height_px_;
    std::vector<Lane> lanes_;
    std::array<RowBuffer, 2> scratch_;  // between the steps of reuse
    std::optional<Texture2D> light_;    // of all samples of the last step, once that is asked for
    DirectCandidatesPass candidates_;
    InitialVisibilityPass initial_visibility_;
    std::unique_ptr<LightTilesPass> light_tiles_;  // these two once they are asked for
    std::unique_ptr<BrdfCandidatesPass> brdf_candidates_;
    ReuseStep reuse_step_;
    TemporalPass temporal_;
    BoilingFilterPass boiling_filter_;
    SpatialPass spatial_;
    VisibilityPass visibility_;
    DirectShadePass shade_;
    ProgramLibrary& programs_;
    Rays rays_;
};

}  // namespace tarn
