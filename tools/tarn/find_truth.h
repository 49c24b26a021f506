// The reference for methods: path-traced, cached, without the pixels on silhouettes.
#pragma once

#include "bench/sequence.h"
#include "session.h"

namespace tarn {

// Light of so many bounces (1: direct light alone), through pixel centres, with random numbers that no method
// uses, lights drawn by the light tree; stops at Ctrl-C.
ReferenceSettings truth_settings(int width_px, int height_px, const CameraRecord& camera, int spp,
                                 int bounces);

// Renders it or finds it in the cache of the user.
ReferenceResult find_reference(RenderSession& session, const ReferenceSettings& settings);

// The same, ready for comparisons. Throws Error when interrupted.
Truth find_truth(RenderSession& session, const RenderOptions& options, const ReferenceSettings& settings);

}  // namespace tarn
