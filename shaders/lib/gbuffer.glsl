// Reading the G-buffer. Layout: shaders/passes/gbuffer/resolve.comp.
#include "shared/interface/bindings.h"
#include "shared/interface/frame_block.h"
#include "lib/surface_texels.glsl"
#include "shared/math/packing.h"
#include "shared/math/shading.h"

layout(binding = UNIT_SURFACE) uniform samplerBuffer surface_texels;

// Of a picture `width_px` wide; `pixel` lies within it.
vec4 load_layer_of(uint width_px, ivec2 pixel, int layer) {
    return texelFetch(surface_texels, surface_texel(width_px, pixel, layer));
}

vec4 load_layer(ivec2 pixel, int layer) { return load_layer_of(frame_size.x, pixel, layer); }

ShadingPoint unpack_shading_point(vec4 position, vec4 normals, vec4 diffuse, vec4 specular) {
    ShadingPoint p;
    p.position = position.xyz;
    p.position_error = position.w;
    p.geometric_normal = decode_octahedral(normals.xy);
    p.shading_normal = decode_octahedral(normals.zw);
    p.material.diffuse_albedo = diffuse.xyz;
    p.material.alpha = diffuse.w;
    p.material.f0 = specular.xyz;
    p.material.f90 = specular.w;
    return p;
}

// False where there is nothing to be lit: sky, and unlit materials.
bool load_shading_point(ivec2 pixel, out ShadingPoint p) {
    p = unpack_shading_point(load_layer(pixel, LAYER_POSITION), load_layer(pixel, LAYER_NORMALS),
                             load_layer(pixel, LAYER_DIFFUSE), load_layer(pixel, LAYER_SPECULAR));
    return p.position_error >= 0.0f;
}
