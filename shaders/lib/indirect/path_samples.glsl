// Indirect light's part of reuse: what a sample is, its target, its ray, and how it moves between receivers and frames.
//
// The other part, lib/reuse, knows no light. After lib/receiver.glsl; for reuse over time after lib/previous.glsl with
// TARN_PREVIOUS_FRAME defined. The domain of a receiver is the solid angle around it.
#include "shared/math/path_sample.h"

// ---- The place

struct PathPlace {
    vec3 position;
    vec3 normal;  // geometric, on the side that the path met
    float error;  // bound on the position's rounding error
};

// Of a sample whose instance stands `instance_offset` behind its place in the table.
PathPlace load_place_at(PathSample path, uint instance_offset) {
    bool back = (path.primitive & PATH_BACK_FACE) != 0u;
    bool exists = path.instance != INVALID_INDEX;
    InstanceRecord instance = load_instance(exists ? path.instance + instance_offset : 0u);
    uvec3 vertices = load_vertex_indices(instance, path.primitive & ~PATH_BACK_FACE);
    vec3 p0 = load_position_os(vertices.x);
    vec3 p1 = load_position_os(vertices.y);
    vec3 p2 = load_position_os(vertices.z);
    vec3 normal = normalize_or_up(transform_normal(instance, normalize_or_up(cross(p1 - p0, p2 - p0))));
    PathPlace place;
    place.position = transform_point(instance, interpolate3(p0, p1, p2, path.barycentrics));
    place.normal = back ? -normal : normal;
    place.error = position_error_bound(largest_absolute_term(instance, p0, p1, p2));
    return place;
}

// Every receiver that looks at a sample needs its place: it is loaded with the sample, once.
struct PlacedSample {
    PathSample path;
    PathPlace place;  // in the present
};

PlacedSample find_place(PathSample path) { return PlacedSample(path, load_place_at(path, 0u)); }

// ---- In and out of memory

#define SAMPLE PlacedSample
#define SAMPLE_ROWS PATH_SAMPLE_ROWS
const uint TEMPORAL_DIMENSION = DIMENSION_INDIRECT_TEMPORAL;
const uint SPATIAL_DIMENSION = DIMENSION_INDIRECT_SPATIAL;

SAMPLE no_sample() {
    return PlacedSample(no_path_sample(), PathPlace(vec3(0.0f), vec3(0.0f, 0.0f, 1.0f), 0.0f));
}
bool is_sample(SAMPLE drawn) { return drawn.path.instance != INVALID_INDEX; }
uvec3 pack_sample(SAMPLE drawn) { return pack_path_head(drawn.path); }

SAMPLE load_sample(usamplerBuffer rows, uvec3 head, int row) {
    return find_place(unpack_path_sample(head, texelFetch(rows, row), texelFetch(rows, row + 1),
                                         texelFetch(rows, row + 2)));
}

uvec4 pack_sample_row(SAMPLE drawn, uint index) {
    uvec4 place, material, light;
    pack_path_rows(drawn.path, place, material, light);
    return index == 0u ? place : index == 1u ? material : light;
}

// ---- What it sends

// What the place reflects to `point`, before visibility; nothing to points behind it. Measure: solid angle at the point.
IncidentLight place_light(PathSample path, PathPlace place, vec3 point) {
    IncidentLight light = no_incident_light();
    vec3 to_place = place.position - point;
    float distance2 = dot(to_place, to_place);
    if (path.instance == INVALID_INDEX || distance2 == 0.0f) return light;
    float distance = sqrt(distance2);
    vec3 direction = to_place / distance;
    if (dot(place.normal, direction) >= 0.0f) return light;
    Frame frame = make_frame(path.shading_normal);
    vec3 view_local = to_local(frame, -direction);
    vec3 light_local = to_local(frame, path.incident_direction);
    light.direction = direction;
    light.distance = distance;
    light.light_normal = place.normal;
    light.value =
        evaluate_brdf(path.material, view_local, light_local) * path.incident * max(light_local.z, 0.0f);
    return light;
}

// p-hat of light at a receiver, without visibility. With `target_weights`.w that of the light itself, wherever the surface
// may reflect it (Ouyang et al. 2021, section 4.2).
float path_target(Receiver r, IncidentLight light) {
    if (target_weights.w == 0.0f) return target_at(r, light);
    bool is_before = dot(r.point.geometric_normal, light.direction) > 0.0f;
    return is_before ? target_function(light.value, target_weights.xyz) : 0.0f;
}

float sample_target(Receiver r, SAMPLE drawn) {
    return path_target(r, place_light(drawn.path, drawn.place, r.point.position));
}

// What the sample sends to the viewer if it is seen, not yet weighed by W.
BrdfValue reflect_sample(Receiver r, SAMPLE drawn) {
    return reflect_at(r, place_light(drawn.path, drawn.place, r.point.position));
}

RayRecord place_ray(Receiver r, PathSample path, PathPlace place, ivec2 pixel) {
    IncidentLight light = place_light(path, place, r.point.position);
    if (!(max_component(light.value) > 0.0f)) return inactive_ray();
    return make_shadow_ray(r.point, light, place.error, pixel_index(pixel));
}

// The ray that asks whether the receiver of `pixel` sees the sample; inactive where the answer does not matter.
RayRecord sample_ray(Receiver r, SAMPLE drawn, ivec2 pixel) {
    return place_ray(r, drawn.path, drawn.place, pixel);
}

// ---- Shifts

// Whether receivers of these GGX widths may share samples: not where one of them is glossy.
bool can_share(float alpha, float other_alpha) { return min(alpha, other_alpha) >= MIN_RECONNECTION_ALPHA; }

bool reconnects(SAMPLE drawn) {
    bool has_layer = SCENE_HAS_SPECULAR &&
                     (drawn.path.material.f90 > 0.0f || max_component(drawn.path.material.f0) > 0.0f);
    return is_sample(drawn) && (!has_layer || drawn.path.material.alpha >= MIN_RECONNECTION_ALPHA);
}

float bound_jacobian(vec3 from, vec3 to, PathPlace place) {
#ifdef TARN_PLANT_DROP_RECONNECTION_JACOBIAN
    return reconnection_jacobian(from, to, place.position, place.normal) > 0.0f ? 1.0f : 0.0f;
#endif
    float jacobian = reconnection_jacobian(from, to, place.position, place.normal);
#ifdef TARN_PLANT_CLAMP_RECONNECTION_JACOBIAN
    jacobian = min(jacobian, 1.0f);
#endif
    return jacobian;
}

// |dT/dx| of the shift from one receiver's domain to another's: the place stays.
float shift_jacobian(Receiver from, Receiver to, SAMPLE drawn) {
    if (!reconnects(drawn)) return 0.0f;
    return bound_jacobian(from.point.position, to.point.position, drawn.place);
}

#ifdef TARN_PREVIOUS_FRAME
#include "lib/indirect/previous_paths.glsl"
#endif
