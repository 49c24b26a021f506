// What antialiasing knows of motion: where the past of a pixel is, and whether it may be wrong.
//
// The past is right where what the last frame saw there has come to the pixel, and is lit as it was. Compared is the
// nearest surface of 3 x 3 pixels in either frame: where both go the same way, nothing was hidden or laid bare. What is
// smaller than a pixel, and missed by this frame, passes: it goes nearly the way of what surrounds it.
//
// After lib/previous_camera.glsl and shared/math/antialias.h.
#include "shared/interface/constants/light_changes_cell.h"

layout(binding = UNIT_PREVIOUS_SURFACE) uniform samplerBuffer previous_texels;
layout(binding = UNIT_PASS_D) uniform sampler2D light_changes;

const int TAPS = 9;
const float SKY_DEPTH = 3e38f;

ivec2 tap_offset(int tap) { return ivec2(tap % 3, tap / 3) - 1; }

ivec2 clamp_to_frame(ivec2 pixel) { return clamp(pixel, ivec2(0), ivec2(frame_size.xy) - 1); }

// The nearest surface of 3 x 3 pixels.
struct Nearest {
    ivec2 pixel;
    float depth;  // SKY_DEPTH: the sky alone
};

// Unlit surfaces have a place, the sky has none.
float depth_of(vec4 position, CameraRecord camera) {
    bool is_sky = position.w < 0.0f && position.xyz == vec3(0.0f);
    return is_sky ? SKY_DEPTH : dot(position.xyz - camera.position, camera.forward);
}

Nearest find_nearest(ivec2 pixel) {
    CameraRecord camera = frame_camera();
    Nearest nearest = Nearest(pixel, SKY_DEPTH);
    for (int tap = 0; tap < TAPS; ++tap) {
        ivec2 around = clamp_to_frame(pixel + tap_offset(tap));
        float depth = depth_of(load_layer(around, LAYER_POSITION), camera);
        if (depth < nearest.depth) nearest = Nearest(around, depth);
    }
    return nearest;
}

vec4 load_previous(ivec2 pixel, int layer) {
    return texelFetch(previous_texels, surface_texel(frame_size.x, pixel, layer));
}

Nearest find_nearest_previous(ivec2 pixel) {
    CameraRecord camera = previous_camera();
    Nearest nearest = Nearest(clamp_to_frame(pixel), SKY_DEPTH);
    for (int tap = 0; tap < TAPS; ++tap) {
        ivec2 around = clamp_to_frame(pixel + tap_offset(tap));
        float depth = depth_of(load_previous(around, LAYER_POSITION), camera);
        if (depth < nearest.depth) nearest = Nearest(around, depth);
    }
    return nearest;
}

// How far what `nearest` shows has come since the last frame, in pixels of the frame. That of the sky, by the camera's
// turn; an orthographic one stands still.
vec2 find_motion(Nearest nearest) {
    CameraRecord camera = previous_camera();
    vec3 before = previous_position(nearest.pixel);
    if (nearest.depth == SKY_DEPTH) {
        if (camera.orthographic) return vec2(0.0f);
        before = camera.position + pixel_ray(nearest.pixel).direction;
    }
#ifdef TARN_PLANT_NO_UNJITTER
    return vec2(nearest.pixel) + 0.5f - find_previous_place(before);
#else
    return vec2(nearest.pixel) + 0.5f + frame_jitter.xy - (find_previous_place(before) + frame_jitter.zw);
#endif
}

// How far what the last frame saw there should have come: its step of the frame before, once more.
vec2 expect_motion(Nearest nearest) {
    CameraRecord camera = frame_camera();
    vec3 position = load_previous(nearest.pixel, LAYER_POSITION).xyz;
#ifdef TARN_MOTION
    if (has_previous_motion != 0u) position += position - load_previous(nearest.pixel, LAYER_MOTION).xyz;
#endif
    if (nearest.depth == SKY_DEPTH) {
        if (camera.orthographic) return vec2(0.0f);
        vec2 place = vec2(nearest.pixel) + 0.5f + frame_jitter.zw;
        position = camera.position + camera_ray(previous_camera(), place, vec2(frame_full.xy)).direction;
    }
    return find_place(camera, position) - (vec2(nearest.pixel) + 0.5f + frame_jitter.zw);
}

// Whether both frames saw the same lamp there, and it shines otherwise now.
bool emits_otherwise(Nearest present, Nearest past) {
    const float SAME_DEPTH = 0.02f, SAME_LIGHT = 0.05f;  // shares
    if (abs(past.depth - present.depth) > SAME_DEPTH * present.depth) return false;
#ifdef TARN_MOTION
    // A lamp of its own that one of the frames missed has not gone out.
    bool knows_things = has_previous_motion != 0u && present.depth != SKY_DEPTH;
    float thing = load_layer(present.pixel, LAYER_MOTION).w;
    if (knows_things && thing != load_previous(past.pixel, LAYER_MOTION).w) return false;
#endif
    vec3 now = load_layer(present.pixel, LAYER_EMISSION).xyz;
    vec3 before = load_previous(past.pixel, LAYER_EMISSION).xyz;
    return any(greaterThan(abs(now - before), SAME_LIGHT * max(now, before)));
}

// Whether what the last frame saw at `place`, in its pixels, has come to where `present` is, which came by `motion`.
// `enlargement`: pixels of the picture for one of the frame.
bool has_come_along(vec2 motion, Nearest past, vec2 enlargement) {
    const float SAME_MOTION = 0.25f;  // pixels of the picture: more would leave a ghost beside edges
    vec2 difference = (expect_motion(past) - motion) * enlargement;
    return dot(difference, difference) <= SAME_MOTION * SAME_MOTION;
}

// Whether a place is lit as it was, as far as is known.
bool is_lit_as_before(Nearest present, Nearest past) {
    const float MOST_CHANGE = 0.05f;  // share of the light of a place
    const float LEAST_ALPHA =
        0.04f;  // what is smoother shows a picture that moves otherwise than its surface
    bool is_rough = load_layer(present.pixel, LAYER_DIFFUSE).w >= LEAST_ALPHA || present.depth == SKY_DEPTH;
    if (has_changes == 0u) return is_rough;
    bool changed = texelFetch(light_changes, present.pixel / CHANGE_CELL, 0).x > MOST_CHANGE;
#ifndef TARN_PLANT_STEADY_LAMPS
    changed = changed || emits_otherwise(present, past);
#endif
    return is_rough && !changed;
}
