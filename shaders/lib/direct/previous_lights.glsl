// Light samples in the last frame: the shift in time, which keeps a sample's light and its place on it.
#include "lib/previous_lights.glsl"

#ifdef TARN_LIGHT_HISTORY
// A sample of this frame as the last one would have known it, and back; no sample where the light was not, or is no
// more.
SAMPLE move_to_previous(SAMPLE drawn) {
    if (is_in_light_table(drawn)) drawn.light = remap_light(drawn.light, true);
    return drawn;
}
SAMPLE move_to_present(SAMPLE drawn) {
    if (is_in_light_table(drawn)) drawn.light = remap_light(drawn.light, false);
    return drawn;
}

// |dT/dx| of the move from the last frame to this one, of a sample that is `present` here and `previous` there. Its
// place on the light stays, the light's area may not.
float move_jacobian(SAMPLE present, SAMPLE previous) {
    if (!is_in_light_table(present) || !is_in_light_table(previous)) return 1.0f;
    Light now = load_light(present.light);
    if (!is_triangle(now)) return 1.0f;
    return ratio_or_zero(triangle_area(now), triangle_area(load_previous_light(previous.light)));
}
#else
SAMPLE move_to_previous(SAMPLE drawn) { return drawn; }
SAMPLE move_to_present(SAMPLE drawn) { return drawn; }
float move_jacobian(SAMPLE present, SAMPLE previous) { return 1.0f; }
#endif

// |dT/dx| from the previous receiver in the last frame to this one in the present: receivers share their domain.
float temporal_jacobian(Receiver previous_receiver, Receiver here, SAMPLE present, SAMPLE previous) {
    return move_jacobian(present, previous);
}

// p-hat in the last frame, of a receiver and a sample of the last frame.
float previous_sample_target(Receiver previous, SAMPLE drawn) {
    return target_at(previous, load_previous_incident_light(drawn, previous.point.position));
}

// A ray of the last frame: to where the light was, past what stood in its way then.
RayRecord previous_sample_ray(Receiver previous, SAMPLE drawn, ivec2 pixel) {
    IncidentLight incident = load_previous_incident_light(drawn, previous.point.position);
    if (!(max_component(incident.value) > 0.0f)) return inactive_ray();
    RayRecord ray =
        make_shadow_ray(previous.point, incident, load_previous_light_error(drawn), pixel_index(pixel));
#ifndef TARN_PLANT_PRESENT_GEOMETRY
    ray.pixel |= RAY_PREVIOUS;
#endif
    return ray;
}
