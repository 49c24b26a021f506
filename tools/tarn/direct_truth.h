// The reference for methods of direct light: path-traced, cached, without the pixels on silhouettes.
#pragma once

#include "bench/sequence.h"
#include "session.h"

namespace tarn {

// Direct light alone, through pixel centres, with random numbers that no method uses, lights drawn by the
// light tree; stops at Ctrl-C.
ReferenceSettings direct_truth_settings(int width_px, int height_px, const CameraRecord& camera, int spp);

// Renders it or finds it in the cache of the user.
ReferenceResult find_direct_reference(RenderSession& session, const ReferenceSettings& settings);

// The same, ready for comparisons. Throws Error when interrupted.
Truth find_direct_truth(RenderSession& session, const RenderOptions& options,
                        const ReferenceSettings& settings);

}  // namespace tarn
