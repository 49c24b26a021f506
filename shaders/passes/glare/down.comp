// A step down the pyramid of glare: half as wide and high. TARN_GLARE_FIRST: from the picture, what is brighter than
// white. See shared/math/glare.h.
#include "shared/interface/bindings.h"
#include "shared/math/display.h"
#include "shared/math/glare.h"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D large_picture;
layout(binding = UNIT_PASS_B) uniform usamplerBuffer exposure;
layout(binding = 0, rgba32f) writeonly uniform image2D out_picture;

vec4 load_light(ivec2 pixel, float exposure_scale) {
    vec4 light = texelFetch(large_picture, pixel, 0);
#ifdef TARN_GLARE_FIRST
    return vec4(find_excess(expose(light.xyz, exposure_scale)), 1.0f);
#else
    return light;
#endif
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    ivec2 cells = imageSize(out_picture);
    if (cell.x >= cells.x || cell.y >= cells.y) return;
    float scale = 1.0f;
#ifdef TARN_GLARE_FIRST
    scale = uintBitsToFloat(texelFetch(exposure, 0).x);
#endif
    ivec2 size_px = textureSize(large_picture, 0);
    vec3 light = vec3(0.0f);
    float area = 0.0f;
    for (int row = 0; row < 4; ++row) {
        int y = glare_pixel(cell.y, row, size_px.y);
        for (int column = 0; column < 4; ++column) {
            int x = glare_pixel(cell.x, column, size_px.x);
            vec4 pixel = load_light(max(ivec2(x, y), ivec2(0)), scale);
            float weight = min(x, y) < 0 ? 0.0f : glare_weight(row) * glare_weight(column) * pixel.w;
            light += weight * pixel.xyz;
            area += weight;
        }
    }
    imageStore(out_picture, cell, vec4(light / area, area));
}
