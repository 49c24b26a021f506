// Light of many bounces for the price of one: what lies beyond the end of a path comes out of a cache of the
// last frame's light (shaders/lib/indirect/cached_light.glsl).
#pragma once

#include <optional>

#include "passes/gbuffer.h"
#include "passes/reflected_light.h"
#include "passes/reuse/samples.h"
#include "world/world.h"

namespace tarn {

// Cells of the hash grid (CACHE_BUCKET_ROWS rows a bucket). Its size is fixed: 1.3 MB for one frame's.
using CacheCells = Rows;

// What the paths of a frame may ask.
struct PathCache {
    IndirectCache kind = IndirectCache::OFF;  // WORLD: `cells`; SCREEN: `light`, of `surfaces`
    CacheCells cells;
    std::optional<Previous<Picture>> light;  // indirect light of the base, without its albedo
    std::optional<Previous<Surfaces>> surfaces;
};

// The cache of the plan's kind out of what the last frame kept; OFF where there is nothing to look back at.
PathCache find_path_cache(const FrameContext& frame, const GBuffer& gbuffer,
                          const std::optional<Previous<Picture>>& light,
                          const std::optional<Previous<CacheCells>>& cells);

// Edge of a fine cell of the grid over its distance from the camera, at most: small pictures have few paths,
// and need few cells.
float find_cell_share(const FrameContext& frame);

// Binds what lib/indirect/cached_light.glsl reads.
void read_path_cache(PassRecorder& pass, const PathCache& cache);

// W/m^2: the light of all lamps and the sky, spread over the scene's bounds. Sums in the cache count it.
double estimate_irradiance(const World& world);

struct CacheSources {
    CacheCells cells;
    const RowBuffer* light_tree = nullptr;  // null: lamps are drawn by power
    double typical_irradiance = 0.0;        // W/m^2
};

// Lets some of the pixels' paths, whose states are `path_states`, go on by one surface and add what they find
// to their cells. Returns the next frame's cells.
CacheCells update_cells(const FrameContext& frame, const SampleSlot& slot, const Rows& path_states,
                        const CacheSources& sources);

}  // namespace tarn
