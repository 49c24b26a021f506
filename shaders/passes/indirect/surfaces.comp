// The surfaces of a coarse picture: each of its pixels is one pixel of the picture, never a mean of several, so that
// rays which leave it start on a surface. Runs with the coarse picture's frame block.
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/pixel_group.glsl"

layout(binding = 0, rgba32f) writeonly uniform imageBuffer out_surface;

void thin(ivec2 pixel, int layer) {
    vec4 texel = load_layer_of(frame_full.x, full_pixel(pixel), layer);
    imageStore(out_surface, surface_texel(frame_size.x, pixel, layer), texel);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    thin(pixel, LAYER_POSITION);
    thin(pixel, LAYER_NORMALS);
    thin(pixel, LAYER_DIFFUSE);
    thin(pixel, LAYER_SPECULAR);
#ifdef TARN_MOTION
    thin(pixel, LAYER_MOTION);
#endif
}
