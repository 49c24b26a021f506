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
    vec4 frame_camera_forward;  // w = near (perspective) or depth range (orthographic), metres
    uvec4 frame_size;           // width, height in pixels; frame number; seed
    uvec4 frame_lights;         // light count; environment width, height; RIS candidates
};

// Places in the counter buffer; names in Renderer::read_counters.
CONSTANT uint COUNTER_BAD_WEIGHT = 0u;     // candidate weights that were negative or not finite
CONSTANT uint COUNTER_BAD_RADIANCE = 1u;   // pixels whose radiance was not finite and became black
CONSTANT uint COUNTER_BAD_RESERVOIR = 2u;  // reservoirs emptied because their weight was not finite
CONSTANT uint COUNTER_COUNT = 3u;

SHARED_END
