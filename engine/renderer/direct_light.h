// Direct light, the part of THE FRAME between G-buffer and picture: candidates, reuse over time, reuse over
// space, visibility, shading.
#pragma once

#include <array>
#include <vector>

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
    const Texture2D& record(DirectFrame direct);

    // Ends a frame: its reservoirs become the last frame's.
    void advance();

    // Shadow rays since the last call.
    RayBatchResult take_result();

  private:
    // What one target keeps from frame to frame.
    struct Lane {
        Lane(int width_px, int height_px);
        History<RowBuffer> reservoirs;
    };

    void record_lane(const DirectFrame& direct, std::size_t lane, const RowBuffer* tiles);
    const RowBuffer& reuse(const DirectFrame& direct, Lane& lane, const Candidates& fresh);
    const RowBuffer& trace(const DirectFrame& direct, const std::string& name, const Buffer& rays);

    int width_px_;
    int height_px_;
    std::vector<Lane> lanes_;
    std::array<RowBuffer, 2> scratch_;  // between the steps of reuse
    DirectCandidatesPass candidates_;
    InitialVisibilityPass initial_visibility_;
    std::unique_ptr<LightTilesPass> light_tiles_;  // once asked for
    ReuseStep reuse_step_;
    TemporalPass temporal_;
    SpatialPass spatial_;
    VisibilityPass visibility_;
    DirectShadePass shade_;
    ProgramLibrary& programs_;
    RayBatchResult result_;
};

}  // namespace tarn
