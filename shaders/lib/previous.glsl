// The last frame: where a surface was, and who looked at it.
//
// After lib/frame.glsl and lib/receiver.glsl. Without TARN_MOTION no surface ever moved.

layout(binding = UNIT_PREVIOUS_SURFACE) uniform sampler2DArray previous_layers;

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

// The pixel through which the last frame's camera saw `position`; outside of the picture where it did not.
ivec2 project_to_previous(vec3 position) {
    CameraRecord camera = previous_camera();
    vec3 to_point = position - camera.position;
    float depth = camera.orthographic ? 1.0f : dot(to_point, camera.forward);
    if (!(depth > 0.0f)) return ivec2(-1);
    float x = dot(to_point, camera.right) / (dot(camera.right, camera.right) * depth);
    float y = dot(to_point, camera.up) / (dot(camera.up, camera.up) * depth);
    vec2 position_px = vec2(0.5f + 0.5f * x, 0.5f - 0.5f * y) * vec2(frame_size.xy) - frame_jitter.zw;
    // Compared as floats: what lies far outside has no integer.
    if (!(position_px.x >= 0.0f && position_px.y >= 0.0f && position_px.x < float(frame_size.x) &&
          position_px.y < float(frame_size.y)))
        return ivec2(-1);
    return ivec2(position_px);
}

// The receiver that `pixel` was in the last frame; false where nothing was lit.
bool load_previous_receiver(ivec2 pixel, out Receiver r) {
    ShadingPoint point = unpack_shading_point(texelFetch(previous_layers, ivec3(pixel, LAYER_POSITION), 0),
                                              texelFetch(previous_layers, ivec3(pixel, LAYER_NORMALS), 0),
                                              texelFetch(previous_layers, ivec3(pixel, LAYER_DIFFUSE), 0),
                                              texelFetch(previous_layers, ivec3(pixel, LAYER_SPECULAR), 0));
    vec2 position_px = vec2(pixel) + 0.5f + frame_jitter.zw;
    vec3 direction = camera_ray(previous_camera(), position_px, vec2(frame_size.xy)).direction;
    r = make_receiver(point, -direction);
    return point.position_error >= 0.0f;
}

// What lib/neighbour_test.glsl looks at; false where nothing was lit.
bool load_previous_look(ivec2 pixel, out Look look) {
    vec4 position = texelFetch(previous_layers, ivec3(pixel, LAYER_POSITION), 0);
    look = look_of_layers(position, texelFetch(previous_layers, ivec3(pixel, LAYER_NORMALS), 0),
                          texelFetch(previous_layers, ivec3(pixel, LAYER_DIFFUSE), 0));
    return position.w >= 0.0f;
}
