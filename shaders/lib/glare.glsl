// Reading a picture of the pyramid of glare at twice its size.
#include "shared/math/glare.h"

vec3 load_enlarged(sampler2D cells, ivec2 pixel) {
    ivec2 count = textureSize(cells, 0);
    ivec2 near = pixel / 2;
    ivec2 far = ivec2(glare_neighbour(pixel.x, count.x), glare_neighbour(pixel.y, count.y));
    vec3 near_row =
        mix(texelFetch(cells, near, 0).xyz, texelFetch(cells, ivec2(far.x, near.y), 0).xyz, 0.25f);
    vec3 far_row = mix(texelFetch(cells, ivec2(near.x, far.y), 0).xyz, texelFetch(cells, far, 0).xyz, 0.25f);
    return mix(near_row, far_row, 0.25f);
}
