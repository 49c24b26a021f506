// Writes which triangle is seen: instance and primitive. Everything else follows in gbuffer/resolve, once a pixel.
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"

layout(location = 0) flat in uvec2 draw_id;
#ifdef TARN_COVERAGE
layout(location = 1) in vec2 uv0;
layout(location = 2) in vec2 uv1;
layout(location = 3) in float vertex_alpha;
#endif

layout(location = 0) out uvec2 seen;

void main() {
    uint primitive = draw_id.y + uint(gl_PrimitiveID);
#ifdef TARN_COVERAGE
    uint material_index = load_instance(draw_id.x).material;
    MaterialRecord material = load_material(material_index);
    float opacity = material.base_color.w * vertex_alpha *
                    sample_slot(load_slot(material_index, SLOT_BASE_COLOR), uv0, uv1).w;
    float u = random_coverage(pixel_key(ivec2(gl_FragCoord.xy)), RAY_CAMERA, draw_id.x, primitive);
    if (!is_covered(material.flags, material.alpha_cutoff, opacity, u)) discard;
#endif
    seen = uvec2(draw_id.x, primitive);
}
