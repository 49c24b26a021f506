// What all passes know of the frame: one uniform block (std140: every member is a vec4 or uvec4).
#pragma once

#include "shared/dialect.h"
#include "shared/interface/bindings.h"

SHARED_BEGIN

#ifdef TARN_GLSL
layout(std140, binding = BLOCK_FRAME) uniform FrameBlock {
#else
struct FrameBlock {
#endif
    vec4 frame_camera_position;  // relative to the world's origin; w = 1 for an orthographic camera
    vec4 frame_camera_right;
    vec4 frame_camera_up;
    vec4 frame_camera_forward;     // w = near (perspective) or depth range (orthographic), metres
    uvec4 frame_size;              // width, height in pixels of what passes work on; frame number; seed
    uvec4 frame_lights;            // light count; environment width, height; 0
    vec4 frame_previous_position;  // the last frame's camera, as above
    vec4 frame_previous_right;
    vec4 frame_previous_up;
    vec4 frame_previous_forward;
    uvec4
        frame_history;   // first previous instance; first row of the previous lights; first row of the light
                         // remap or INVALID_INDEX where every light kept its index; 1 where materials changed
    vec4 frame_jitter;   // where in a pixel its ray goes through, from the centre, pixels: this frame (x, y),
                         // the last one (z, w)
    uvec4 frame_tables;  // nodes of the light tree; first rows of the light lookup by instance and by slot; 0
    uvec4 frame_full;  // width, height of the picture in pixels; step: its pixels from one pixel that passes
                       // work on to the next (1: the same); 0
    uvec4 frame_offset;  // which pixel of its step x step block each of them is: this frame (x, y), the last
                         // one (z, w)
};

// Places in the counter buffer; names in Renderer::read_counters.
CONSTANT uint COUNTER_BAD_WEIGHT = 0u;     // candidate weights that were negative or not finite
CONSTANT uint COUNTER_BAD_RADIANCE = 1u;   // pixels whose radiance was not finite and became black
CONSTANT uint COUNTER_BAD_RESERVOIR = 2u;  // reservoirs emptied because their weight was not finite
CONSTANT uint COUNTER_BAD_HISTORY = 3u;  // reservoirs of the last frame that were not finite and were dropped
CONSTANT uint COUNTER_MIS_SUM = 4u;      // samples whose MIS weights did not sum to 1 (TARN_CHECK_MIS alone)
CONSTANT uint COUNTER_COARSE_GAP = 5u;   // pixels whose surface no coarse pixel near shows
CONSTANT uint COUNTER_BAD_LIGHT =
    6u;  // pixels whose light the denoiser dropped: not finite, negative, or far above all around them
CONSTANT uint COUNTER_BAD_LIGHT_HISTORY = 7u;  // pixels of the denoiser's history that were not finite
CONSTANT uint COUNTER_BAD_CACHE = 8u;          // cached light, or light for the cache, that was not finite
CONSTANT uint COUNTER_CACHE_CLAMPED = 9u;      // light for the cache beyond what its sums can count
CONSTANT uint COUNTER_CACHE_FULL = 10u;        // places for which the cache had no cell left
CONSTANT uint COUNTER_BAD_PICTURE =
    11u;  // samples kept out of the picture of the last frames: unusable, or far above all around
CONSTANT uint COUNTER_COUNT = 12u;

SHARED_END
