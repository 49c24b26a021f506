// Finishes the pixels' paths. Each becomes a sample in a reservoir, ready for reuse; of the directions from which light
// reaches its place one is chosen, in proportion to what it sends to the pixel.
//
// TARN_LIGHT_RAYS: the rays in which paths ended may have met lamps.
// TARN_SHADE: no reservoir, the light of the path itself, from all directions.
#include "shared/interface/constants/indirect.h"
#include "lib/scene_buffers.glsl"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/counters.glsl"
#include "lib/receiver.glsl"
#include "lib/indirect/directions.glsl"
#include "lib/indirect/path_samples.glsl"
#include "lib/indirect/path_state.glsl"
#ifdef TARN_LIGHT_RAYS
#include "lib/indirect/next_event.glsl"
#include "lib/indirect/met_light.glsl"
#endif
#include "lib/reuse/reservoirs.glsl"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform usamplerBuffer in_path_states;
layout(binding = UNIT_PASS_B) uniform samplerBuffer answers;  // of the last vertex
#ifdef TARN_LIGHT_RAYS
layout(binding = UNIT_PASS_C) uniform usamplerBuffer light_hits;  // of rays from there
#endif
#ifdef TARN_SHADE
layout(binding = 0, rgba32f) writeonly uniform image2D diffuse_image;
layout(binding = 1, rgba32f) writeonly uniform image2D specular_image;
#else
layout(std430, binding = 0) writeonly buffer Reservoirs { uvec4 out_reservoirs[]; };
#endif

// What lights a path's place: a lamp by next-event estimation, what lies further on, and a lamp that the last ray met.
const int SOURCE_COUNT = 3;
struct Sources {
    PathSample by[SOURCE_COUNT];
};

PathSample lit_from(PathSample place, vec3 direction, vec3 incident, LightSample lamp) {
    place.incident_direction = direction;
    place.incident = incident;
    place.light = lamp;
    return place;
}

PathSample further_sample(PathState s) {
    PathSample further = lit_from(s.place, s.further_direction, s.further, no_light_sample());
    // Irradiance reaches the base alone: as from straight above a surface without a layer.
    if (s.further_is_irradiance) {
        further.incident_direction = further.shading_normal;
        further.material.f0 = vec3(0.0f);
        further.material.f90 = 0.0f;
        further.material.alpha = 1.0f;
    }
    return further;
}

Sources load_finished_path(uint pixel) {
    PathState s = load_path_state(in_path_states, pixel);
    settle_waiting(s, texelFetch(answers, int(pixel)).x, bounce == 0u);
    Sources sources;
    sources.by[2] = lit_from(s.place, s.further_direction, vec3(0.0f), no_light_sample());
#ifdef TARN_LIGHT_RAYS
    int row = int(pixel * HIT_ROWS);
    HitRecord hit = unpack_hit(texelFetch(light_hits, row), texelFetch(light_hits, row + 1));
    MetLight met = find_met_light(s, hit, ray_share);
    // Beyond the place it is one part of what lies further on.
    s.further += bounce > 0u ? met.value : vec3(0.0f);
    sources.by[2].incident = bounce > 0u ? vec3(0.0f) : met.value;
    sources.by[2].light = met.drawn;
#endif
    sources.by[0] = s.place;
    sources.by[1] = further_sample(s);
    return sources;
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
        Sources sources = load_finished_path(pixel_index(pixel));
        PathPlace place = load_place_at(sources.by[0], 0u);
        IncidentLight arriving = place_light(sources.by[0], place, r.point.position);
        for (int i = 1; i < SOURCE_COUNT; ++i)
            arriving.value += place_light(sources.by[i], place, r.point.position).value;
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

// One of them, its light over the probability of the choice.
PathSample choose_source(Sources sources, PathPlace place, Receiver r, float u) {
    float targets[SOURCE_COUNT];
    float total = 0.0f;
    for (int i = 0; i < SOURCE_COUNT; ++i) {
        targets[i] = path_target(r, place_light(sources.by[i], place, r.point.position));
        total += targets[i];
    }
    if (!(total > 0.0f)) return sources.by[0];
    float rest = u * total;
    PathSample chosen = sources.by[0];
    float target = targets[0];
    for (int i = 1; i < SOURCE_COUNT; ++i) {
        rest -= targets[i - 1];
        if (rest < 0.0f || targets[i] == 0.0f) continue;
        chosen = sources.by[i];
        target = targets[i];
    }
    chosen.incident *= ratio_or_zero(total, target);
    return chosen;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_outside(pixel)) return;
    SampleReservoir result = empty_sample_reservoir();
    Receiver r;
    if (load_receiver(pixel, r)) {
        Sources sources = load_finished_path(pixel_index(pixel));
        PathPlace place = load_place_at(sources.by[0], 0u);
        PathSample chosen =
            choose_source(sources, place, r, random4(pixel_key(pixel), DIMENSION_INDIRECT + 1u).x);
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
