// First step of the denoiser: joins the light of all stages, without albedo, with what the last frames knew of the same
// surfaces.
//
// Each pixel asks the four pixels of the last frame around the place where its surface was. Those that pass the test of
// the geometry (plane, normal, and instance where things move) give their history by bilinear weights over the sum of the
// weights that remain. A history of N frames counts N times as much as the present one: a plain mean that becomes an
// exponential one at `history_frames`.
//
// The light of a layer hangs on the view: how far that of the last frame still holds depends on how far the view has
// turned, measured in widths of the lobe. So a mirror loses its history where the view turns and rough layers keep
// theirs. (Where a reflection was in the last frame would need the distance of what is reflected, which a sum of samples
// does not have.)
//
// Light that is no number, or stands out from all around it, is dropped and counted; the pixel lives on its history, or
// on its neighbours by the filter.
//
// Where light has changed since the last frame (light_changes.comp), the present counts at least as much as the share
// that has: a change shows at once, and only there does the noise come back.
//
// TARN_INDIRECT: there is indirect light. TARN_ADAPTIVE: changes of the light may be known.
#include "shared/interface/constants/denoise.h"
#include "shared/interface/constants/light_changes_cell.h"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/previous_camera.glsl"
#include "lib/denoise/pictures.glsl"
#include "lib/denoise/layer_share.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D direct_diffuse;
layout(binding = UNIT_PASS_B) uniform sampler2D direct_specular;
#ifdef TARN_INDIRECT
layout(binding = UNIT_PASS_C) uniform sampler2D indirect_diffuse;
layout(binding = UNIT_PASS_D) uniform sampler2D indirect_specular;
#endif
#ifdef TARN_ADAPTIVE
layout(binding = UNIT_PASS_E) uniform sampler2D light_changes;
#endif
layout(binding = UNIT_PREVIOUS_SURFACE) uniform sampler2DArray history_layers;
layout(binding = 0, rgba32f) writeonly uniform image2D out_guide;
layout(binding = 1, rgba32f) writeonly uniform image2D out_moments;
layout(binding = 2, rgba32f) writeonly uniform image2D out_diffuse;
layout(binding = 3, rgba32f) writeonly uniform image2D out_specular;

// Light of a pixel as it came: base without albedo, layer as it is.
struct PixelLight {
    vec3 diffuse;
    vec3 specular;
};

PixelLight load_light(ivec2 pixel) {
    PixelLight light =
        PixelLight(texelFetch(direct_diffuse, pixel, 0).xyz, texelFetch(direct_specular, pixel, 0).xyz);
#ifdef TARN_INDIRECT
    light.diffuse += texelFetch(indirect_diffuse, pixel, 0).xyz;
    light.specular += texelFetch(indirect_specular, pixel, 0).xyz;
#endif
    return light;
}

// ---- The last frames

// Base or layer in the history.
struct Past {
    vec3 light;
    LightMoments moments;
    float frames;  // 0: nothing is known
};

struct Gathered {
    vec4 diffuse;  // light, frames
    vec4 specular;
    vec4 moments;
    vec2 weights;  // base, layer
};

// What the pixel was in the last frame.
struct Expected {
    PlaneView plane;
    float tolerance;  // metres
    vec2 normal;
    float chord;
    float instance;
};

Expected expect(ivec2 pixel, ShadingPoint point, vec3 position) {
    const float TOLERANCE_PX = 3.0f;
    CameraRecord camera = previous_camera();
    float depth = dot(position - camera.position, camera.forward);
    Expected e;
    e.plane = make_plane_view(camera, frame_jitter.zw, vec2(frame_size.xy), position, point.geometric_normal);
    e.tolerance = TOLERANCE_PX * pixel_height(camera, float(frame_size.y), depth);
    e.normal = project_normal(camera, point.shading_normal);
    e.chord = chord_factor(e.normal);
    e.instance = 0.0f;
#ifdef TARN_MOTION
    e.instance = mod(load_layer(pixel, LAYER_MOTION).w, 256.0f);
#endif
    return e;
}

