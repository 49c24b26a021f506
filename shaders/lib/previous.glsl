// The last frame: where a surface was, and who looked at it.
//
// After lib/frame.glsl and lib/receiver.glsl. Without TARN_MOTION no surface ever moved.

#include "lib/previous_camera.glsl"

layout(binding = UNIT_PREVIOUS_SURFACE) uniform samplerBuffer previous_texels;

// The pixel through which the last frame's camera saw `position`, of a coarse picture the one whose block holds it;
// outside of the picture where it did not.
ivec2 project_to_previous(vec3 position) {
    vec2 position_px = find_previous_place(position);
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

vec4 load_previous_layer(ivec2 pixel, int layer) {
    return texelFetch(previous_texels, surface_texel(frame_size.x, pixel, layer));
}

// What lib/neighbour_test.glsl looks at, as the G-buffer has it.
struct PreviousLayers {
    vec4 position;
    vec4 normals;
    vec4 diffuse;
};

PreviousLayers load_previous_layers(ivec2 pixel) {
    return PreviousLayers(load_previous_layer(pixel, LAYER_POSITION),
                          load_previous_layer(pixel, LAYER_NORMALS),
                          load_previous_layer(pixel, LAYER_DIFFUSE));
}

bool was_lit(PreviousLayers layers) { return layers.position.w >= 0.0f; }

// The receiver that `pixel` was in the last frame, of which `layers` were loaded; it means nothing where nothing was lit.
Receiver load_previous_receiver(ivec2 pixel, PreviousLayers layers) {
    ShadingPoint point = unpack_shading_point(layers.position, layers.normals, layers.diffuse,
                                              load_previous_layer(pixel, LAYER_SPECULAR));
    return make_receiver(point, -previous_pixel_ray(pixel).direction);
}
