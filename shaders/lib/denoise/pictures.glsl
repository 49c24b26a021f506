// What the denoiser hands from pass to pass and from frame to frame. After lib/frame.glsl.
//
// Light: base or layer without its albedo, and the variance of its luminance; -1 where nothing is known of it: nothing
// is lit, nothing reflects, or what came was unusable.
// Guide: depth before the camera, shading normal as the camera sees it, GGX alpha (-1: nothing is lit), HistoryTag.
// Moments: LightMoments of base and layer.
#include "shared/math/colour.h"
#include "shared/math/denoise.h"

// Layers of the history.
const int HISTORY_GUIDE = 0;
const int HISTORY_MOMENTS = 1;
const int HISTORY_DIFFUSE = 2;
const int HISTORY_SPECULAR = 3;

const float UNKNOWN_VARIANCE = -1.0f;
const vec4 UNKNOWN_LIGHT = vec4(0.0f, 0.0f, 0.0f, UNKNOWN_VARIANCE);

bool is_known(vec4 light) { return light.w >= 0.0f; }

struct Guide {
    float depth;
    vec2 normal;
    float alpha;
};

Guide unpack_guide(vec4 code) { return Guide(code.x, unpack_projected_normal(code.y), code.z); }

vec4 pack_guide(Guide guide, HistoryTag tag) {
    return vec4(guide.depth, pack_projected_normal(guide.normal), guide.alpha, pack_history_tag(tag));
}
