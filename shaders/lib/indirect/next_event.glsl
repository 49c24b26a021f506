// Next-event estimation at a surface that a path met: one light sample out of a few candidates, by RIS in proportion to
// what they reflect, as direct/candidates.comp does for pixels. After lib/receiver.glsl.
#include "shared/math/reservoir.h"

struct NextEvent {
    IncidentLight incident;
    LightSample drawn;
    float contribution_weight;  // W; 0: no light found
};

// A candidate for `point` by power, the sky by its share.
LightCandidate draw_next_event(RandomKey key, uint dimension, vec3 point) {
    float share = environment_probability();
    uvec4 bits = random_bits4(key, dimension);
    bool sky = SCENE_HAS_ENVIRONMENT && random4(key, dimension + 1u).x < share;
    LightCandidate c = no_candidate();
    if (SCENE_HAS_ENVIRONMENT && sky) {
        c = draw_environment(bits);
#ifndef TARN_PLANT_FORGET_SKY_SHARE_OF_PATHS
        c.pdf *= share;
#endif
    } else if (get_light_count() > 0u) {
        c = draw_light_near_by_power(bits, point);
        c.pdf *= 1.0f - share;
    }
    return c;
}

NextEvent find_next_event(Receiver r, RandomKey key, uint dimension) {
    NextEvent chosen;
    chosen.incident = no_incident_light();
    chosen.drawn = no_light_sample();
    LiveReservoir live = empty_live_reservoir();
    for (uint i = 0u; i < candidate_count; ++i) {
        LightCandidate c = draw_next_event(key, dimension + 3u * i, r.point.position);
        if (!(c.pdf > 0.0f)) continue;
        IncidentLight incident = load_incident_light(c.drawn, r.point.position);
        float target = luminance(join_parts(r.point.material, reflect_at(r, incident)));
        float u = random4(key, dimension + 3u * i + 2u).x;
        uint offer = offer_candidate(live, target, target / (c.pdf * float(candidate_count)), u);
        if (offer == OFFER_BAD) count_event(COUNTER_BAD_WEIGHT);
        if (offer == OFFER_TAKEN) {
            chosen.incident = incident;
            chosen.drawn = c.drawn;
        }
    }
    chosen.contribution_weight = finish_reservoir(live, 1.0f).contribution_weight;
    return chosen;
}
