// The shared functions behind one door each, four words in rows to one row: compiled as GLSL and as C++ and
// compared.
#pragma once

#include "shared/interface/records.h"
#include "shared/math/alias_table.h"
#include "shared/math/blue_noise.h"
#include "shared/math/brdf.h"
#include "shared/math/environment.h"
#include "shared/math/light.h"
#include "shared/math/random.h"
#include "shared/math/reservoir.h"
#include "shared/math/texture_filter.h"
#include "shared/math/warp.h"

SHARED_BEGIN

CONSTANT uint KERNEL_HASH = 0u;
CONSTANT uint KERNEL_RANDOM = 1u;
CONSTANT uint KERNEL_INTEGERS = 2u;
CONSTANT uint KERNEL_FOOTPRINT_INDICES = 3u;
CONSTANT uint KERNEL_FOOTPRINT_WEIGHTS = 4u;
CONSTANT uint KERNEL_OCTAHEDRAL = 5u;
CONSTANT uint KERNEL_RESERVOIR = 6u;
CONSTANT uint KERNEL_LIGHT_RECORD = 7u;
CONSTANT uint KERNEL_TRIANGLE_LIGHT = 8u;
CONSTANT uint KERNEL_PUNCTUAL_LIGHT = 9u;
CONSTANT uint KERNEL_CAMERA_RAY = 10u;
CONSTANT uint KERNEL_BRDF = 11u;
CONSTANT uint KERNEL_BRDF_SAMPLE = 12u;
CONSTANT uint KERNEL_SKY_DIRECTION = 13u;
CONSTANT uint KERNEL_SKY_UV = 14u;
CONSTANT uint KERNEL_ALIAS = 15u;
CONSTANT uint KERNEL_FRAME = 16u;
CONSTANT uint KERNEL_BLUE_NOISE = 17u;
CONSTANT uint KERNEL_BRDF_PARTS = 18u;

FN uvec4 run_integers(uvec4 a, uvec4 b) {
    RandomKey key;
    key.pixel = b.x;
    key.frame = b.y;
    key.seed = b.z;
    return uvec4(multiply_high(a.x, a.y), uniform_index(a.z, a.w),
                 floatBitsToUint(random_coverage(key, b.w & 63u, a.x, a.y)),
                 uint(is_finite(uintBitsToFloat(a.z))));
}

FN TexelFootprint run_footprint(uvec4 a, uvec4 b) {
    vec2 uv = vec2(uintBitsToFloat(a.x), uintBitsToFloat(a.y));
    return texel_footprint(uv, ivec2(int(b.x), int(b.y)), b.z, b.w, a.z != 0u);
}

FN uvec4 run_reservoir(uvec4 a, uvec4 b) {
    vec3 weights = row_xyz(a);
    vec3 u = row_xyz(b);
    LiveReservoir live = empty_live_reservoir();
    uint chosen = INVALID_INDEX;
    uint sound = 0u;
    for (int i = 0; i < 3; ++i) {
        uint offer = offer_candidate(live, float(i + 1), weights[i], u[i]);
        if (offer == OFFER_TAKEN) chosen = uint(i);
        if (offer != OFFER_BAD) sound |= 1u << uint(i);
    }
    Reservoir done = finish_reservoir(live, 3.0f);
    return uvec4(chosen, sound, floatBitsToUint(live.weight_sum), floatBitsToUint(done.contribution_weight));
}

FN uvec4 run_light_record(uvec4 a, uvec4 b, uvec4 c, uvec4 d) {
    uvec4 row0;
    uvec4 row1;
    uvec4 row2;
    uvec4 row3;
    pack_light(unpack_light(a, b, c, d), row0, row1, row2, row3);
    return row0 + row1 * 3u + row2 * 5u + row3 * 7u;
}

FN uvec4 pack_incident(IncidentLight incident) {
    return pack_row4(vec4(incident.value.x, incident.distance, incident.direction.x, incident.direction.z));
}

FN uvec4 run_triangle_light(uvec4 a, uvec4 b, uvec4 c, uvec4 d) {
    Light light = unpack_light(a, b, c, d);
    light.flags = LIGHT_TRIANGLE | LIGHT_DOUBLE_SIDED;
    return pack_incident(incident_from_triangle(light, vec2(0.25f, 0.5f), vec3(2.0f), light.radiance));
}

FN uvec4 run_punctual_light(uvec4 a, uvec4 b, uvec4 c, uvec4 d) {
    Light light = unpack_light(a, b, c, d);
    light.flags = LIGHT_SPOT;
    light.edge1 = normalize(light.edge1);
    light.edge2 = vec3(2.0f, 0.5f, 0.0f);
    light.range = 4.0f;
    return pack_incident(incident_from_punctual(light, vec3(0.1f, 0.2f, 0.3f)));
}

FN uvec4 run_camera_ray(uvec4 a, uvec4 b, uvec4 c, uvec4 d) {
    CameraRecord camera;
    camera.position = row_xyz(a);
    camera.right = row_xyz(b);
    camera.up = row_xyz(c);
    camera.forward = row_xyz(d);
    camera.orthographic = (a.w & 1u) != 0u;
    PixelRay ray =
        camera_ray(camera, vec2(float(b.w & 1023u) + 0.5f, float(c.w & 511u) + 0.5f), vec2(1024.0f, 512.0f));
    return pack_row4(vec4(ray.direction.x, ray.direction.y, ray.direction.z, ray.origin.x));
}

