// Path samples in the last frame: the shift in time. After lib/indirect/path_samples.glsl.
//
// A sample stays what it is: a point on a triangle, and a point on a lamp. Where both were and what they were like, the
// last frame's tables know: instances and lamps keep their rows there. Normal and material of the place are evaluated anew
// where its thing has moved, turned, bent or changed its material; its light is what the lamp sends there now, or sent
// then. What this does not know is what the sample cannot tell: whether something stands between the place and its lamp
// (rays ask, see `carried_ray`), and light from further surfaces, which stays what it was.
#include "lib/previous_lights.glsl"

// Whether anything that a sample knows may differ between the two frames.
#if defined(TARN_MOTION) || defined(TARN_LIGHT_HISTORY)
#define TARN_PATHS_CHANGE
#endif

PathPlace load_previous_place(PlacedSample drawn) {
#ifdef TARN_MOTION
    return load_place_at(drawn.path, frame_history.x);
#else
    return drawn.place;
#endif
}

// ---- The move

#ifdef TARN_PATHS_CHANGE
// Whether the surface of a thing may look another way than in the last frame: it moves, bends, or has another material.
bool is_changed(uint instance) {
    InstanceRecord now = load_instance(instance);
    InstanceRecord then = load_instance(instance + frame_history.x);
    return frame_history.w != 0u || now.first_vertex != then.first_vertex ||
           now.world_from_object[0] != then.world_from_object[0] ||
           now.world_from_object[1] != then.world_from_object[1] ||
           now.world_from_object[2] != then.world_from_object[2];
}

// Normal and material at `place`, which is that of the path in the frame whose instances stand `instance_offset` behind
// these. Rounded as samples are in memory.
void renew_surface(inout PathSample path, PathPlace place, uint instance_offset) {
#ifndef TARN_PLANT_KEEP_PATH_NORMAL
    // A loop that runs at most once: a software GPU skips it where no lane enters.
    uint changed = is_changed(path.instance) ? 1u : 0u;
    for (; changed != 0u; changed = 0u) {
        ShadingPoint point =
            evaluate_surface(path.instance + instance_offset, path.primitive & ~PATH_BACK_FACE,
                             path.barycentrics, -place.normal)
                .point;
        path.shading_normal = unpack_direction(pack_direction(point.shading_normal));
        path.material = unpack_surface_material(pack_surface_material(point.material));
    }
#endif
}

// What `before` sent to the place is now what `after` sends. `area_ratio`: of the lamp, after over before. The weight of
// next-event estimation (1 / density on the lamp) grows with its area.
void relight(inout PathSample path, IncidentLight before, IncidentLight after, float area_ratio) {
#ifdef TARN_PLANT_DROP_LAMP_AREA
    area_ratio = 1.0f;
#endif
    float weight = ratio_or_zero(dot(path.incident, vec3(1.0f)), dot(before.value, vec3(1.0f)));
    path.incident = after.value * (weight * area_ratio);
    path.incident_direction = after.direction;
}

float lamp_area_ratio(Light before, Light after) {
    return is_triangle(before) ? ratio_or_zero(triangle_area(after), triangle_area(before)) : 1.0f;
}

// Light from behind the surface reflects nothing, whatever the shading normal says (reflect_light_parts).
void drop_light_from_behind(inout PathSample path, PathPlace place) {
    if (dot(place.normal, path.incident_direction) <= 0.0f) path.incident = vec3(0.0f);
}

// A sample whose lamp is no more.
void lose_lamp(inout PathSample path) {
    path.light.light = INVALID_INDEX;
    path.incident = vec3(0.0f);
}

// The lamp that was `before` is `after`, row `index` of the other frame's table; the place goes along, `from` one point `to`
// another.
void follow_lamp(inout PathSample path, Light before, Light after, uint index, vec3 from, vec3 to) {
    vec2 uv = path.light.uv;
    relight(path, incident_from_light(before, uv, from), incident_from_light(after, uv, to),
            lamp_area_ratio(before, after));
    path.light.light = index;
    if (index == INVALID_INDEX) lose_lamp(path);
}

