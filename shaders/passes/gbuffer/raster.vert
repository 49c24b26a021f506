// Projects the scene's vertices. Row 0 of the picture is on top, so clip space has +Y down.
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"

layout(location = 0) in vec3 position_os;
layout(location = 1) in uvec2 draw;  // instance, first primitive of the draw

layout(location = 0) flat out uvec2 draw_id;
#ifdef TARN_COVERAGE
layout(location = 1) out vec2 uv0;
layout(location = 2) out vec2 uv1;
layout(location = 3) out float vertex_alpha;
#endif

void main() {
    InstanceRecord instance = load_instance(draw.x);
    vec3 from_camera = transform_point(instance, position_os) - frame_camera_position.xyz;
    vec3 right = frame_camera_right.xyz;
    vec3 up = frame_camera_up.xyz;
    float depth = dot(from_camera, frame_camera_forward.xyz);
    float x = dot(from_camera, right) / dot(right, right);
    float y = -dot(from_camera, up) / dot(up, up);
    bool orthographic = frame_camera_position.w != 0.0f;
    // Reversed depth: 1 at the near plane, 0 at infinity (orthographic: at the end of the depth range).
    gl_Position = orthographic ? vec4(x, y, 1.0f - depth / frame_camera_forward.w, 1.0f)
                               : vec4(x, y, frame_camera_forward.w, depth);
    // A pixel's centre shows what its jittered ray meets.
    gl_Position.xy -= frame_jitter.xy * (2.0f / vec2(frame_size.xy)) * gl_Position.w;
    draw_id = draw;
#ifdef TARN_COVERAGE
    uint row = uint(gl_VertexID) * VERTEX_ROWS;
    uv0 = load_uv0(uint(gl_VertexID));
    uvec4 extras = fetch_vertex_row(row + 3u);
    uv1 = unpack_uv1(extras);
    vertex_alpha = unpack_color(extras).w;
#endif
}
