// The lights that rays have met. After lib/scene_buffers.glsl.

// Words behind the rows of the lights, four a row (engine/passes/gpu_lights.h).
uint fetch_light_lookup(uint first_row, uint index) {
    return fetch_light_row(first_row + (index >> 2u))[index & 3u];
}
uint fetch_light_slot(uint instance) { return fetch_light_lookup(frame_tables.y, instance); }
uint fetch_light_of_slot(uint slot) { return fetch_light_lookup(frame_tables.z, slot); }

#include "shared/scene/light_hits.h"
