// Draws a light by the tree for each point of a table, or gives the probability of a given one.
#include "shared/dialect.h"
#include "shared/interface/records.h"
#include "shared/math/alias_table.h"
#include "shared/math/environment.h"
#include "shared/math/light_tree.h"
#include "shared/math/random.h"
#include "shared/math/ray_offset.h"
#include "shared/math/light_sample.h"
#include "shared/math/spherical_triangle.h"
#include "shared/math/shading.h"
#include "shared/math/texture_filter.h"

layout(local_size_x = 64) in;

// position, light; normal; random bits
layout(std430, binding = 0) readonly buffer Inputs { uvec4 inputs[]; };
// drawn light, its probability, probability of the light asked for, density of the candidate
layout(std430, binding = 1) writeonly buffer Outputs { uvec4 outputs[]; };
layout(std430, binding = 2) readonly buffer Lights { uvec4 light_rows[]; };
layout(std430, binding = 3) readonly buffer Tree { uvec4 tree_rows[]; };

uniform uint node_count;

#define SCENE_HAS_TEXTURES false
#define SCENE_HAS_NORMAL_MAPS false
#define SCENE_HAS_ENVIRONMENT false
#define SCENE_HAS_PUNCTUAL_LIGHTS true
#define SCENE_HAS_TRIANGLE_LIGHTS true
#define SCENE_HAS_TEXTURED_LIGHTS false
#define SCENE_HAS_COVERED_LIGHTS false

uvec4 fetch_light_row(uint row) { return light_rows[row]; }
uvec4 fetch_light_tree_row(uint row) { return tree_rows[row]; }
uint get_light_tree_node_count() { return node_count; }

// What drawing a light does not ask for.
uint get_light_count() { return 0u; }
uvec4 fetch_vertex_row(uint row) { return uvec4(0u); }
uvec3 fetch_triangle(uint triangle) { return uvec3(0u); }
uvec4 fetch_instance_row(uint row) { return uvec4(0u); }
uvec4 fetch_material_row(uint row) { return uvec4(0u); }
vec4 fetch_texel(uint texel) { return vec4(0.0); }
uvec4 fetch_light_alias_row(uint row) { return uvec4(0u); }
vec4 fetch_environment_texel(uint texel) { return vec4(0.0); }
uvec4 fetch_environment_alias_row(uint row) { return uvec4(0u); }
uvec2 get_environment_size() { return uvec2(0u); }

#include "shared/scene/surface.h"
#include "shared/scene/lights.h"
#include "shared/scene/light_tree.h"

void main() {
    uint i = gl_GlobalInvocationID.x;
    uvec4 row = inputs[3u * i];
    vec3 position = row_xyz(row);
    vec3 normal = row_xyz(inputs[3u * i + 1u]);
    uvec4 bits = inputs[3u * i + 2u];
    DiscreteSample drawn = choose_light_by_tree(bits, position, normal);
    LightCandidate candidate = draw_light_by_tree(bits, position, normal);
    outputs[i] = uvec4(drawn.index, floatBitsToUint(drawn.pmf),
                       floatBitsToUint(light_tree_pmf(row.w, position, normal)), floatBitsToUint(candidate.pdf));
}
