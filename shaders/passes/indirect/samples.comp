// Finishes the pixels' paths. Each becomes a sample in a reservoir, ready for reuse; of the two directions from which
// light reaches its place one is chosen, in proportion to what it sends to the pixel.
//
// TARN_SHADE: no reservoir, the light of the path itself, from both directions.
#include "shared/interface/constants/indirect.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/indirect/directions.glsl"
#include "lib/indirect/path_samples.glsl"
#include "lib/indirect/path_state.glsl"
#include "lib/reuse/reservoirs.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_PASS_A) uniform usamplerBuffer in_path_states;
layout(binding = UNIT_PASS_B) uniform samplerBuffer answers;  // of the last vertex
#ifdef TARN_SHADE
layout(binding = 0, rgba32f) writeonly uniform image2D diffuse_image;
layout(binding = 1, rgba32f) writeonly uniform image2D specular_image;
#else
layout(std430, binding = 0) writeonly buffer Reservoirs { uvec4 out_reservoirs[]; };
#endif

// The same place, lit from where the path went on.
PathSample further_sample(PathState s) {
    PathSample further = s.place;
    further.incident_direction = s.further_direction;
    further.incident = s.further;
    further.light = no_light_sample();
    // Irradiance reaches the base alone: as from straight above a surface without a layer.
    if (s.further_is_irradiance) {
        further.incident_direction = further.shading_normal;
        further.material.f0 = vec3(0.0f);
        further.material.f90 = 0.0f;
        further.material.alpha = 1.0f;
    }
    return further;
}

PathState load_finished_path(uint pixel) {
    PathState s = load_path_state(in_path_states, pixel);
    settle_waiting(s, texelFetch(answers, int(pixel)).x, bounce == 0u);
    return s;
}

float path_pdf(Receiver r, IncidentLight light) {
    return first_direction_pdf(r, to_local(r.frame, light.direction));
}

#ifdef TARN_SHADE
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    BrdfValue light = no_reflection();
    Receiver r;
    if (load_receiver(pixel, r)) {
        PathState s = load_finished_path(pixel_index(pixel));
        PathPlace place = load_place_at(s.place, 0u);
        IncidentLight arriving = place_light(s.place, place, r.point.position);
        arriving.value += place_light(further_sample(s), place, r.point.position).value;
        float pdf = path_pdf(r, arriving);
        if (pdf > 0.0f) light = scale_parts(reflect_at(r, arriving), vec3(1.0f / pdf));
    }
    imageStore(diffuse_image, pixel, vec4(light.diffuse, 1.0f));
    imageStore(specular_image, pixel, vec4(light.specular, 1.0f));
}
#else
void store(uint pixel, SampleReservoir r) {
    uvec4 row0, row1;
    pack_reservoir(r.state, pack_sample(r.chosen), row0, row1);
    uint row = pixel * RESERVOIR_STRIDE;
    out_reservoirs[row] = row0;
    out_reservoirs[row + 1u] = row1;
    for (uint i = 0u; i < SAMPLE_ROWS; ++i)
        out_reservoirs[row + RESERVOIR_ROWS + i] = pack_sample_row(r.chosen, i);
}

// One of the two directions, its light over the probability of the choice.
PathSample choose_direction(PathState s, PathPlace place, Receiver r, float u) {
    PathSample by_light = s.place;
    PathSample further = further_sample(s);
    float first = path_target(r, place_light(by_light, place, r.point.position));
    float second = path_target(r, place_light(further, place, r.point.position));
    float total = first + second;
    if (!(total > 0.0f)) return by_light;
    if (u * total < first) {
        by_light.incident *= total / first;
        return by_light;
    }
    further.incident *= total / second;
    return further;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    SampleReservoir result = empty_sample_reservoir();
    Receiver r;
    if (load_receiver(pixel, r)) {
        PathState s = load_finished_path(pixel_index(pixel));
        PathPlace place = load_place_at(s.place, 0u);
        PathSample chosen =
            choose_direction(s, place, r, random4(pixel_key(pixel), DIMENSION_INDIRECT + 1u).x);
        IncidentLight light = place_light(chosen, place, r.point.position);
        float target = path_target(r, light);
        LiveReservoir live = empty_live_reservoir();
        uint offer = offer_candidate(live, target, target == 0.0f ? 0.0f : target / path_pdf(r, light), 0.0f);
        if (offer == OFFER_BAD) count_event(COUNTER_BAD_WEIGHT);
        if (has_overflown(live)) count_event(COUNTER_BAD_RESERVOIR);
        result.state = finish_reservoir(live, 1.0f);
        if (holds_sample(result)) result.chosen = PlacedSample(chosen, place);
    }
    store(pixel_index(pixel), result);
}
#endif
