// The scene's tables as shaders read them: the fetch functions that shared/scene/*.h ask for.
#include "shared/dialect.h"
#include "shared/interface/bindings.h"
#include "shared/interface/frame_block.h"
#include "shared/interface/records.h"
#include "shared/math/alias_table.h"
#include "shared/math/environment.h"
#include "shared/math/random.h"
#include "shared/math/ray_offset.h"
#include "shared/math/light_sample.h"
#include "shared/math/spherical_triangle.h"
#include "shared/math/shading.h"
#include "shared/math/texture_filter.h"

// The plan defines as 1 what the scene has (plan/frame_plan.cpp).
#ifdef TARN_TEXTURES
#define SCENE_HAS_TEXTURES true
#else
#define SCENE_HAS_TEXTURES false
#endif
#ifdef TARN_NORMAL_MAPS
#define SCENE_HAS_NORMAL_MAPS true
#else
#define SCENE_HAS_NORMAL_MAPS false
#endif
#ifdef TARN_ENVIRONMENT
#define SCENE_HAS_ENVIRONMENT true
#else
#define SCENE_HAS_ENVIRONMENT false
#endif
#ifdef TARN_PUNCTUAL_LIGHTS
#define SCENE_HAS_PUNCTUAL_LIGHTS true
#else
#define SCENE_HAS_PUNCTUAL_LIGHTS false
#endif
#ifdef TARN_TRIANGLE_LIGHTS
#define SCENE_HAS_TRIANGLE_LIGHTS true
#else
#define SCENE_HAS_TRIANGLE_LIGHTS false
#endif
#ifdef TARN_TEXTURED_LIGHTS
#define SCENE_HAS_TEXTURED_LIGHTS true
#else
#define SCENE_HAS_TEXTURED_LIGHTS false
#endif
#ifdef TARN_COVERED_LIGHTS
#define SCENE_HAS_COVERED_LIGHTS true
#else
#define SCENE_HAS_COVERED_LIGHTS false
#endif

layout(binding = UNIT_VERTEX_ROWS) uniform usamplerBuffer scene_vertex_rows;
layout(binding = UNIT_TRIANGLES) uniform usamplerBuffer scene_triangles;
layout(binding = UNIT_INSTANCE_ROWS) uniform usamplerBuffer scene_instance_rows;
layout(binding = UNIT_MATERIAL_ROWS) uniform usamplerBuffer scene_material_rows;
layout(binding = UNIT_TEXELS) uniform samplerBuffer scene_texels;
layout(binding = UNIT_LIGHT_ROWS) uniform usamplerBuffer scene_light_rows;
layout(binding = UNIT_LIGHT_ALIAS) uniform usamplerBuffer scene_light_alias;
layout(binding = UNIT_ENVIRONMENT_TEXELS) uniform samplerBuffer scene_environment_texels;
layout(binding = UNIT_ENVIRONMENT_ALIAS) uniform usamplerBuffer scene_environment_alias;

uvec4 fetch_vertex_row(uint row) { return texelFetch(scene_vertex_rows, int(row)); }
uvec3 fetch_triangle(uint triangle) { return texelFetch(scene_triangles, int(triangle)).xyz; }
uvec4 fetch_instance_row(uint row) { return texelFetch(scene_instance_rows, int(row)); }
uvec4 fetch_material_row(uint row) { return texelFetch(scene_material_rows, int(row)); }
vec4 fetch_texel(uint texel) { return texelFetch(scene_texels, int(texel)); }
uvec4 fetch_light_row(uint row) { return texelFetch(scene_light_rows, int(row)); }
uvec4 fetch_light_alias_row(uint row) { return texelFetch(scene_light_alias, int(row)); }
vec4 fetch_environment_texel(uint texel) { return texelFetch(scene_environment_texels, int(texel)); }
uvec4 fetch_environment_alias_row(uint row) { return texelFetch(scene_environment_alias, int(row)); }
uint get_light_count() { return frame_lights.x; }
uvec2 get_environment_size() { return frame_lights.yz; }

#include "shared/scene/surface.h"
#include "shared/scene/lights.h"
