// The truth that methods of direct light are held against: path-traced, cached, pixels on silhouettes left
// out.
#pragma once

#include "bench/sequence.h"
#include "session.h"

namespace tarn {

// Direct light alone, through pixel centres, with random numbers that no method uses; stops at Ctrl-C.
ReferenceSettings direct_truth_settings(const RenderOptions& options, const CameraRecord& camera, int spp);

// Renders it or finds it in the cache of the user. Throws Error when interrupted.
Truth find_direct_truth(RenderSession& session, const RenderOptions& options,
                        const ReferenceSettings& settings);

}  // namespace tarn
