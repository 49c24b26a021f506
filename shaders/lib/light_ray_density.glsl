// How densely rays meet lights: what two ways to find the same light need to share it. After lib/scene_buffers.glsl.

// Share of rays that meet the light at `drawn`, a sample on a light of the table.
float sample_coverage(LightSample drawn) {
    float coverage = 1.0f;
#ifndef TARN_PLANT_FORGET_COVERAGE
    // A loop that runs at most once, as in load_triangle_radiance.
    Light light = load_light(drawn.light);
    uint covered = SCENE_HAS_COVERED_LIGHTS ? light.flags & LIGHT_COVERED : 0u;
    for (; covered != 0u; covered = 0u) coverage = load_light_coverage(light, drawn.uv);
#endif
    return coverage;
}

// Density of rays that are drawn with `pdf` (solid angle) towards a sample, in the measure of its light; 0 for lights
// that no ray can meet. Of the rays that arrive there only the covered share ends on the light.
float ray_density_on_light(float pdf, LightSample drawn, IncidentLight incident) {
    if (incident.distance >= RAY_INFINITY) return drawn.light == LIGHT_ENVIRONMENT ? pdf : 0.0f;
    pdf *= sample_coverage(drawn);
    return pdf * max(dot(incident.light_normal, -incident.direction), 0.0f) /
           (incident.distance * incident.distance);
}
