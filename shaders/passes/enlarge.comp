// A picture at another size, by bilinear interpolation between pixel centres; what lies beyond the outermost centres
// takes their value. For enlarging: a smaller picture would skip pixels.
#include "shared/interface/bindings.h"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D small_picture;
layout(binding = 0, rgba32f) writeonly uniform image2D out_picture;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size_px = imageSize(out_picture);
    if (pixel.x >= size_px.x || pixel.y >= size_px.y) return;
    ivec2 last = textureSize(small_picture, 0) - 1;
    vec2 place = (vec2(pixel) + 0.5f) * vec2(last + 1) / vec2(size_px) - 0.5f;
    vec2 inside = clamp(place, vec2(0.0f), vec2(last));
    ivec2 first = ivec2(inside);
    ivec2 second = min(first + 1, last);
    vec2 share = inside - vec2(first);
    vec4 above = mix(texelFetch(small_picture, first, 0),
                     texelFetch(small_picture, ivec2(second.x, first.y), 0), share.x);
    vec4 below = mix(texelFetch(small_picture, ivec2(first.x, second.y), 0),
                     texelFetch(small_picture, second, 0), share.x);
    imageStore(out_picture, pixel, mix(above, below, share.y));
}
