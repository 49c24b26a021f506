// A radiance cache in world space: a hash grid whose cells hold the irradiance that arrives by way of other surfaces.
//
// Sources: Binder, Fricke and Keller, "Massively Parallel Path Space Filtering", 2019 (cells by position and normal, their
// size by the distance from the camera, a hash table whose entries are told apart by a checksum); NVIDIA's published
// description of SHaRC (a few paths a frame add to the cells, all others read them).
//
// What a cell keeps is irradiance, not radiance: it is multiplied by the albedo of the place that asks, so that textures
// stay sharp. It is by way of other surfaces alone: what lamps send to a place is sampled there afresh, in every frame,
// and keeps its shadows. Light of many bounces comes by feedback: a path that adds to a cell meets a further surface, and
// brings from there what lamps send to it and what the cache of the last frame knows of it.
//
// Cells have two sizes, and each path adds to a cell of both: a fine one without many samples leans on the coarse one.
//
// Same seed, same bits, whatever the order of threads: a frame reads the cells of the last one, adds to sums of integers,
// and asks for places by the greatest checksum; one thread for each bucket then makes the next cells of both
// (passes/indirect/cache_resolve.comp). In a bucket the search goes from place to place.
#include "shared/interface/radiance_cache.h"
#include "shared/math/random.h"

const int CACHE_SIZES = 2;
const float CACHE_COARSE = 4.0f;         // edge of a coarse cell over that of a fine one
const float CACHE_COARSE_WEIGHT = 4.0f;  // samples of a fine cell that all of a coarse one stand for at most

#ifdef TARN_SMALL_CACHE
const uint CACHE_BUCKETS_USED = 32u;  // of a test
#else
const uint CACHE_BUCKETS_USED = CACHE_BUCKETS;
#endif

struct CacheKey {
    uint bucket;
    uint checksum;  // never 0
    uint place;     // where it asks to be let in
};

// 2^floor(log2 x), to the bit.
float floor_to_power(float x) { return uintBitsToFloat(floatBitsToUint(x) & 0x7f800000u); }

// The cell of a place: its normal to about 30 degrees, its position moved off the surface, so that rounding does not
// spread a wall over two layers of cells. `size`: 0 is fine. After constants of a pass with `cache_cell_share`.
CacheKey find_cache_key(vec3 position, vec3 normal, int size) {
    float distance = max(length(position - frame_camera().position), 1e-20f);
    float edge = floor_to_power(distance * cache_cell_share) * (size == 0 ? 1.0f : CACHE_COARSE);
    vec2 square = encode_octahedral(normal);
    ivec2 facing = ivec2(floor(2.0f * square + 0.5f));
#ifdef TARN_PLANT_IGNORE_CACHE_NORMALS
    facing = ivec2(0);
    normal = vec3(0.0f);
#endif
    ivec3 cell = ivec3(floor(position / edge + 0.25f * normal));
    uint rest = (floatBitsToUint(edge) >> 23u) | uint(facing.x + 8) << 8u | uint(facing.y + 8) << 16u;
    uvec4 bits = hash_pcg4d(uvec4(cell, rest));
    return CacheKey(bits.x % CACHE_BUCKETS_USED, max(bits.y, 1u), bits.z % CACHE_PLACES);
}

struct CacheCell {
    vec3 irradiance;
    float weight;  // samples behind it, older ones count less; 0: none yet
    float age;     // frames since the last one
};

uvec4 pack_cache_cell(CacheCell c) {
    return uvec4(floatBitsToUint(c.irradiance), packHalf2x16(vec2(min(c.weight, 60000.0f), c.age)));
}

CacheCell unpack_cache_cell(uvec4 row) {
    vec2 weight_age = unpackHalf2x16(row.w);
    return CacheCell(uintBitsToFloat(row.xyz), weight_age.x, weight_age.y);
}

// Where `key` stands in its bucket; -1: nowhere.
int find_cache_place(usamplerBuffer cells, CacheKey key) {
    int row = int(key.bucket * CACHE_BUCKET_ROWS);
    uvec4 first = texelFetch(cells, row);
    uvec4 second = texelFetch(cells, row + 1);
    int place = -1;
    for (int i = 3; i >= 0; --i) {
        if (second[i] == key.checksum) place = 4 + i;
    }
    for (int i = 3; i >= 0; --i) {
        if (first[i] == key.checksum) place = i;
    }
    return place;
}

// Without weight where there is no such cell.
CacheCell load_cache_cell(usamplerBuffer cells, CacheKey key) {
    int place = find_cache_place(cells, key);
    CacheCell cell = unpack_cache_cell(
        texelFetch(cells, int(key.bucket * CACHE_BUCKET_ROWS + CACHE_KEY_ROWS) + max(place, 0)));
    cell.weight = place >= 0 ? cell.weight : 0.0f;
    return cell;
}

// Irradiance at a place by way of other surfaces, as the last frame knew it; 0 where it did not.
vec3 load_cached_irradiance(usamplerBuffer cells, vec3 position, vec3 normal) {
    CacheCell fine = load_cache_cell(cells, find_cache_key(position, normal, 0));
    CacheCell coarse = load_cache_cell(cells, find_cache_key(position, normal, 1));
    float share = min(coarse.weight, CACHE_COARSE_WEIGHT);
    return (fine.irradiance * fine.weight + coarse.irradiance * share) *
           ratio_or_zero(1.0f, fine.weight + share);
}
