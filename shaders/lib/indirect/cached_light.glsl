// Light that further surfaces send to the end of a path, without going there: out of what the last frame knew.
//
// TARN_CACHE_SCREEN: where the end was in view, the light that the last frame found there by way of other surfaces.
// TARN_CACHE_WORLD: the hash grid, lib/indirect/world_cache.glsl.
// Light that comes straight from lamps is in neither: next-event estimation finds it at the end of the path. Of the light,
// the base alone: what a layer reflects is another thing in every direction. After lib/receiver.glsl.
#if defined(TARN_CACHE_SCREEN) || defined(TARN_CACHE_WORLD)
#define TARN_CACHE
#include "lib/neighbour_test.glsl"

// What reaches the base through the layer, of light from everywhere: 1 - R_avg (shared/math/brdf.h).
vec3 mean_transmission(SurfaceMaterial m) {
    if (!SCENE_HAS_SPECULAR) return vec3(1.0f);
    LayerAlbedo mean = evaluate_mean_layer_albedo(m.alpha);
    return transmit_to_base(m, mean_multiple_fresnel(m, mean.loss), mean);
}

// (1 - R(v)) / (pi (1 - R_avg)): what the view takes of the base's light.
vec3 base_to_viewer(Receiver r) { return SCENE_HAS_SPECULAR ? r.brdf.base : vec3(INV_PI); }

#ifdef TARN_CACHE_WORLD
vec3 find_base_irradiance(usamplerBuffer cells, Receiver r) {
    return load_cached_irradiance(cells, r.point.position, r.point.geometric_normal) *
           mean_transmission(r.point.material);
}
#endif

#ifdef TARN_CACHE_SCREEN
#include "lib/previous.glsl"

layout(binding = UNIT_PASS_D) uniform sampler2D kept_light;  // of the base, without its albedo

// Where the place of a hit was in the last frame, and its normal there, on either side.
void find_previous_place(HitRecord hit, Receiver r, out vec3 position, out vec3 normal) {
    position = r.point.position;
    normal = r.point.geometric_normal;
#ifdef TARN_MOTION
    InstanceRecord instance = load_instance(hit.instance + frame_history.x);
    uvec3 v = load_vertex_indices(instance, hit.primitive);
    vec3 p0 = load_position_os(v.x);
    vec3 p1 = load_position_os(v.y);
    vec3 p2 = load_position_os(v.z);
    position = transform_point(instance, interpolate3(p0, p1, p2, hit.barycentrics));
    normal = normalize_or_up(transform_normal(instance, normalize_or_up(cross(p1 - p0, p2 - p0))));
    normal = dot(normal, r.point.geometric_normal) < 0.0f ? -normal : normal;
#endif
}

// Two things in one plane have one irradiance, so the test asks not which thing it is.
bool is_same_surface(vec3 position, vec3 normal, ShadingPoint found) {
    const float MAX_PLANE_DISTANCE = 0.01f;  // of the depth
    const float MIN_NORMAL_COSINE = 0.9f;
    float depth = view_depth(previous_camera(), position);
#ifdef TARN_PLANT_IGNORE_CACHE_NORMALS
    return true;
#endif
    return abs(dot(position - found.position, found.geometric_normal)) <= MAX_PLANE_DISTANCE * abs(depth) &&
           dot(normal, found.geometric_normal) >= MIN_NORMAL_COSINE;
}

vec3 find_light_in_view(HitRecord hit, Receiver r) {
    const float LEAST_BASE = 0.05f * INV_PI;  // of grazing views that hardly see the base
    vec3 position, normal;
    find_previous_place(hit, r, position, normal);
    ivec2 pixel = project_to_previous(position);
    bool is_in_view = pixel.x >= 0;
    pixel = max(pixel, ivec2(0));
    PreviousLayers layers = load_previous_layers(pixel);
    Receiver found = load_previous_receiver(pixel, layers);
    bool lit = was_lit(layers);
    if (!is_in_view || !lit || !is_same_surface(position, normal, found.point)) return vec3(0.0f);
    return texelFetch(kept_light, pixel, 0).xyz / max(base_to_viewer(found), vec3(LEAST_BASE));
}
#endif
#endif
