// What the denoiser computes of single values: moments that keep their digits, weights of taps, and what it
// keeps of a surface. No scene, no pictures.
//
// After Schied et al., "Spatiotemporal Variance-Guided Filtering" (2017), with departures that are said where
// they are made.
#pragma once

#include "shared/dialect.h"
#include "shared/interface/records.h"

SHARED_BEGIN

// ---- Moments over time

// Of the luminance of a pixel. Mean and variance rather than the mean of squares: m2 - m1^2 has no digits
// left where a signal is bright and nearly even, and its square leaves the range of half floats.
struct LightMoments {
    float mean;
    float variance;
};

// The moments after one more value, which gets `share` of the weight (1: the value alone). West, "Updating
// Mean and Variance Estimates: An Improved Method" (1979), for weights that fade; no difference of large
// numbers.
FN LightMoments add_to_moments(LightMoments m, float value, float share) {
    float difference = value - m.mean;
    LightMoments result;
    result.mean = m.mean + share * difference;
    result.variance = (1.0f - share) * (m.variance + share * difference * difference);
    return result;
}

// Below so many frames the moments say nothing of the variance.
CONSTANT float FEW_FRAMES = 4.0f;

// ---- Outliers

// How many times a value may exceed all around it. In lantern_court 30 drops 0.5 % of the energy and half of
// the error; a mirror that meets a lamp once in many frames would show it as a blotch.
CONSTANT float OUTLIER_RATIO = 30.0f;
// Beyond this squares overflow; light that is brighter is an error.
CONSTANT float GREATEST_LIGHT = 1e15f;

// Whether light can be used at all.
FN bool is_usable_light(vec3 light) {
    return is_finite3(light) && max_component(light) <= GREATEST_LIGHT && light.x >= 0.0f &&
           light.y >= 0.0f && light.z >= 0.0f;
}

// Whether `value` stands out from what was here before, so that a look around is worth its cost.
FN bool is_suspicious(float value, LightMoments past, float frames) {
    return frames < FEW_FRAMES || value > OUTLIER_RATIO * (past.mean + sqrt(past.variance));
}

// Whether `value` stands out from the greatest value around it. Among black pixels nothing does: there a
// single bright sample is all that is known.
FN bool is_outlier(float value, float greatest_around) {
    return greatest_around > 0.0f && value > OUTLIER_RATIO * greatest_around;
}

// ---- Surfaces as the camera sees them

// Stereographic projection of a unit normal from the pole behind the camera's view: two numbers whose
// distances are those of directions up to a factor. Normals on the viewer's side lie within the unit circle;
// those that turn away are kept within 2.
FN vec2 project_normal(CameraRecord camera, vec3 normal) {
    float x = dot(normal, camera.right) / sqrt(dot(camera.right, camera.right));
    float y = dot(normal, camera.up) / sqrt(dot(camera.up, camera.up));
    float z = -dot(normal, camera.forward);
    float scale = 1.0f / (1.0f + max(z, -0.6f));
    return clamp(vec2(x, y) * scale, vec2(-2.0f), vec2(2.0f));
}

// Factor from squared distances of projected normals near `projected` to squared chords on the sphere, which
// are squared angles where they are small.
FN float chord_factor(vec2 projected) {
    float one_plus = 1.0f + dot(projected, projected);
    return 4.0f / (one_plus * one_plus);
}

// Two numbers in [-2, 2] as one whole number below 2^24, which a float holds exactly; steps of 1e-3.
FN float pack_projected_normal(vec2 projected) {
    vec2 steps = floor(projected * 1023.5f + 2047.5f);
    return steps.x + 4096.0f * steps.y;
}

FN vec2 unpack_projected_normal(float code) {
    float y = floor(code * (1.0f / 4096.0f));
    return (vec2(code - 4096.0f * y, y) - 2047.0f) * (1.0f / 1023.5f);
}