// a, b: view and light; c: (alpha, albedo, f0); d: random numbers.
FN SurfaceMaterial kernel_material(uvec4 c) {
    vec3 factors = row_xyz(c);
    SurfaceMaterial m;
    m.diffuse_albedo = vec3(factors.y);
    m.f0 = vec3(factors.z);
    m.f90 = 1.0f;
    m.alpha = max(factors.x, MIN_ALPHA);
    return m;
}

FN uvec4 run_brdf(uvec4 a, uvec4 b, uvec4 c) {
    SurfaceMaterial m = kernel_material(c);
    vec3 view = row_xyz(a);
    vec3 light = row_xyz(b);
    return pack_row4(vec4(evaluate_brdf(m, view, light).x, pdf_brdf_solid_angle(m, view, light),
                          layer_probability(m, view), fresnel_schlick(m.f0, m.f90, view.z).x));
}

FN uvec4 run_brdf_parts(uvec4 a, uvec4 b, uvec4 c) {
    SurfaceMaterial m = kernel_material(c);
    BrdfValue parts = evaluate_brdf_parts(m, row_xyz(a), row_xyz(b));
    LayerAlbedo albedo = evaluate_layer_albedo(fit_layer(m.alpha), row_xyz(a).z);
    return pack_row4(vec4(parts.diffuse.x, parts.specular.x, albedo.loss, albedo.fresnel));
}

FN uvec4 run_sky_direction(uvec4 a, uvec4 b) {
    uint width = 4096u;
    uint height = 2048u;
    uint row = b.w % height;
    vec3 u = row_xyz(b);
    vec3 direction = environment_direction(a.w % width, row, width, height, vec2(u.x, u.y));
    return pack_row4(vec4(direction, environment_texel_solid_angle(row, width, height)));
}

FN uvec4 run_alias(uvec4 a, uvec4 b) {
    DiscreteSample drawn = resolve_alias(unpack_alias_bucket(a), 7u, uintBitsToFloat(b.x));
    return uvec4(drawn.index, floatBitsToUint(drawn.pmf), 0u, 0u);
}

// Stands for the mask.
FN uint fetch_blue_noise(uint index) {
    return hash_pcg4d(uvec4(index)).x;
}

#include "shared/scene/blue_noise.h"

// a: pixel, frame, seed; b: dimension.
FN uvec4 run_blue_noise(uvec4 a, uvec4 b) {
    uvec2 pixel = uvec2(a.x, a.y);
    vec2 numbers = blue_noise2(pixel, a.z, a.w, b.x);
    return uvec4(blue_noise_texel(blue_noise_shift(a.z, a.w, b.x), pixel, a.z), floatBitsToUint(numbers.x),
                 floatBitsToUint(numbers.y), floatBitsToUint(blue_noise1(pixel, a.z, a.w, b.x)));
}

FN uvec4 run_kernel(uint kernel, uvec4 a, uvec4 b, uvec4 c, uvec4 d) {
    RandomKey key;
    key.pixel = a.x;
    key.frame = a.y;
    key.seed = a.z;
    if (kernel == KERNEL_HASH) return hash_pcg4d(a);
    if (kernel == KERNEL_RANDOM) return pack_row4(random4(key, a.w));
    if (kernel == KERNEL_INTEGERS) return run_integers(a, b);
    if (kernel == KERNEL_FOOTPRINT_INDICES) return run_footprint(a, b).indices;
    if (kernel == KERNEL_FOOTPRINT_WEIGHTS) return pack_row4(run_footprint(a, b).weights);
    if (kernel == KERNEL_OCTAHEDRAL) return pack_row(decode_octahedral(encode_octahedral(row_xyz(a))), 0u);
    if (kernel == KERNEL_RESERVOIR) return run_reservoir(a, b);
    if (kernel == KERNEL_LIGHT_RECORD) return run_light_record(a, b, c, d);
    if (kernel == KERNEL_TRIANGLE_LIGHT) return run_triangle_light(a, b, c, d);
    if (kernel == KERNEL_PUNCTUAL_LIGHT) return run_punctual_light(a, b, c, d);
    if (kernel == KERNEL_CAMERA_RAY) return run_camera_ray(a, b, c, d);
    if (kernel == KERNEL_BRDF) return run_brdf(a, b, c);
    if (kernel == KERNEL_BRDF_PARTS) return run_brdf_parts(a, b, c);
    if (kernel == KERNEL_BRDF_SAMPLE)
        return pack_row(sample_brdf(kernel_material(c), row_xyz(a), row_xyz(d)), 0u);
    if (kernel == KERNEL_SKY_DIRECTION) return run_sky_direction(a, b);
    if (kernel == KERNEL_SKY_UV) return pack_row4(vec4(environment_uv(row_xyz(a)), 0.0f, 0.0f));
    if (kernel == KERNEL_ALIAS) return run_alias(a, b);
    if (kernel == KERNEL_BLUE_NOISE) return run_blue_noise(a, b);
    Frame frame = make_frame(row_xyz(a));
    return pack_row(to_local(frame, row_xyz(b)), 0u);
}

SHARED_END
