// The light tree as shaders read it. After lib/scene_buffers.glsl.
#include "shared/math/light_tree.h"

layout(binding = UNIT_PASS_E) uniform usamplerBuffer light_tree_rows;

uvec4 fetch_light_tree_row(uint row) { return texelFetch(light_tree_rows, int(row)); }
uint get_light_tree_node_count() { return frame_tables.x; }

#include "shared/scene/light_tree.h"