// A plane as seen from a camera: how far from it a pixel's surface is, by nothing but the pixel and its
// depth. Exact, however grazing the view.
struct PlaneView {
    vec3 ray;         // n.r of a pixel's ray: constant, and the growth a pixel in x and y
    vec2 ray_scale;   // that counts this much, and this much times the depth
    float per_depth;  // of the depth alone
    float offset;     // n.(p - camera)
};

// `jitter_px` and `size_px` are those of the picture that `camera` takes.
FN PlaneView make_plane_view(CameraRecord camera, vec2 jitter_px, vec2 size_px, vec3 position, vec3 normal) {
    float right = dot(normal, camera.right);
    float up = dot(normal, camera.up);
    float forward = dot(normal, camera.forward);
    float x = (1.0f + 2.0f * jitter_px.x) / size_px.x - 1.0f;
    float y = 1.0f - (1.0f + 2.0f * jitter_px.y) / size_px.y;
    PlaneView view;
    view.ray = vec3(right * x + up * y + (camera.orthographic ? 0.0f : forward), 2.0f * right / size_px.x,
                    -2.0f * up / size_px.y);
    view.ray_scale = camera.orthographic ? vec2(1.0f, 0.0f) : vec2(0.0f, 1.0f);
    view.per_depth = camera.orthographic ? forward : 0.0f;
    view.offset = dot(normal, position - camera.position);
    return view;
}

// Distance from the plane, metres, of what `pixel` sees at view depth `depth`.
FN float plane_distance(PlaneView view, vec2 pixel, float depth) {
    float ray = view.ray.x + view.ray.y * pixel.x + view.ray.z * pixel.y;
    return abs(ray * (view.ray_scale.x + view.ray_scale.y * depth) + view.per_depth * depth - view.offset);
}

// Height of a pixel at view depth `depth`, metres.
FN float pixel_height(CameraRecord camera, float height_px, float depth) {
    return 2.0f * sqrt(dot(camera.up, camera.up)) / height_px * (camera.orthographic ? 1.0f : abs(depth));
}

// ---- What a pixel keeps besides its light

// Frames behind the history of base and layer, in quarters up to GREATEST_HISTORY, and the instance modulo
// 256: whole numbers below 2^24 in one float.
CONSTANT float GREATEST_HISTORY = 63.0f;

struct HistoryTag {
    vec2 frames;  // base, layer
    float instance;
};

FN float pack_history_tag(HistoryTag tag) {
    vec2 quarters = floor(clamp(tag.frames, vec2(0.0f), vec2(GREATEST_HISTORY)) * 4.0f + 0.5f);
    float instance = tag.instance - 256.0f * floor(tag.instance * (1.0f / 256.0f));
    return quarters.x + 256.0f * quarters.y + 65536.0f * instance;
}

FN HistoryTag unpack_history_tag(float code) {
    float instance = floor(code * (1.0f / 65536.0f));
    float rest = code - 65536.0f * instance;
    float layer = floor(rest * (1.0f / 256.0f));
    HistoryTag tag;
    tag.frames = vec2(rest - 256.0f * layer, layer) * 0.25f;
    tag.instance = instance;
    return tag;
}

// ---- Weights of taps. All are 1 at no difference, fall smoothly and reach 0: sums of products, no
// exponentials.

// `squared`: the difference over its limit, squared.
FN float fade(float squared) {
    return max(0.0f, 1.0f - squared);
}

// Squared difference of two luminances over what noise explains: `factor` times their variances, and a share
// of themselves, so that even light does not hang on rounding.
FN float luminance_difference(float a, float b, float variances, float factor) {
    const float LEAST_RELATIVE = 1e-3f;
    float difference = a - b;
    float least = LEAST_RELATIVE * (a + b);
    return difference * difference / (factor * variances + least * least + 1e-36f);
}

// Variance of a mean of `frames` values whose own variance is `variance`, all weighed alike. Samples that
// ReSTIR hands from frame to frame are not independent: this many frames tell as much as one.
FN float variance_of_mean(float variance, float frames, float correlated_frames) {
    return variance * min(1.0f, correlated_frames / max(frames, 1.0f));
}

SHARED_END
