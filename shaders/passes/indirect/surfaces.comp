// The surfaces of a coarse picture: each of its pixels is one pixel of the picture, never a mean of several, so that
// rays which leave it start on a surface. Runs with the coarse picture's frame block.
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/pixel_group.glsl"

layout(binding = 0, rgba32f) writeonly uniform image2D out_position;
layout(binding = 1, rgba32f) writeonly uniform image2D out_normals;
layout(binding = 2, rgba32f) writeonly uniform image2D out_diffuse;
layout(binding = 3, rgba32f) writeonly uniform image2D out_specular;
#ifdef TARN_MOTION
layout(binding = 4, rgba32f) writeonly uniform image2D out_motion;
#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    ivec2 full = full_pixel(pixel);
    imageStore(out_position, pixel, load_layer(full, LAYER_POSITION));
    imageStore(out_normals, pixel, load_layer(full, LAYER_NORMALS));
    imageStore(out_diffuse, pixel, load_layer(full, LAYER_DIFFUSE));
    imageStore(out_specular, pixel, load_layer(full, LAYER_SPECULAR));
#ifdef TARN_MOTION
    imageStore(out_motion, pixel, load_layer(full, LAYER_MOTION));
#endif
}