bool is_same_surface(Expected e, ivec2 pixel, vec4 packed_guide) {
#ifdef TARN_PLANT_NO_GEOMETRY_TEST
    return packed_guide.z >= 0.0f;
#endif
    const float MAX_SQUARED_CHORD = 0.2f;  // 26 degrees
    Guide found = unpack_guide(packed_guide);
    vec2 turned = found.normal - e.normal;
    bool same = found.alpha >= 0.0f && plane_distance(e.plane, vec2(pixel), found.depth) <= e.tolerance &&
                dot(turned, turned) * e.chord <= MAX_SQUARED_CHORD;
#ifdef TARN_MOTION
    same = same && unpack_history_tag(packed_guide.w).instance == e.instance;
#endif
    return same;
}

vec4 load_history(ivec2 pixel, int layer) { return texelFetch(history_layers, ivec3(pixel, layer), 0); }

// Sums of squares of history that is no number are none either.
bool is_finite_history(vec4 diffuse, vec4 specular, vec4 moments) {
    return is_finite(dot(diffuse.xyz, vec3(1.0f)) + dot(specular.xyz, vec3(1.0f)) + dot(moments, vec4(1.0f)));
}

void add_tap(inout Gathered sum, ivec2 pixel, float weight, Expected e) {
    bool inside = all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(frame_size.xy)));
    ivec2 place = clamp(pixel, ivec2(0), ivec2(frame_size.xy) - 1);
    vec4 guide = load_history(place, HISTORY_GUIDE);
    vec4 diffuse = load_history(place, HISTORY_DIFFUSE);
    vec4 specular = load_history(place, HISTORY_SPECULAR);
    vec4 moments = load_history(place, HISTORY_MOMENTS);
    bool usable = inside && weight > 0.0f && is_same_surface(e, place, guide);
#ifndef TARN_PLANT_UNSANITIZED
    if (usable && !is_finite_history(diffuse, specular, moments)) {
        count_event(COUNTER_BAD_LIGHT_HISTORY);
        usable = false;
    }
#endif
    if (!usable) return;
    vec2 frames = unpack_history_tag(guide.w).frames;
    vec2 weights = vec2(frames.x > 0.0f ? weight : 0.0f, frames.y > 0.0f ? weight : 0.0f);
    sum.diffuse += weights.x * vec4(diffuse.xyz, frames.x);
    sum.specular += weights.y * vec4(specular.xyz, frames.y);
    sum.moments += weights.xxyy * moments;
    sum.weights += weights;
}

// Weight of a tap of the history. `place`: where the surface was; `moved`: how far it has come since, without jitter.
//
// A surface that has not moved in the picture keeps the history of its own pixel: interpolated at the difference of two
// jitters, it would blur with every frame. Its neighbours count where that pixel showed another surface.
float tap_weight(ivec2 tap, ivec2 pixel, vec2 place, vec2 moved) {
    vec2 share = 1.0f - abs(vec2(tap) - place);
    float weight = share.x * share.y;
#ifndef TARN_PLANT_JITTERED_HISTORY
    const float STILL_PX = 0.01f;
    const float NEIGHBOUR = 1e-3f;
    bool is_still = max(abs(moved.x), abs(moved.y)) < STILL_PX;
    if (is_still) weight = tap == pixel ? 1.0f : NEIGHBOUR * weight;
#endif
    return weight;
}

