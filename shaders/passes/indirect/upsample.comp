// Brings the light of a coarse picture to the size of the picture: base and layer apart, before the albedo, so that the
// picture keeps its textures.
//
// Each pixel takes a weighted mean of the four coarse pixels around it: bilinear weights, times how alike the surfaces
// are. The weights are divided by their sum, so that even light stays what it is; they look at surfaces alone, never at
// the light, and so the mean stays linear in it. Where none of the four is alike, the nearest that passes the test for
// neighbours stands in; where none around does, as on what is thinner than a block, the nearest of all: light that leaks
// there errs less than none. Such pixels are counted. Runs with the coarse picture's frame block.
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/neighbour_test.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D coarse_diffuse;
layout(binding = UNIT_PASS_B) uniform sampler2D coarse_specular;
layout(binding = UNIT_PASS_C) uniform samplerBuffer coarse_texels;
layout(binding = 0, rgba32f) writeonly uniform image2D out_diffuse;
layout(binding = 1, rgba32f) writeonly uniform image2D out_specular;

// A surface and what it reflects with: a base or layer that reflects nothing knows nothing of its light.
struct Place {
    Look look;
    bool lit;
    bool has_base;
    bool has_layer;
};

Place make_place(vec4 position, vec4 normals, vec4 diffuse, vec4 specular) {
    return Place(look_of_layers(position, normals, diffuse), position.w >= 0.0f,
                 max_component(diffuse.xyz) > 0.0f, max(max_component(specular.xyz), specular.w) > 0.0f);
}

vec4 load_full(ivec2 pixel, int layer) { return load_layer_of(frame_full.x, pixel, layer); }

Place load_place(ivec2 pixel) {
    return make_place(load_full(pixel, LAYER_POSITION), load_full(pixel, LAYER_NORMALS),
                      load_full(pixel, LAYER_DIFFUSE), load_full(pixel, LAYER_SPECULAR));
}

vec4 load_coarse(ivec2 coarse, int layer) {
    return texelFetch(coarse_texels, surface_texel(frame_size.x, coarse, layer));
}

Place load_coarse_place(ivec2 coarse) {
    return make_place(load_coarse(coarse, LAYER_POSITION), load_coarse(coarse, LAYER_NORMALS),
                      load_coarse(coarse, LAYER_DIFFUSE), load_coarse(coarse, LAYER_SPECULAR));
}

// Light with weights: x, y of vectors are base and layer.
struct Gathered {
    vec3 diffuse;
    vec3 specular;
    vec2 weights;
};

void add(inout Gathered sum, ivec2 coarse, vec2 weights) {
    sum.diffuse += texelFetch(coarse_diffuse, coarse, 0).xyz * weights.x;
    sum.specular += texelFetch(coarse_specular, coarse, 0).xyz * weights.y;
    sum.weights += weights;
}

// 0 .. 1 for base and layer. The terms are those of is_similar; but light crosses here, not samples that would be
// weighed again, so the plane is narrower and all of them fade out.
vec2 find_likeness(Place own, Place found, float depth) {
    const float MAX_PLANE_DISTANCE = 0.02f;  // of the depth
    const float MIN_NORMAL_COSINE = 0.5f;
    const float MAX_ALPHA_DIFFERENCE = 0.25f;
    if (!found.lit) return vec2(0.0f);
    float plane = abs(dot(own.look.position - found.look.position, found.look.geometric_normal));
    float cosine = dot(own.look.shading_normal, found.look.shading_normal);
    float near = max(0.0f, 1.0f - plane / max(MAX_PLANE_DISTANCE * abs(depth), 1e-30f));
    float facing = max(0.0f, (cosine - MIN_NORMAL_COSINE) / (1.0f - MIN_NORMAL_COSINE));
    float glossy = max(0.0f, 1.0f - abs(own.look.alpha - found.look.alpha) / MAX_ALPHA_DIFFERENCE);
    float likeness = near * facing * facing;
    return vec2(found.has_base ? likeness : 0.0f, found.has_layer ? likeness * glossy : 0.0f);
}

// Of the pixel between two rows or columns of coarse pixels at `first` and `second`, places in the picture: 0 at the
// first. The last coarse pixel may stand closer than a step, so their true places count.
vec2 find_share(vec2 pixel, vec2 first, vec2 second) {
    return clamp((pixel - first) / max(second - first, 1.0f), 0.0f, 1.0f);
}

