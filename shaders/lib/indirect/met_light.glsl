// Lamps and sky that a path's ray has met, as next-event estimation at the surface that it left leaves them to it
// (find_next_event). After lib/indirect/next_event.glsl and lib/indirect/path_state.glsl.
#include "lib/light_hits.glsl"

struct MetLight {
    LightSample drawn;
    vec3 value;  // to be added to what arrives from the further direction
};

// `ray_share`: as the surface had it.
MetLight find_met_light(PathState s, HitRecord hit, float ray_share) {
    MetLight met = MetLight(no_light_sample(), vec3(0.0f));
    LightSample drawn = find_light_sample(hit);
    // A loop that runs at most once: few rays meet a light.
    uint found = s.pdf > 0.0f && drawn.light != INVALID_INDEX ? 1u : 0u;
    for (; found != 0u; found = 0u) {
        IncidentLight incident = load_incident_light(drawn, s.position);
#ifdef TARN_PLANT_OTHER_NORMAL
        s.normal = -s.normal;
#endif
        float density = float(candidate_count) * next_event_pdf(drawn, incident, s.position, s.normal);
#ifdef TARN_PLANT_FORGET_LIGHT_PDF
        density = 0.0f;
#endif
#ifdef TARN_PLANT_FORGET_RAY_SHARE
        ray_share = 1.0f;
#endif
        density += ray_density_on_light(s.pdf * ray_share, drawn, incident);
        if (!(density > 0.0f)) continue;
        met.drawn = drawn;
        met.value = s.throughput * (s.pdf / density) * incident.value;
    }
    return met;
}
