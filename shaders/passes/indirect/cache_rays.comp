// Paths that add to the radiance cache, first step: from the first surfaces that some of the pixels' paths met, a ray each
// into the hemisphere, evenly by cosine. Places whose cells do not exist yet ask for one.
#include "shared/interface/constants/cache.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/receiver.glsl"
#include "lib/indirect/directions.glsl"
#include "lib/indirect/path_samples.glsl"
#include "lib/indirect/path_state.glsl"
#include "lib/indirect/world_cache.glsl"
#include "lib/indirect/cache_paths.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform usamplerBuffer in_path_states;
layout(binding = UNIT_PASS_B) uniform usamplerBuffer cells;  // of the last frame
layout(std430, binding = 0) writeonly buffer Rays { uvec4 out_rays[]; };
layout(std430, binding = 1) buffer Sums { uint sums[]; };

// Of those that ask for the same place in one frame the greatest checksum is heard; the others ask again.
void ask_for_place(CacheKey key) {
    atomicMax(sums[sum_word(key.bucket, key.place) + CACHE_ASKING], key.checksum);
}

RayRecord leave_place(PathSample path, PathPlace place, ivec2 pixel, uint index) {
    ShadingPoint point;
    point.position = place.position;
    point.position_error = place.error;
    point.geometric_normal = place.normal;
    point.shading_normal = place.normal;
    point.material = path.material;
    vec3 local = sample_cosine_hemisphere(random4(pixel_key(pixel), DIMENSION_CACHE).xy);
    return leave_surface(point, from_local(make_frame(place.normal), local), local.z, index);
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside_of_cache_paths(at)) return;
    uint index = cache_path_index(at);
    ivec2 pixel = cache_path_pixel(at);
    RayRecord ray = inactive_ray();
    if (!is_outside(pixel)) {
        PathSample path = load_path_state(in_path_states, pixel_index(pixel)).place;
        if (path.instance != INVALID_INDEX) {
            PathPlace place = load_place_at(path, 0u);
            ray = leave_place(path, place, pixel, index);
            for (int size = 0; size < CACHE_SIZES; ++size) {
                CacheKey key = find_cache_key(place.position, place.normal, size);
                if (find_cache_place(cells, key) < 0) ask_for_place(key);
            }
        }
    }
    uvec4 row0, row1;
    pack_ray(ray, row0, row1);
    out_rays[index * RAY_ROWS] = row0;
    out_rays[index * RAY_ROWS + 1u] = row1;
}
