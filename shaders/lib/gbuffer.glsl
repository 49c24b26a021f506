// Reading the G-buffer. Layout: shaders/passes/gbuffer/resolve.comp.
#include "shared/interface/bindings.h"
#include "shared/math/packing.h"
#include "shared/math/shading.h"

layout(binding = UNIT_SURFACE) uniform sampler2DArray surface_layers;

vec4 load_layer(ivec2 pixel, int layer) { return texelFetch(surface_layers, ivec3(pixel, layer), 0); }

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
