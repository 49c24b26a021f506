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

PathPlace load_previous_place(PlacedSample drawn) {
#ifdef TARN_MOTION
    return load_place_at(drawn.path, frame_history.x);
#else
    return drawn.place;
#endif
}

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

// p-hat without visibility.
float sample_target(Receiver r, SAMPLE drawn) {
    return target_at(r, place_light(drawn.path, drawn.place, r.point.position));
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
#include "lib/previous_lights.glsl"

// A sample of this frame as the last one would have known it, and back. Instances keep their index; where they were is
// known by it. Its light is what the lamp sends now, or sent then: what goes out is dark at once in old samples too. The
// way from the lamp to the place is not traced again.
#if defined(TARN_LIGHT_HISTORY) && !defined(TARN_PLANT_STALE_LIGHT)
SAMPLE relight(SAMPLE drawn, IncidentLight before, IncidentLight after, uint light, vec3 normal) {
    float scale = ratio_or_zero(dot(drawn.path.incident, vec3(1.0f)), dot(before.value, vec3(1.0f)));
    bool is_lit = light != INVALID_INDEX && dot(normal, after.direction) > 0.0f;
    drawn.path.incident = is_lit ? after.value * scale : vec3(0.0f);
    drawn.path.incident_direction = after.direction;
    drawn.path.light.light = light;
    return drawn;
}

SAMPLE move_to_present(SAMPLE drawn) {
    LightSample then = drawn.path.light;
    if (!is_sample(drawn) || !is_in_light_table(then)) return drawn;
    LightSample now = LightSample(remap_light(then.light, false), then.uv);
    return relight(drawn, load_previous_incident_light(then, load_previous_place(drawn).position),
                   load_incident_light(now, drawn.place.position), now.light, drawn.place.normal);
}

SAMPLE move_to_previous(SAMPLE drawn) {
    LightSample now = drawn.path.light;
    if (!is_sample(drawn) || !is_in_light_table(now)) return drawn;
    LightSample then = LightSample(remap_light(now.light, true), now.uv);
    PathPlace place = load_previous_place(drawn);
    if (then.light == INVALID_INDEX)
        return relight(drawn, no_incident_light(), no_incident_light(), INVALID_INDEX, place.normal);
    return relight(drawn, load_incident_light(now, drawn.place.position),
                   load_previous_incident_light(then, place.position), then.light, place.normal);
}
#else
SAMPLE move_to_previous(SAMPLE drawn) { return drawn; }
SAMPLE move_to_present(SAMPLE drawn) { return drawn; }
#endif

// Area of the sample's triangle now over then.
float area_ratio(SAMPLE drawn) {
#ifdef TARN_MOTION
    InstanceRecord now = load_instance(drawn.path.instance);
    InstanceRecord then = load_instance(drawn.path.instance + frame_history.x);
    uvec3 v = load_vertex_indices(now, drawn.path.primitive & ~PATH_BACK_FACE);
    uvec3 w = load_vertex_indices(then, drawn.path.primitive & ~PATH_BACK_FACE);
    vec3 origin_now = load_position_os(v.x);
    vec3 origin_then = load_position_os(w.x);
    float area_now = length(cross(transform_vector(now, load_position_os(v.y) - origin_now),
                                  transform_vector(now, load_position_os(v.z) - origin_now)));
    float area_then = length(cross(transform_vector(then, load_position_os(w.y) - origin_then),
                                   transform_vector(then, load_position_os(w.z) - origin_then)));
    return ratio_or_zero(area_now, area_then);
#else
    return 1.0f;
#endif
}

// |dT/dx| from the previous receiver in the last frame to this one in the present: the place moves with its triangle.
float temporal_jacobian(Receiver previous_receiver, Receiver here, SAMPLE present, SAMPLE previous) {
    if (!reconnects(present) || !is_sample(previous)) return 0.0f;
    PathPlace now = present.place;
#ifdef TARN_MOTION
    // Through solid angle per area then, area, and solid angle per area now.
    PathPlace then = load_previous_place(previous);
    vec3 a = previous_receiver.point.position - then.position;
    vec3 b = here.point.position - now.position;
    float a2 = dot(a, a);
    float b2 = dot(b, b);
    float before = dot(then.normal, a) * b2 * sqrt(b2);
    float after = dot(now.normal, b) * a2 * sqrt(a2) * area_ratio(previous);
    if (!(before > 0.0f) || !(after > 0.0f)) return 0.0f;
    if (!(max(before, after) <= MAX_RECONNECTION_JACOBIAN * min(before, after))) return 0.0f;
#ifdef TARN_PLANT_DROP_RECONNECTION_JACOBIAN
    return 1.0f;
#endif
    return ratio_or_zero(after, before);
#else
    return bound_jacobian(previous_receiver.point.position, here.point.position, now);
#endif
}

// p-hat in the last frame, of a receiver and a sample of the last frame.
float previous_sample_target(Receiver previous, SAMPLE drawn) {
    return target_at(previous, place_light(drawn.path, load_previous_place(drawn), previous.point.position));
}

// A ray of the last frame: to where the place was, past what stood in its way then.
RayRecord previous_sample_ray(Receiver previous, SAMPLE drawn, ivec2 pixel) {
    RayRecord ray = place_ray(previous, drawn.path, load_previous_place(drawn), pixel);
    ray.pixel |= RAY_PREVIOUS;
    return ray;
}
#endif
