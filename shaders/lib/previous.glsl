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

// The pixel through which the last frame's camera saw `position`, of a coarse picture the one whose block holds it;
// outside of the picture where it did not.
ivec2 project_to_previous(vec3 position) {
    CameraRecord camera = previous_camera();
    vec3 to_point = position - camera.position;
    float depth = camera.orthographic ? 1.0f : dot(to_point, camera.forward);
    if (!(depth > 0.0f)) return ivec2(-1);
    float x = dot(to_point, camera.right) / (dot(camera.right, camera.right) * depth);
    float y = dot(to_point, camera.up) / (dot(camera.up, camera.up) * depth);
    vec2 position_px = vec2(0.5f + 0.5f * x, 0.5f - 0.5f * y) * vec2(frame_full.xy) - frame_jitter.zw;
    // Compared as floats: what lies far outside has no integer.
    if (!(position_px.x >= 0.0f && position_px.y >= 0.0f && position_px.x < float(frame_full.x) &&
          position_px.y < float(frame_full.y)))
        return ivec2(-1);
    return ivec2(position_px) / int(frame_full.z);
}

// The last frame's ray through `pixel`.
PixelRay previous_pixel_ray(ivec2 pixel) {
#ifdef TARN_PLANT_PRESENT_OFFSET
    ivec2 full = full_pixel(pixel);
#else
    ivec2 full = full_pixel_at(pixel, frame_offset.zw);
#endif
    return camera_ray(previous_camera(), vec2(full) + 0.5f + frame_jitter.zw, vec2(frame_full.xy));
}

// The receiver that `pixel` was in the last frame; false where nothing was lit.
bool load_previous_receiver(ivec2 pixel, out Receiver r) {
    ShadingPoint point = unpack_shading_point(texelFetch(previous_layers, ivec3(pixel, LAYER_POSITION), 0),
                                              texelFetch(previous_layers, ivec3(pixel, LAYER_NORMALS), 0),
                                              texelFetch(previous_layers, ivec3(pixel, LAYER_DIFFUSE), 0),
                                              texelFetch(previous_layers, ivec3(pixel, LAYER_SPECULAR), 0));
    r = make_receiver(point, -previous_pixel_ray(pixel).direction);
    return point.position_error >= 0.0f;
}

// What lib/neighbour_test.glsl looks at; false where nothing was lit.
bool load_previous_look(ivec2 pixel, out Look look) {
    vec4 position = texelFetch(previous_layers, ivec3(pixel, LAYER_POSITION), 0);
    look = look_of_layers(position, texelFetch(previous_layers, ivec3(pixel, LAYER_NORMALS), 0),
                          texelFetch(previous_layers, ivec3(pixel, LAYER_DIFFUSE), 0));
    return position.w >= 0.0f;
}
