// Which light a ray has met. One text for shaders and the CPU; see scene/surface.h. After scene/lights.h.
//
// Also needs, where it is included:
//     uint fetch_light_slot(uint instance) (where its primitives begin in the table that the next one reads;
//     INVALID_INDEX: it does not emit), uint fetch_light_of_slot(uint slot) (INVALID_INDEX: no area)

// The light that a triangle is; INVALID_INDEX where it is none.
FN uint find_triangle_light(uint instance, uint primitive) {
    if (!SCENE_HAS_TRIANGLE_LIGHTS || instance == INVALID_INDEX) return INVALID_INDEX;
    uint first = fetch_light_slot(instance);
    if (first == INVALID_INDEX) return INVALID_INDEX;
    return fetch_light_of_slot(first + primitive);
}

// The light sample where a ray ended: on a triangle, or in the sky where it left a scene that has one.
FN LightSample find_light_sample(HitRecord hit) {
    LightSample found = no_light_sample();
    found.light = find_triangle_light(hit.instance, hit.primitive);
    if (found.light != INVALID_INDEX) found.uv = hit.barycentrics;
    if (has_environment() && hit.distance >= RAY_INFINITY) {
        found.light = LIGHT_ENVIRONMENT;
        found.uv = encode_octahedral(hit.direction);
    }
    return found;
}