// A sample of the last frame in this one.
SAMPLE move_to_present(SAMPLE drawn) {
    if (!is_sample(drawn)) return drawn;
    PathPlace then = load_previous_place(drawn);
#ifdef TARN_PLANT_STAY_BEHIND
    drawn.place = then;
#endif
    renew_surface(drawn.path, drawn.place, 0u);
#ifndef TARN_PLANT_STALE_LIGHT
    if (is_in_light_table(drawn.path.light)) {
        Light before = load_previous_light(drawn.path.light.light);
        uint index = remap_light(drawn.path.light.light, false);
        Light after = load_light(index == INVALID_INDEX ? 0u : index);
        follow_lamp(drawn.path, before, after, index, then.position, drawn.place.position);
    }
#endif
    drop_light_from_behind(drawn.path, drawn.place);
    return drawn;
}

// A sample of this frame as the last one would have known it. Its `place` stays that of the present.
SAMPLE move_to_previous(SAMPLE drawn) {
    if (!is_sample(drawn)) return drawn;
    PathPlace then = load_previous_place(drawn);
    renew_surface(drawn.path, then, frame_history.x);
#ifndef TARN_PLANT_STALE_LIGHT
    if (is_in_light_table(drawn.path.light)) {
        Light before = load_light(drawn.path.light.light);
        uint index = remap_light(drawn.path.light.light, true);
        Light after = load_previous_light(index == INVALID_INDEX ? 0u : index);
        follow_lamp(drawn.path, before, after, index, drawn.place.position, then.position);
    }
#endif
    drop_light_from_behind(drawn.path, then);
    return drawn;
}
#else
SAMPLE move_to_previous(SAMPLE drawn) { return drawn; }
SAMPLE move_to_present(SAMPLE drawn) { return drawn; }
#endif

// ---- The light that a sample carries

// That it was seen from the place was asked when the sample was drawn. While things move it may no longer be so, or it was
// not yet so in the last frame. lib/reuse/temporal.glsl asks again where the frame says so.
#ifdef TARN_PATHS_CHANGE
#define TARN_CARRIED_LIGHT

// Whether a ray can ask: of light from further surfaces nobody knows what it was.
bool can_ask_for_carried(SAMPLE drawn) { return drawn.path.light.light != INVALID_INDEX; }

RayRecord ray_to_lamp(PathSample path, PathPlace place, IncidentLight incident, float light_error,
                      ivec2 pixel) {
    if (!(max_component(path.incident) > 0.0f) || !(max_component(incident.value) > 0.0f))
        return inactive_ray();
    ShadingPoint point;
    point.position = place.position;
    point.position_error = place.error;
    point.geometric_normal = place.normal;
    return make_shadow_ray(point, incident, light_error, pixel_index(pixel));
}

// From the place of a sample of this frame to its lamp.
RayRecord carried_ray(SAMPLE drawn, ivec2 pixel) {
    LightSample lamp = drawn.path.light;
    return ray_to_lamp(drawn.path, drawn.place, load_incident_light(lamp, drawn.place.position),
                       load_light_error(lamp), pixel);
}

// The same in the last frame, of a sample that was moved there.
RayRecord previous_carried_ray(SAMPLE drawn, ivec2 pixel) {
    PathPlace place = load_previous_place(drawn);
    LightSample lamp = drawn.path.light;
    RayRecord ray = ray_to_lamp(drawn.path, place, load_previous_incident_light(lamp, place.position),
                                load_previous_light_error(lamp), pixel);
    ray.pixel |= RAY_PREVIOUS;
    return ray;
}
#endif

// ---- The Jacobian

// Area of the sample's triangle now over then.
float area_ratio(SAMPLE drawn) {
#if defined(TARN_MOTION) && !defined(TARN_PLANT_DROP_AREA_RATIO)
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
    if (!reconnects(present) || !reconnects(previous)) return 0.0f;
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
    return path_target(previous,
                       place_light(drawn.path, load_previous_place(drawn), previous.point.position));
}

// A ray of the last frame: to where the place was, past what stood in its way then.
RayRecord previous_sample_ray(Receiver previous, SAMPLE drawn, ivec2 pixel) {
    RayRecord ray = place_ray(previous, drawn.path, load_previous_place(drawn), pixel);
    ray.pixel |= RAY_PREVIOUS;
    return ray;
}