Gathered gather_around(ivec2 pixel, Place own, float depth) {
    ivec2 last = ivec2(frame_size.xy) - 1;
    ivec2 block = ivec2(frame_full.z);
    // The offset may lie beyond the pixel: then the block before holds the first of the four.
    ivec2 first = (pixel - ivec2(frame_offset.xy) + block) / block - 1;
    ivec2 second = min(first + 1, last);
    first = clamp(first, ivec2(0), last);
    vec2 share = find_share(vec2(pixel), vec2(full_pixel(first)), vec2(full_pixel(second)));
    Gathered sum = Gathered(vec3(0.0f), vec3(0.0f), vec2(0.0f));
    for (int i = 0; i < 4; ++i) {
        bvec2 far = bvec2((i & 1) != 0, (i & 2) != 0);
        ivec2 coarse = ivec2(far.x ? second.x : first.x, far.y ? second.y : first.y);
        float bilinear = (far.x ? share.x : 1.0f - share.x) * (far.y ? share.y : 1.0f - share.y);
        if (bilinear > 0.0f)
            add(sum, coarse, bilinear * find_likeness(own, load_coarse_place(coarse), depth));
    }
    return sum;
}

// Offsets in coarse pixels, the nearest first.
const int SPIRAL_LENGTH = 25;
const ivec2 SPIRAL[SPIRAL_LENGTH] = ivec2[SPIRAL_LENGTH](
    ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1), ivec2(1, 1), ivec2(-1, 1),
    ivec2(-1, -1), ivec2(1, -1), ivec2(2, 0), ivec2(0, 2), ivec2(-2, 0), ivec2(0, -2), ivec2(2, 1),
    ivec2(1, 2), ivec2(-1, 2), ivec2(-2, 1), ivec2(-2, -1), ivec2(-1, -2), ivec2(1, -2), ivec2(2, -1),
    ivec2(2, 2), ivec2(-2, 2), ivec2(-2, -2), ivec2(2, -2));

// The nearest coarse pixel that is alike, or else the nearest of all, of those that reflect with what is `missing` (base,
// layer); x < 0 where there is none.
ivec2 find_nearest(ivec2 pixel, Place own, float depth, bvec2 missing, out bool is_alike) {
    ivec2 block = ivec2(frame_full.z);
    ivec2 centre = (pixel - ivec2(frame_offset.xy) + block / 2) / block;
    ivec2 nearest = ivec2(-1);
    is_alike = false;
    for (int i = 0; i < SPIRAL_LENGTH && !is_alike; ++i) {
        ivec2 coarse = centre + SPIRAL[i];
        if (any(lessThan(coarse, ivec2(0))) || any(greaterThanEqual(coarse, ivec2(frame_size.xy)))) continue;
        Place found = load_coarse_place(coarse);
        bool fits = found.lit && (!missing.x || found.has_base) && (!missing.y || found.has_layer);
        is_alike = fits && is_similar(own.look, found.look, depth);
        if (is_alike || (fits && nearest.x < 0)) nearest = coarse;
    }
    return nearest;
}

// What the four could not say.
void fill_missing(inout Gathered light, ivec2 pixel, Place own, float depth) {
    bvec2 missing = bvec2(own.has_base && light.weights.x == 0.0f, own.has_layer && light.weights.y == 0.0f);
    if (!any(missing)) return;
    bool is_alike;
    ivec2 nearest = find_nearest(pixel, own, depth, missing, is_alike);
    if (!is_alike) count_event(COUNTER_COARSE_GAP);
    if (nearest.x >= 0) add(light, nearest, vec2(missing));
}

Gathered find_light(ivec2 pixel) {
    Place own = load_place(pixel);
    Gathered light = Gathered(vec3(0.0f), vec3(0.0f), vec2(0.0f));
    if (!own.lit) return light;
    float depth = view_depth(frame_camera(), own.look.position);
    light = gather_around(pixel, own, depth);
    fill_missing(light, pixel, own, depth);
#ifndef TARN_PLANT_DROP_UPSAMPLE_NORMALIZATION
    light.diffuse *= ratio_or_zero(1.0f, light.weights.x);
    light.specular *= ratio_or_zero(1.0f, light.weights.y);
#endif
    return light;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame_full.xy)))) return;
    Gathered light = find_light(pixel);
    imageStore(out_diffuse, pixel, vec4(light.diffuse, 1.0f));
    imageStore(out_specular, pixel, vec4(light.specular, 1.0f));
}
