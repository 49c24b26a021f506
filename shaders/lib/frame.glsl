// The frame's camera, size and random key.
#include "shared/interface/frame_block.h"
#include "shared/interface/records.h"
#include "shared/math/random.h"

// As the frame block stores it: whether it is orthographic stands beside its position.
CameraRecord unpack_camera(vec4 position, vec4 right, vec4 up, vec4 forward) {
    CameraRecord camera;
    camera.position = position.xyz;
    camera.right = right.xyz;
    camera.up = up.xyz;
    camera.forward = forward.xyz;
    camera.orthographic = position.w != 0.0f;
    return camera;
}

CameraRecord frame_camera() {
    return unpack_camera(frame_camera_position, frame_camera_right, frame_camera_up, frame_camera_forward);
}

// The pixel of the picture that `pixel` is. They differ where passes work on a coarse picture, which takes one pixel of
// each block of the picture, the last row and column where `offset` lies beyond them.
ivec2 full_pixel_at(ivec2 pixel, uvec2 offset) {
    return min(pixel * int(frame_full.z) + ivec2(offset), ivec2(frame_full.xy) - 1);
}

ivec2 full_pixel(ivec2 pixel) { return full_pixel_at(pixel, frame_offset.xy); }

PixelRay pixel_ray(ivec2 pixel) {
#ifdef TARN_PLANT_FORGET_OFFSET
    vec2 position_px = vec2(full_pixel_at(pixel, uvec2(0u))) + 0.5f + frame_jitter.xy;
#else
    vec2 position_px = vec2(full_pixel(pixel)) + 0.5f + frame_jitter.xy;
#endif
    return camera_ray(frame_camera(), position_px, vec2(frame_full.xy));
}

uint pixel_index(ivec2 pixel) { return uint(pixel.y) * frame_size.x + uint(pixel.x); }

RandomKey pixel_key(ivec2 pixel) {
    RandomKey key;
    key.pixel = pixel_index(pixel);
    key.frame = frame_size.z;
    key.seed = frame_size.w;
    return key;
}

bool is_outside(ivec2 pixel) { return pixel.x >= int(frame_size.x) || pixel.y >= int(frame_size.y); }
