// The last frame: where a surface was, who looked at it, and what its lights were like.
//
// After lib/scene_buffers.glsl, lib/frame.glsl and lib/receiver.glsl. Without TARN_LIGHT_HISTORY no light ever changed,
// without TARN_MOTION no surface ever moved; both are then compiled out.

layout(binding = UNIT_PREVIOUS_SURFACE) uniform sampler2DArray previous_layers;

CameraRecord previous_camera() {
    return unpack_camera(frame_previous_position, frame_previous_right, frame_previous_up, frame_previous_forward);
}

// Where the surface of `pixel` was in the last frame, relative to the world's origin.
vec3 previous_position(ivec2 pixel) {
#ifdef TARN_MOTION
    return load_layer(pixel, LAYER_MOTION).xyz;
#else
    return load_layer(pixel, LAYER_POSITION).xyz;
#endif
}

// The pixel through which the last frame's camera saw `position`; outside of the picture where it did not.
ivec2 project_to_previous(vec3 position) {
    CameraRecord camera = previous_camera();
    vec3 to_point = position - camera.position;
    float depth = camera.orthographic ? 1.0f : dot(to_point, camera.forward);
    if (!(depth > 0.0f)) return ivec2(-1);
    float x = dot(to_point, camera.right) / (dot(camera.right, camera.right) * depth);
    float y = dot(to_point, camera.up) / (dot(camera.up, camera.up) * depth);
    vec2 position_px = vec2(0.5f + 0.5f * x, 0.5f - 0.5f * y) * vec2(frame_size.xy);
    // Compared as floats: what lies far outside has no integer.
    if (!(position_px.x >= 0.0f && position_px.y >= 0.0f && position_px.x < float(frame_size.x) &&
          position_px.y < float(frame_size.y)))
        return ivec2(-1);
    return ivec2(position_px);
}

// The receiver that `pixel` was in the last frame; false where nothing was lit.
bool load_previous_receiver(ivec2 pixel, out Receiver r) {
    ShadingPoint point = unpack_shading_point(
        texelFetch(previous_layers, ivec3(pixel, LAYER_POSITION), 0),
        texelFetch(previous_layers, ivec3(pixel, LAYER_NORMALS), 0),
        texelFetch(previous_layers, ivec3(pixel, LAYER_DIFFUSE), 0),
        texelFetch(previous_layers, ivec3(pixel, LAYER_SPECULAR), 0));
    vec3 direction = camera_ray(previous_camera(), vec2(pixel) + 0.5f, vec2(frame_size.xy)).direction;
    r = make_receiver(point, -direction);
    return point.position_error >= 0.0f;
}

// ---- Lights

#ifdef TARN_LIGHT_HISTORY
bool is_in_light_table(LightSample drawn) { return drawn.light < LIGHT_ENVIRONMENT; }

uint remap_light(uint light, bool to_past) {
#ifdef TARN_PLANT_NO_REMAP
    if (!to_past) return light;
#endif
    if (frame_history.z == INVALID_INDEX) return light;
    uvec4 row = fetch_light_row(frame_history.z + light);
    return to_past ? row.x : row.y;
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
    return light_error(load_previous_light(drawn.light));
}

// A sample of this frame in terms of the last one, and the reverse; no sample where the light does not exist in the
// other frame.
LightSample move_to_past(LightSample drawn) {
    if (is_in_light_table(drawn)) drawn.light = remap_light(drawn.light, true);
    return drawn;
}
LightSample move_to_present(LightSample drawn) {
    if (is_in_light_table(drawn)) drawn.light = remap_light(drawn.light, false);
    return drawn;
}

// |dT/dx| of the shift from the last frame: samples keep their place on the light, whose area may have changed.
// `present` and `past` are the same sample in both frames.
float shift_jacobian(LightSample present, LightSample past) {
    if (!is_in_light_table(present) || !is_in_light_table(past)) return 1.0f;
    Light now = load_light(present.light);
    if (!is_triangle(now)) return 1.0f;
    return ratio_or_zero(triangle_area(now), triangle_area(load_previous_light(past.light)));
}
#else
IncidentLight load_previous_incident_light(LightSample drawn, vec3 point) { return load_incident_light(drawn, point); }
float load_previous_light_error(LightSample drawn) { return load_light_error(drawn); }
LightSample move_to_past(LightSample drawn) { return drawn; }
LightSample move_to_present(LightSample drawn) { return drawn; }
float shift_jacobian(LightSample present, LightSample past) { return 1.0f; }
#endif
