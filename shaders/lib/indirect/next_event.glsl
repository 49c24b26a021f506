// Next-event estimation at a surface that a path met: one light sample out of a few candidates, by RIS in proportion to
// what they reflect, as direct/candidates.comp does for pixels. After lib/receiver.glsl.
//
// TARN_SELECT_TREE: candidates come by a walk down the light tree; else by power.
#include "shared/math/reservoir.h"
#include "lib/light_ray_density.glsl"
#ifdef TARN_SELECT_TREE
#include "lib/light_tree.glsl"
#endif

struct NextEvent {
    IncidentLight incident;
    LightSample drawn;
    float contribution_weight;  // W; 0: no light found
};

LightCandidate draw_lamp(uvec4 bits, ShadingPoint point) {
#ifdef TARN_SELECT_TREE
    return draw_light_near_by_tree(bits, point.position, point.shading_normal);
#else
    return draw_light_near_by_power(bits, point.position);
#endif
}

// A candidate for `point`, the sky by its share.
LightCandidate draw_next_event(RandomKey key, uint dimension, ShadingPoint point) {
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
        c = draw_lamp(bits, point);
        c.pdf *= 1.0f - share;
    }
    return c;
}

// Density of one candidate in the measure of its light, for a sample on a triangle or in the sky.
float next_event_pdf(LightSample drawn, IncidentLight incident, vec3 position, vec3 normal) {
    float share = environment_probability();
    if (drawn.light == LIGHT_ENVIRONMENT) return environment_pdf_solid_angle(incident.direction) * share;
#ifdef TARN_SELECT_TREE
    float pmf = light_tree_pmf(drawn.light, position, normal);
#else
    float pmf = unpack_alias_bucket(fetch_light_alias_row(drawn.light)).pmf_own;
#endif
    return pdf_on_light_near(drawn, pmf * (1.0f - share), position);
}

// `ray_share`: how many of the rays that leave the surface along the BRDF are followed and find lights too. Both ways
// share the light by the balance heuristic (Veach 1997): resampling weight target / (count * pdf + density of the rays),
// so that a lamp so near that a candidate for it is worth much is left to the rays.
NextEvent find_next_event(Receiver r, RandomKey key, uint dimension, float ray_share) {
    NextEvent chosen;
    chosen.incident = no_incident_light();
    chosen.drawn = no_light_sample();
    LiveReservoir live = empty_live_reservoir();
    for (uint i = 0u; i < candidate_count; ++i) {
        LightCandidate c = draw_next_event(key, dimension + 3u * i, r.point);
        if (!(c.pdf > 0.0f)) continue;
        IncidentLight incident = load_incident_light(c.drawn, r.point.position);
        float target = luminance(join_parts(r.point.material, reflect_at(r, incident)));
        float u = random4(key, dimension + 3u * i + 2u).x;
        float ray_pdf =
            ray_share * pdf_brdf_solid_angle(r.point.material, r.brdf, to_local(r.frame, incident.direction));
        float density = c.pdf * float(candidate_count) + ray_density_on_light(ray_pdf, c.drawn, incident);
        uint offer = offer_candidate(live, target, target == 0.0f ? 0.0f : target / density, u);
        if (offer == OFFER_BAD) count_event(COUNTER_BAD_WEIGHT);
        if (offer == OFFER_TAKEN) {
            chosen.incident = incident;
            chosen.drawn = c.drawn;
        }
    }
    chosen.contribution_weight = finish_reservoir(live, 1.0f).contribution_weight;
    return chosen;
}
