// How light has changed, first half: one pixel of each cell takes two light samples, the one that its surface kept in the
// last frame and the one that it keeps now, and asks what each sends to it in this frame and sent in the last one.
//
// The samples are the same in both frames, and so the difference has no noise: 0 where nothing has changed, however the
// camera moves (the idea of Schied, Peters and Dachsbacher, "Gradient Estimation for Real-Time Adaptive Temporal
// Filtering", 2018; they shade last frame's random numbers again, which here the reservoirs stand for). The last frame's
// samples know of lights that went out, this frame's of lights that went on.
//
// TARN_ASK_RAYS: rays ask whether the samples were and are seen: where things move, and where nobody has asked before.
#define TARN_PREVIOUS_FRAME
#include "shared/interface/constants/light_changes.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "shared/math/shadow_ray.h"
#include "shared/math/light_sample.h"
#include "shared/math/reservoir.h"
#include "lib/previous_camera.glsl"
#include "lib/previous_lights.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform usamplerBuffer previous_reservoirs;
layout(binding = UNIT_PASS_B) uniform usamplerBuffer reservoirs;
layout(binding = 0, rgba32f) writeonly uniform image2D out_values;
#ifdef TARN_ASK_RAYS
layout(std430, binding = 0) writeonly buffer Rays { uvec4 out_rays[]; };
#endif

// Samples of light have no rows of their own.
LightSample load_sample(usamplerBuffer rows, ivec2 pixel) {
    return unpack_light_sample(
        texelFetch(rows, int(pixel_index(pixel) * (RESERVOIR_ROWS + LIGHT_SAMPLE_ROWS))).xyz);
}

bool is_sample(LightSample drawn) { return drawn.light != INVALID_INDEX; }

LightSample moved(LightSample drawn, bool to_previous) {
#ifdef TARN_LIGHT_HISTORY
    if (is_sample(drawn) && is_in_light_table(drawn)) drawn.light = remap_light(drawn.light, to_previous);
#endif
    return drawn;
}

float arriving(ShadingPoint point, IncidentLight light) {
    return luminance(light.value) * max(0.0f, dot(point.shading_normal, light.direction));
}

// What a sample sends to the point, now and in the last frame, and the rays that ask whether it arrives.
struct Comparison {
    float now;
    float before;
    RayRecord ray_now;
    RayRecord ray_before;
};

Comparison compare(ShadingPoint here, ShadingPoint there, LightSample present, LightSample previous,
                   uint pixel) {
    Comparison c = Comparison(0.0f, 0.0f, inactive_ray(), inactive_ray());
    if (is_sample(present)) {
        IncidentLight light = load_incident_light(present, here.position);
        c.now = arriving(here, light);
        if (c.now > 0.0f) c.ray_now = make_shadow_ray(here, light, load_light_error(present), pixel);
    }
    if (is_sample(previous)) {
        IncidentLight light = load_previous_incident_light(previous, there.position);
        c.before = arriving(there, light);
        if (c.before > 0.0f)
            c.ray_before = make_shadow_ray(there, light, load_previous_light_error(previous), pixel);
        c.ray_before.pixel |= RAY_PREVIOUS;
    }
    return c;
}

#ifdef TARN_ASK_RAYS
void store_ray(uint row, RayRecord ray) {
    uvec4 row0, row1;
    pack_ray(ray, row0, row1);
    out_rays[row] = row0;
    out_rays[row + 1u] = row1;
}

void store_rays(ivec2 cell, Comparison a, Comparison b) {
    uint row = (uint(cell.y) * cells_x + uint(cell.x)) * CHANGE_RAYS * RAY_ROWS;
    store_ray(row, a.ray_now);
    store_ray(row + RAY_ROWS, a.ray_before);
    store_ray(row + 2u * RAY_ROWS, b.ray_now);
    store_ray(row + 3u * RAY_ROWS, b.ray_before);
}
#endif

// Another pixel each frame.
ivec2 pick_pixel(ivec2 cell) {
    uint turn = frame_size.z * 7u % 16u;
    ivec2 pixel = cell * CHANGE_CELL + ivec2(turn % 4u, turn / 4u);
    return min(pixel, ivec2(frame_size.xy) - 1);
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (cell.x >= int(cells_x) || cell.y >= int(cells_y)) return;
    ivec2 pixel = pick_pixel(cell);
    Comparison kept = Comparison(0.0f, 0.0f, inactive_ray(), inactive_ray());
    Comparison fresh = kept;
    ShadingPoint here;
    if (load_shading_point(pixel, here)) {
        ShadingPoint there = here;
        there.position = previous_position(pixel);
        ivec2 before = ivec2(floor(find_previous_place(there.position)));
        if (all(greaterThanEqual(before, ivec2(0))) && all(lessThan(before, ivec2(frame_size.xy)))) {
            LightSample previous = load_sample(previous_reservoirs, before);
            kept = compare(here, there, moved(previous, false), previous, pixel_index(pixel));
        }
        LightSample present = load_sample(reservoirs, pixel);
        fresh = compare(here, there, present, moved(present, true), pixel_index(pixel));
    }
    imageStore(out_values, cell, vec4(kept.now, kept.before, fresh.now, fresh.before));
#ifdef TARN_ASK_RAYS
    store_rays(cell, kept, fresh);
#endif
}