Gathered gather_history(ivec2 pixel, ShadingPoint point, vec3 position) {
    Gathered sum = Gathered(vec4(0.0f), vec4(0.0f), vec4(0.0f), vec2(0.0f));
    Expected e = expect(pixel, point, position);
    vec2 place = find_previous_place(position) - 0.5f;
    // What lies far outside has no integer.
    if (!(all(greaterThan(place, vec2(-1.0f))) && all(lessThan(place, vec2(frame_size.xy))))) return sum;
    ivec2 first = ivec2(floor(place));
    vec2 moved = vec2(pixel) + frame_jitter.xy - (place + frame_jitter.zw);
    for (int i = 0; i < 4; ++i) {
        ivec2 tap = first + ivec2(i % 2, i / 2);
        add_tap(sum, tap, tap_weight(tap, pixel, place, moved), e);
    }
    return sum;
}

Past finish_past(vec4 light, vec2 moments, float weight) {
    float scale = ratio_or_zero(1.0f, weight);
    return Past(light.xyz * scale, LightMoments(moments.x * scale, moments.y * scale), light.w * scale);
}

// How many frames of a layer's history still hold after the view of the surface has turned from one frame to the next.
float cap_layer_frames(float alpha, vec3 point, vec3 previous_point) {
    const float WIDTHS = 0.5f;  // of the lobe, over the whole history
    CameraRecord camera = frame_camera();
    CameraRecord before = previous_camera();
    vec3 view = camera.orthographic ? -camera.forward : normalize(camera.position - point);
    vec3 previous_view = before.orthographic ? -before.forward : normalize(before.position - previous_point);
    float turned = length(view - previous_view);
    return WIDTHS * alpha / max(turned, 1e-6f);
}

// How many frames may stand against the present one, where light has changed.
float cap_changed_frames(ivec2 pixel) {
#if defined(TARN_ADAPTIVE) && !defined(TARN_PLANT_IGNORE_CHANGES)
    float change = has_changes != 0u ? texelFetch(light_changes, pixel / CHANGE_CELL, 0).x : 0.0f;
    return ratio_or_zero(1.0f - change, change) + (change == 0.0f ? GREATEST_HISTORY : 0.0f);
#else
    return GREATEST_HISTORY;
#endif
}

// ---- The present

// The brightest value around a pixel; looks only where `wanted`.
vec2 find_greatest_around(ivec2 pixel, bool wanted) {
    vec2 greatest = vec2(0.0f);
    int count = wanted ? 8 : 0;
    for (int i = 0; i < count; ++i) {
        int place = i < 4 ? i : i + 1;  // not the centre
        ivec2 around = clamp(pixel + ivec2(place % 3, place / 3) - 1, ivec2(0), ivec2(frame_size.xy) - 1);
        PixelLight light = load_light(around);
        vec2 value = vec2(luminance(light.diffuse), luminance(light.specular));
        bool other = any(notEqual(around, pixel));
        if (other && is_usable_light(light.diffuse)) greatest.x = max(greatest.x, value.x);
        if (other && is_usable_light(light.specular)) greatest.y = max(greatest.y, value.y);
    }
    return greatest;
}

// Present and past as one.
struct Accumulated {
    vec4 light;  // with the variance that the filter goes by
    LightMoments moments;
    float frames;
};

Accumulated nothing_accumulated() { return Accumulated(UNKNOWN_LIGHT, LightMoments(0.0f, 0.0f), 0.0f); }

// `usable`: whether the present light counts.
Accumulated accumulate(vec3 light, bool usable, Past past) {
    const float LEAST_MOMENT_SHARE = 0.1f;
    const float CORRELATED_FRAMES = 8.0f;
    const float GUESSED_VARIANCE = 4.0f;  // of a pixel without history, over its squared luminance
    if (!usable && past.frames == 0.0f) return nothing_accumulated();
    Accumulated a;
    a.frames = usable ? min(past.frames + 1.0f, history_frames) : past.frames;
    float share = usable ? 1.0f / max(a.frames, 1.0f) : 0.0f;
    if (!usable) light = past.light;  // 0 x NaN is none
    a.light.xyz = mix(past.light, light, share);
    float moment_share = usable ? max(share, LEAST_MOMENT_SHARE) : 0.0f;
    a.moments = add_to_moments(past.moments, luminance(light), moment_share);
    float mean = luminance(a.light.xyz);
    a.light.w = a.frames < FEW_FRAMES ? GUESSED_VARIANCE * mean * mean / max(a.frames, 1.0f)
                                      : variance_of_mean(a.moments.variance, a.frames, CORRELATED_FRAMES);
    return a;
}

