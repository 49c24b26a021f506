// Draws a direction from each pixel's BRDF and writes the ray along it: where it meets a light, that is a candidate
// which light sampling alone would seldom find (mirrors, glossy floors).
#include "shared/interface/constants/candidates.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/receiver.glsl"
#include "lib/pixel_group.glsl"

layout(std430, binding = 0) writeonly buffer Rays { uvec4 out_rays[]; };

RayRecord brdf_ray(ivec2 pixel, Receiver r) {
    RayRecord ray = inactive_ray();
    vec4 u = random4(pixel_key(pixel), sample_index * DIMENSIONS_PER_SAMPLE + DIMENSION_BRDF);
    vec3 local = sample_brdf(r.point.material, r.brdf, u.xyz);
    vec3 direction = from_local(r.frame, local);
    if (!(pdf_brdf_solid_angle(r.point.material, r.brdf, local) > 0.0f)) return ray;
    if (dot(r.point.geometric_normal, direction) <= 0.0f) return ray;
    ray.origin =
        offset_ray_origin(r.point.position, r.point.position_error, r.point.geometric_normal, direction);
    ray.direction = direction;
    ray.max_t = RAY_INFINITY;
    ray.pixel = pixel_index(pixel);
    return ray;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    Receiver receiver;
    RayRecord ray = inactive_ray();
    if (load_receiver(pixel, receiver)) ray = brdf_ray(pixel, receiver);
    uvec4 row0, row1;
    pack_ray(ray, row0, row1);
    uint row = pixel_index(pixel) * RAY_ROWS;
    out_rays[row] = row0;
    out_rays[row + 1u] = row1;
}
