// Paths that add to the radiance cache, last step: each adds the irradiance that it found to its cells.
//
// Sums are integers of 64 bits in two words, so that they do not depend on the order of threads. What is not finite stays
// out, and is counted.
#include "shared/interface/constants/cache.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/indirect/path_samples.glsl"
#include "lib/indirect/path_state.glsl"
#include "lib/indirect/world_cache.glsl"
#include "lib/indirect/cache_paths.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform usamplerBuffer in_path_states;
layout(binding = UNIT_PASS_B) uniform usamplerBuffer cells;  // of the last frame
layout(binding = UNIT_PASS_C) uniform usamplerBuffer in_samples;
layout(binding = UNIT_PASS_D) uniform samplerBuffer answers;
layout(std430, binding = 0) buffer Sums { uint sums[]; };

// `value` counts the unit; the low word counts its 2^-32.
void add_to_sum(uint word, float value) {
    float whole = floor(value);
    uint low = uint((value - whole) * 4294967296.0f);
    uint before = atomicAdd(sums[word], low);
    bool carries = before + low < before;
    atomicAdd(sums[word + CACHE_HIGH], uint(whole) + (carries ? 1u : 0u));
}

void add_sample(uint word, vec3 irradiance) {
    if (!is_finite3(irradiance)) {
        count_event(COUNTER_BAD_CACHE);
        return;
    }
    vec3 units = max(irradiance, vec3(0.0f)) / cache_unit;
    if (max_component(units) > cache_limit) count_event(COUNTER_CACHE_CLAMPED);
    units = min(units, vec3(cache_limit));
    for (uint channel = 0u; channel < 3u; ++channel) add_to_sum(word + channel, units[channel]);
    atomicAdd(sums[word + CACHE_COUNT], 1u);
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    ivec2 pixel = cache_path_pixel(at);
    if (is_outside_of_cache_paths(at) || is_outside(pixel)) return;
    PathSample path = load_path_state(in_path_states, pixel_index(pixel)).place;
    if (path.instance == INVALID_INDEX) return;
    uint index = cache_path_index(at);
    int row = int(index * CACHE_SAMPLE_ROWS);
    vec3 irradiance = row_xyz(texelFetch(in_samples, row)) +
                      row_xyz(texelFetch(in_samples, row + 1)) * texelFetch(answers, int(index)).x;
#ifdef TARN_PLANT_NOT_A_NUMBER
    if (index % 7u == 0u) irradiance.x = uintBitsToFloat(0x7fc00000u);
#endif
    PathPlace place = load_place_at(path, 0u);
    for (int size = 0; size < CACHE_SIZES; ++size) {
        CacheKey key = find_cache_key(place.position, place.normal, size);
        int found = find_cache_place(cells, key);
        if (found >= 0) add_sample(sum_word(key.bucket, uint(found)), irradiance);
    }
}
