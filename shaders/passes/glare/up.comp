// A step up the pyramid of glare: what wider steps have spread, enlarged, and this step's own light.
#include "shared/interface/bindings.h"
#include "lib/glare.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D own_light;
layout(binding = UNIT_PASS_B) uniform sampler2D wider_light;
layout(binding = 0, rgba32f) writeonly uniform image2D out_picture;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size_px = imageSize(out_picture);
    if (pixel.x >= size_px.x || pixel.y >= size_px.y) return;
    vec3 light = texelFetch(own_light, pixel, 0).xyz + load_enlarged(wider_light, pixel);
    imageStore(out_picture, pixel, vec4(light, 0.0f));
}
