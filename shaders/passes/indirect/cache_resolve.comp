// Makes the cells that the next frame reads out of those of the last one and what this frame has added: one thread a
// bucket, so that nobody else writes there.
//
// A cell is a mean whose samples count less with every frame. A cell without a new sample for some time goes; a key that
// asked gets a free place, or that of the oldest cell that nobody has used for a while; where there is none it is turned
// away, and counted: the memory is bounded.
#include "shared/interface/constants/cache.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/counters.glsl"
#include "shared/math/packing.h"
#include "lib/indirect/world_cache.glsl"
#include "lib/indirect/cache_paths.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform usamplerBuffer cells;  // of the last frame
layout(binding = UNIT_PASS_B) uniform usamplerBuffer sums;
layout(std430, binding = 0) writeonly buffer Cells { uvec4 out_cells[]; };

// Frames after which samples count 1 / e. Longer: less noise, but the cache lags behind lamps that change.
const float CACHE_MEMORY = 8.0f;
const float CACHE_AGE_CAP = 128.0f;  // frames without a sample until a cell goes
const float CACHE_IDLE_AGE = 16.0f;  // until it must make room for a new one

struct Bucket {
    uint keys[CACHE_PLACES];
    CacheCell cells[CACHE_PLACES];
};

CacheCell new_cell() { return CacheCell(vec3(0.0f), 0.0f, 0.0f); }

Bucket load_bucket(int row) {
    Bucket b;
    for (int i = 0; i < int(CACHE_PLACES); ++i) {
        b.keys[i] = texelFetch(cells, row + i / 4)[i % 4];
        b.cells[i] = unpack_cache_cell(texelFetch(cells, row + int(CACHE_KEY_ROWS) + i));
    }
    return b;
}

// Sum of this frame, in W/m^2.
vec3 read_sum(uvec4 low, uvec4 high) { return (vec3(high.xyz) + vec3(low.xyz) * exp2(-32.0f)) * cache_unit; }

CacheCell age_cell(CacheCell cell, uvec4 low, uvec4 high) {
    float count = float(low[CACHE_COUNT]);
#ifdef TARN_PLANT_CACHE_NEVER_AGES
    float kept = cell.weight;
#else
    float kept = cell.weight * (1.0f - 1.0f / CACHE_MEMORY);
#endif
    float total = kept + count;
    if (count > 0.0f) {
        cell.irradiance = (cell.irradiance * kept + read_sum(low, high)) / total;
        cell.age = 0.0f;
    } else {
        cell.age += 1.0f;
    }
    cell.weight = total;
    return cell;
}

void let_in(inout Bucket b, uint asking) {
    int place = 0;
    float oldest = -1.0f;
    bool is_there = false;
    for (int i = 0; i < int(CACHE_PLACES); ++i) {
        float age = b.keys[i] == 0u ? 2.0f * CACHE_AGE_CAP : b.cells[i].age;
        is_there = is_there || b.keys[i] == asking;
        if (age > oldest) {
            oldest = age;
            place = i;
        }
    }
    if (asking == 0u || is_there) return;
    if (oldest < CACHE_IDLE_AGE) {
        count_event(COUNTER_CACHE_FULL);
        return;
    }
    b.keys[place] = asking;
    b.cells[place] = new_cell();
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    uint bucket = at.y * CACHE_BUCKETS_WIDE + at.x;
    if (at.x >= CACHE_BUCKETS_WIDE || bucket >= CACHE_BUCKETS) return;
    uint row = bucket * CACHE_BUCKET_ROWS;
    Bucket b = load_bucket(int(row));
    uint asking[CACHE_PLACES];
    for (uint i = 0u; i < CACHE_PLACES; ++i) {
        int first = int(sum_word(bucket, i) / 4u);
        uvec4 low = texelFetch(sums, first);
        uvec4 high = texelFetch(sums, first + 1);
        b.cells[i] = age_cell(b.cells[i], low, high);
        asking[i] = high[CACHE_ASKING - CACHE_HIGH];
#ifndef TARN_PLANT_CACHE_NEVER_AGES
        if (b.cells[i].age > CACHE_AGE_CAP) b.keys[i] = 0u;
#endif
    }
    for (uint i = 0u; i < CACHE_PLACES; ++i) let_in(b, asking[i]);
    out_cells[row] = uvec4(b.keys[0], b.keys[1], b.keys[2], b.keys[3]);
    out_cells[row + 1u] = uvec4(b.keys[4], b.keys[5], b.keys[6], b.keys[7]);
    for (uint i = 0u; i < CACHE_PLACES; ++i)
        out_cells[row + CACHE_KEY_ROWS + i] = pack_cache_cell(b.cells[i]);
}
