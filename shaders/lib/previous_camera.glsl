// Where surfaces were in the last frame, and where its camera saw them.
//
// After lib/frame.glsl and lib/gbuffer.glsl. Without TARN_MOTION no surface ever moved.

CameraRecord previous_camera() {
    return unpack_camera(frame_previous_position, frame_previous_right, frame_previous_up,
                         frame_previous_forward);
}

// Where the surface of `pixel` was in the last frame, relative to the world's origin.
vec3 previous_position(ivec2 pixel) {
#ifdef TARN_MOTION
    return load_layer(pixel, LAYER_MOTION).xyz;
#else
    return load_layer(pixel, LAYER_POSITION).xyz;
#endif
}

// Where in the picture `camera` sees `position`, pixels from its corner. Far outside where it does not.
vec2 find_place(CameraRecord camera, vec3 position) {
    const vec2 NOWHERE = vec2(-1e6f);
    vec3 to_point = position - camera.position;
    float depth = camera.orthographic ? 1.0f : dot(to_point, camera.forward);
    if (!(depth > 0.0f)) return NOWHERE;
    float x = dot(to_point, camera.right) / (dot(camera.right, camera.right) * depth);
    float y = dot(to_point, camera.up) / (dot(camera.up, camera.up) * depth);
    return vec2(0.5f + 0.5f * x, 0.5f - 0.5f * y) * vec2(frame_full.xy);
}

// Where the last frame's camera saw `position`: what pixel (0, 0) showed is at (0.5, 0.5).
vec2 find_previous_place(vec3 position) { return find_place(previous_camera(), position) - frame_jitter.zw; }
