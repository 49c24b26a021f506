// Draws the direction in which each pixel's path begins and writes the ray along it (lib/indirect/directions.glsl).
// TARN_BLUE_NOISE: by numbers that are blue over pixels and frames.
#include "shared/interface/constants/indirect.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/receiver.glsl"
#include "lib/indirect/directions.glsl"
#ifdef TARN_BLUE_NOISE
#include "lib/blue_noise.glsl"
#endif
#include "lib/pixel_group.glsl"

layout(std430, binding = 0) writeonly buffer Rays { uvec4 out_rays[]; };

// x decides between base and layer, y and z the direction.
vec3 draw_numbers(ivec2 pixel) {
    vec3 white = random4(pixel_key(pixel), DIMENSION_INDIRECT).xyz;
#ifdef TARN_BLUE_NOISE
    return vec3(white.x, blue_noise2(uvec2(pixel), frame_size.z, frame_size.w, DIMENSION_INDIRECT));
#else
    return white;
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    Receiver r;
    RayRecord ray = inactive_ray();
    if (load_receiver(pixel, r)) {
        vec3 local = sample_first_direction(r, draw_numbers(pixel));
        ray = leave_surface(r.point, from_local(r.frame, local), first_direction_pdf(r, local),
                            pixel_index(pixel));
    }
    uvec4 row0, row1;
    pack_ray(ray, row0, row1);
    uint row = pixel_index(pixel) * RAY_ROWS;
    out_rays[row] = row0;
    out_rays[row + 1u] = row1;
}