void store(ivec2 pixel, Guide guide, float instance, Accumulated base, Accumulated layer) {
    HistoryTag tag = HistoryTag(vec2(base.frames, layer.frames), instance);
    imageStore(out_guide, pixel, pack_guide(guide, tag));
    imageStore(out_moments, pixel,
               vec4(base.moments.mean, base.moments.variance, layer.moments.mean, layer.moments.variance));
    imageStore(out_diffuse, pixel, base.light);
    imageStore(out_specular, pixel, layer.light);
}

// Whether base and layer of the present light count; what does not is counted.
bvec2 find_usable(ivec2 pixel, PixelLight light, Past base, Past layer) {
    bvec2 usable = bvec2(is_usable_light(light.diffuse), is_usable_light(light.specular));
#ifndef TARN_PLANT_UNSANITIZED
    vec2 value = vec2(luminance(light.diffuse), luminance(light.specular));
    bvec2 odd = bvec2(usable.x && value.x > 0.0f && is_suspicious(value.x, base.moments, base.frames),
                      usable.y && value.y > 0.0f && is_suspicious(value.y, layer.moments, layer.frames));
    vec2 greatest = find_greatest_around(pixel, any(odd));
    usable.x = usable.x && !(odd.x && is_outlier(value.x, greatest.x));
    usable.y = usable.y && !(odd.y && is_outlier(value.y, greatest.y));
    if (!all(usable)) count_event(COUNTER_BAD_LIGHT);
#else
    usable = bvec2(true);
#endif
    return usable;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    ShadingPoint point;
    if (!load_shading_point(pixel, point)) {
        store(pixel, Guide(0.0f, vec2(0.0f), -1.0f), 0.0f, nothing_accumulated(), nothing_accumulated());
        return;
    }
    CameraRecord camera = frame_camera();
    vec3 before = previous_position(pixel);
    Past base = Past(vec3(0.0f), LightMoments(0.0f, 0.0f), 0.0f);
    Past layer = base;
    if (has_previous != 0u) {
        Gathered history = gather_history(pixel, point, before);
        base = finish_past(history.diffuse, history.moments.xy, history.weights.x);
        layer = finish_past(history.specular, history.moments.zw, history.weights.y);
        float cap = cap_changed_frames(pixel);
        base.frames = min(base.frames, cap);
        layer.frames =
            min(layer.frames, min(cap, cap_layer_frames(point.material.alpha, point.position, before)));
    }
    vec3 layer_share = load_layer_share(pixel);
    PixelLight light = load_light(pixel);
    bvec2 usable = find_usable(pixel, light, base, layer);
    vec3 arriving =
        vec3(ratio_or_zero(light.specular.x, layer_share.x), ratio_or_zero(light.specular.y, layer_share.y),
             ratio_or_zero(light.specular.z, layer_share.z));
    Accumulated base_now = nothing_accumulated();
    Accumulated layer_now = nothing_accumulated();
    if (max_component(point.material.diffuse_albedo) > 0.0f)
        base_now = accumulate(light.diffuse, usable.x, base);
    if (max_component(layer_share) > 0.0f) layer_now = accumulate(arriving, usable.y, layer);
    float instance = 0.0f;
#ifdef TARN_MOTION
    instance = load_layer(pixel, LAYER_MOTION).w;
#endif
    Guide guide = Guide(dot(point.position - camera.position, camera.forward),
                        project_normal(camera, point.shading_normal), point.material.alpha);
    store(pixel, guide, instance, base_now, layer_now);
}
