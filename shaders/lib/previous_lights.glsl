// Lights in the last frame: what they were like. After lib/scene_buffers.glsl. Without TARN_LIGHT_HISTORY no light ever
// changed.

bool is_in_light_table(LightSample drawn) { return drawn.light < LIGHT_ENVIRONMENT; }

#ifdef TARN_LIGHT_HISTORY
uint remap_light(uint light, bool to_previous) {
#ifdef TARN_PLANT_NO_REMAP
    if (!to_previous) return light;
#endif
    if (frame_history.z == INVALID_INDEX) return light;
    uvec4 row = fetch_light_row(frame_history.z + light);
    return to_previous ? row.x : row.y;
}

// As the last frame knew it: the light's instance is the last frame's, with its vertices and its material, and its
// emission map follows the last frame's rows.
Light load_previous_light(uint light) {
    uint row = frame_history.y + light * LIGHT_ROWS;
    Light previous = unpack_light(fetch_light_row(row), fetch_light_row(row + 1u), fetch_light_row(row + 2u),
                                  fetch_light_row(row + 3u));
    previous.instance += frame_history.x;
    if (SCENE_HAS_TEXTURED_LIGHTS && is_triangle(previous) && (previous.flags & LIGHT_TEXTURED) != 0u) {
        previous.range = uintBitsToFloat(floatBitsToUint(previous.range) + frame_history.y);
    }
    return previous;
}

IncidentLight load_previous_incident_light(LightSample drawn, vec3 point) {
    if (!is_in_light_table(drawn)) return load_incident_light(drawn, point);
    return incident_from_light(load_previous_light(drawn.light), drawn.uv, point);
}

float load_previous_light_error(LightSample drawn) {
    if (!is_in_light_table(drawn)) return 0.0f;
    return unpack_light_error(fetch_light_row(frame_history.y + drawn.light * LIGHT_ROWS));
}

#else
uint remap_light(uint light, bool to_previous) { return light; }
Light load_previous_light(uint light) { return load_light(light); }
IncidentLight load_previous_incident_light(LightSample drawn, vec3 point) {
    return load_incident_light(drawn, point);
}
float load_previous_light_error(LightSample drawn) { return load_light_error(drawn); }
#endif
