// Reading the G-buffer. Layout: shaders/passes/gbuffer/resolve.comp.
#include "shared/interface/bindings.h"
#include "shared/math/packing.h"
#include "shared/math/shading.h"

layout(binding = UNIT_POSITION) uniform sampler2D gbuffer_position;
layout(binding = UNIT_NORMALS) uniform sampler2D gbuffer_normals;
layout(binding = UNIT_DIFFUSE) uniform sampler2D gbuffer_diffuse;
layout(binding = UNIT_SPECULAR) uniform sampler2D gbuffer_specular;

// False where there is nothing to be lit: sky, and unlit materials.
bool load_shading_point(ivec2 pixel, out ShadingPoint p) {
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    vec4 normals = texelFetch(gbuffer_normals, pixel, 0);
    vec4 diffuse = texelFetch(gbuffer_diffuse, pixel, 0);
    vec4 specular = texelFetch(gbuffer_specular, pixel, 0);
    p.position = position.xyz;
    p.position_error = position.w;
    p.geometric_normal = decode_octahedral(normals.xy);
    p.shading_normal = decode_octahedral(normals.zw);
    p.material.diffuse_albedo = diffuse.xyz;
    p.material.alpha = diffuse.w;
    p.material.f0 = specular.xyz;
    p.material.f90 = specular.w;
    return position.w >= 0.0f;
}
