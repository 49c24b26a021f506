// Lights each pixel with its reservoir's sample: emission + BRDF x Le x G x visibility x contribution weight.
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_EMISSION) uniform sampler2D gbuffer_emission;
layout(binding = UNIT_PASS_A) uniform usamplerBuffer reservoirs;
layout(binding = UNIT_PASS_B) uniform samplerBuffer visibility;
layout(binding = 0, rgba32f) writeonly uniform image2D out_radiance;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    vec3 radiance = texelFetch(gbuffer_emission, pixel, 0).xyz;
    ShadingPoint p;
    if (load_shading_point(pixel, p)) {
        int row = int(pixel_index(pixel) * RESERVOIR_ROWS);
        Reservoir reservoir = unpack_reservoir(texelFetch(reservoirs, row), texelFetch(reservoirs, row + 1));
        float visible = texelFetch(visibility, int(pixel_index(pixel))).x;
        Frame frame = make_frame(p.shading_normal);
        vec3 view_local = to_local(frame, -pixel_ray(pixel).direction);
        IncidentLight incident = load_incident_light(reservoir.chosen, p.position);
        vec3 reflected = reflect_light(p, frame, view_local, incident);
        radiance += reflected * (reservoir.contribution_weight * visible);
    }
    if (!is_finite3(radiance)) {
        count_event(COUNTER_BAD_RADIANCE);
        radiance = vec3(0.0f);
    }
    imageStore(out_radiance, pixel, vec4(radiance, 1.0f));
}
