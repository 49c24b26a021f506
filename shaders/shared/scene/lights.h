// The scene's lights: loading, drawing and evaluating samples. One text for shaders and the CPU; see
// scene/surface.h.
//
// Also needs, where it is included:
//     uvec4 fetch_light_row(uint), uvec4 fetch_light_alias_row(uint), vec4 fetch_environment_texel(uint)
//     (radiance, pmf), uvec4 fetch_environment_alias_row(uint), uint get_light_count(), uvec2
//     get_environment_size() (0 = no sky)
// and the constants SCENE_HAS_ENVIRONMENT, SCENE_HAS_PUNCTUAL_LIGHTS, SCENE_HAS_TRIANGLE_LIGHTS,
// SCENE_HAS_TEXTURED_LIGHTS, SCENE_HAS_COVERED_LIGHTS.

// Share of candidates that go to the environment where there are other lights too (Bitterli et al. 2020,
// section 5).
CONSTANT_MEMBER float ENVIRONMENT_SHARE = 0.25f;

// Triangles that are seen under less are drawn by area, sr.
CONSTANT_MEMBER float LEAST_SOLID_ANGLE = 1e-3f;

// A drawn sample and its density: pmf of the light times density in the light's measure (see math/light.h).
struct LightCandidate {
    LightSample drawn;
    float pdf;
};

FN Light load_light(uint light) {
    uint row = light * LIGHT_ROWS;
    return unpack_light(fetch_light_row(row), fetch_light_row(row + 1u), fetch_light_row(row + 2u),
                        fetch_light_row(row + 3u));
}

FN bool is_triangle(Light light) {
    if (!SCENE_HAS_PUNCTUAL_LIGHTS) return true;
    return SCENE_HAS_TRIANGLE_LIGHTS && (light.flags & LIGHT_KIND_MASK) == LIGHT_TRIANGLE;
}

FN bool has_environment() {
    return SCENE_HAS_ENVIRONMENT && get_environment_size().x > 0u;
}

// ---- Evaluation
// ---------------------------------------------------------------------------------------------------

// Sky radiance along a unit direction; 0 without a sky.
FN vec3 load_environment(vec3 direction) {
    uvec2 size = get_environment_size();
    if (!SCENE_HAS_ENVIRONMENT || size.x == 0u) return vec3(0.0f);
    TexelFootprint f = texel_footprint(environment_uv(direction), ivec2(int(size.x), int(size.y)),
                                       WRAP_REPEAT, WRAP_CLAMP, false);
    return vec3(fetch_environment_texel(f.indices.x)) * f.weights.x +
           vec3(fetch_environment_texel(f.indices.y)) * f.weights.y +
           vec3(fetch_environment_texel(f.indices.z)) * f.weights.z +
           vec3(fetch_environment_texel(f.indices.w)) * f.weights.w;
}

// Solid-angle density with which the environment is sampled along `direction`, given that it is sampled at
// all.
FN float environment_pdf_solid_angle(vec3 direction) {
    uvec2 size = get_environment_size();
    if (size.x == 0u) return 0.0f;
    vec2 uv = environment_uv(direction);
    uint column = min(uint(uv.x * float(size.x)), size.x - 1u);
    uint row = min(uint(uv.y * float(size.y)), size.y - 1u);
    return fetch_environment_texel(row * size.x + column).w /
           environment_texel_solid_angle(row, size.x, size.y);
}

// Value of an emission map on a triangle light, from the rows that follow the lights (see pack_emission_map).
FN vec3 sample_emission_map(EmissionMap map, vec2 barycentrics) {
    vec2 uv = map.uv0 * (1.0f - barycentrics.x - barycentrics.y) + map.uv1 * barycentrics.x +
              map.uv2 * barycentrics.y;
    ivec2 size = ivec2(int(map.size & 0xffffu), int(map.size >> 16u));
    bool nearest = (map.flags & SLOT_NEAREST) != 0u;
    TexelFootprint f = texel_footprint(uv, size, map.flags & 3u, (map.flags >> 2u) & 3u, nearest);
    return vec3(fetch_texel(map.first_texel + f.indices.x)) * f.weights.x +
           vec3(fetch_texel(map.first_texel + f.indices.y)) * f.weights.y +
           vec3(fetch_texel(map.first_texel + f.indices.z)) * f.weights.z +
           vec3(fetch_texel(map.first_texel + f.indices.w)) * f.weights.w;
}

// Share of rays that meet the triangle light at `barycentrics`: shadow rays end before it and cannot tell.
FN float load_light_coverage(Light light, vec2 barycentrics) {
    MaterialRecord m = load_material(load_instance(light.instance).material);
    float opacity = load_opacity(light.instance, light.primitive, barycentrics);
    if ((m.flags & MATERIAL_ALPHA_MASK) != 0u) return opacity >= m.alpha_cutoff ? 1.0f : 0.0f;
    return clamp(opacity, 0.0f, 1.0f);
}

// Mean radiance that the triangle light emits at `barycentrics`, emission map and coverage included.
FN vec3 load_triangle_radiance(Light light, vec2 barycentrics) {
    vec3 radiance = light.radiance;
    // Loops that run at most once: a software GPU skips loops that no lane enters, but never the side of an
    // `if`.
    uint covered = SCENE_HAS_COVERED_LIGHTS ? light.flags & LIGHT_COVERED : 0u;
    for (; covered != 0u; covered = 0u) radiance = radiance * load_light_coverage(light, barycentrics);
    uint textured = SCENE_HAS_TEXTURED_LIGHTS ? light.flags & LIGHT_TEXTURED : 0u;
    for (; textured != 0u; textured = 0u) {
        uint row = floatBitsToUint(light.range) - EMISSION_MAP_TAG;
        EmissionMap map =
            unpack_emission_map(fetch_light_row(row), fetch_light_row(row + 1u), fetch_light_row(row + 2u));
        radiance = radiance * sample_emission_map(map, barycentrics);
    }
    return radiance;
}

// Bound on the rounding error of a sample's position on its light, metres; 0 for lights without a surface.
FN float load_light_error(LightSample drawn) {
    if (drawn.light == INVALID_INDEX || drawn.light == LIGHT_ENVIRONMENT) return 0.0f;
    return unpack_light_error(fetch_light_row(drawn.light * LIGHT_ROWS));
}

// What a sample at `uv` on a light of the table sends to `point`, before visibility.
FN IncidentLight incident_from_light(Light light, vec2 uv, vec3 point) {
    if (is_triangle(light))
        return incident_from_triangle(light, uv, load_triangle_radiance(light, uv), point);
    return incident_from_punctual(light, point);
}

// What `drawn` sends to `point`, before visibility.
FN IncidentLight load_incident_light(LightSample drawn, vec3 point) {
    if (drawn.light == INVALID_INDEX) return no_incident_light();
    if (SCENE_HAS_ENVIRONMENT && drawn.light == LIGHT_ENVIRONMENT) {
        IncidentLight sky = no_incident_light();
        sky.direction = decode_octahedral(drawn.uv);
        sky.distance = RAY_INFINITY;
        sky.value = load_environment(sky.direction);
        return sky;
    }
    return incident_from_light(load_light(drawn.light), drawn.uv, point);
}

// ---- Drawing
// ------------------------------------------------------------------------------------------------------

// A place on light `index`, which was chosen with probability `pmf`.
FN LightCandidate draw_on_light(uint index, float pmf, vec2 u) {
    LightCandidate c;
    c.drawn.light = index;
    Light light = load_light(index);
    bool triangle = is_triangle(light);
    c.drawn.uv = triangle ? sample_triangle(u) : vec2(0.0f);
    c.pdf = triangle ? ratio_or_zero(pmf, triangle_area(light)) : pmf;
    return c;
}

// Whether a triangle is so near to `point` that it is drawn over its solid angle.
FN bool is_light_near(Light light, vec3 point) {
#ifdef TARN_PLANT_DRAW_NEAR_LIGHTS_BY_AREA
    return false;
#else
    vec3 to_centre = light.position - point + (light.edge1 + light.edge2) * (1.0f / 3.0f);
    float size2 = max(dot(light.edge1, light.edge1), dot(light.edge2, light.edge2));
    return is_triangle(light) && size2 > 0.25f * dot(to_centre, to_centre);
#endif
}

// Density by area of a place that is drawn evenly over `solid_angle`; `to_drawn` leads there from the point.
FN float near_light_pdf(Light light, vec3 to_drawn, float solid_angle, float pmf) {
    float distance2 = dot(to_drawn, to_drawn);
    // |cosine| / distance^2 is that of solid angle over area.
    float projected = abs(dot(cross(light.edge1, light.edge2), to_drawn));
    float area2 = 2.0f * triangle_area(light);
    return ratio_or_zero(pmf * projected, area2 * distance2 * sqrt(distance2) * solid_angle);
}

// The same as draw_on_light for a light that sends its light to `point`: a triangle that is near is drawn
// evenly over the solid angle under which the point sees it. The density is still that by area.
FN LightCandidate draw_on_light_near(uint index, float pmf, vec2 u, vec3 point) {
    LightCandidate c = draw_on_light(index, pmf, u);
    Light light = load_light(index);
    vec3 to_light = light.position - point;
    // A loop that runs at most once: a software GPU skips it where no lane enters.
    uint near = is_light_near(light, point) ? 1u : 0u;
    for (; near != 0u; near = 0u) {
        SphericalTriangle seen =
            make_spherical_triangle(to_light, to_light + light.edge1, to_light + light.edge2);
        // Angles near 0 have lost their digits in the sum of the corners.
        if (seen.solid_angle < LEAST_SOLID_ANGLE) continue;
        vec2 uv = find_barycentrics(sample_spherical_triangle(seen, u), to_light, light.edge1, light.edge2);
        vec3 to_drawn = to_light + light.edge1 * uv.x + light.edge2 * uv.y;
        c.drawn.uv = uv;
        c.pdf = near_light_pdf(light, to_drawn, seen.solid_angle, pmf);
    }
    return c;
}

// Density with which draw_on_light_near draws `drawn`, a sample on a triangle that is chosen with probability
// `pmf`.
FN float pdf_on_light_near(LightSample drawn, float pmf, vec3 point) {
    Light light = load_light(drawn.light);
    float pdf = ratio_or_zero(pmf, triangle_area(light));
#ifndef TARN_PLANT_AREA_OF_NEAR_LIGHTS
    vec3 to_light = light.position - point;
    uint near = is_light_near(light, point) ? 1u : 0u;
    for (; near != 0u; near = 0u) {
        SphericalTriangle seen =
            make_spherical_triangle(to_light, to_light + light.edge1, to_light + light.edge2);
        if (seen.solid_angle < LEAST_SOLID_ANGLE) continue;
        vec3 to_drawn = to_light + light.edge1 * drawn.uv.x + light.edge2 * drawn.uv.y;
        pdf = near_light_pdf(light, to_drawn, seen.solid_angle, pmf);
    }
#endif
    return pdf;
}

// A direction of the sky, by importance.
FN LightCandidate draw_environment(uvec4 bits) {
    uvec2 size = get_environment_size();
    uint bucket = uniform_index(bits.x, size.x * size.y);
    DiscreteSample texel = resolve_alias(unpack_alias_bucket(fetch_environment_alias_row(bucket)), bucket,
                                         float_from_bits(bits.y));
    uint row = texel.index / size.x;
    vec3 direction = environment_direction(texel.index - row * size.x, row, size.x, size.y,
                                           vec2(float_from_bits(bits.z), float_from_bits(bits.w)));
    LightCandidate c;
    c.drawn.light = LIGHT_ENVIRONMENT;
    c.drawn.uv = encode_octahedral(direction);
    c.pdf = texel.pmf / environment_texel_solid_angle(row, size.x, size.y);
    return c;
}

// A light by its power (alias table).
FN LightCandidate draw_light_by_power(uvec4 bits) {
    uint bucket = uniform_index(bits.x, get_light_count());
    DiscreteSample light =
        resolve_alias(unpack_alias_bucket(fetch_light_alias_row(bucket)), bucket, float_from_bits(bits.y));
    return draw_on_light(light.index, light.pmf, vec2(float_from_bits(bits.z), float_from_bits(bits.w)));
}

// The same for a receiver at `point`.
FN LightCandidate draw_light_near_by_power(uvec4 bits, vec3 point) {
    uint bucket = uniform_index(bits.x, get_light_count());
    DiscreteSample light =
        resolve_alias(unpack_alias_bucket(fetch_light_alias_row(bucket)), bucket, float_from_bits(bits.y));
    return draw_on_light_near(light.index, light.pmf, vec2(float_from_bits(bits.z), float_from_bits(bits.w)),
                              point);
}

FN LightCandidate no_candidate() {
    LightCandidate c;
    c.drawn = no_light_sample();
    c.pdf = 0.0f;
    return c;
}

// One light out of all with equal probability, the sky being one of them.
FN LightCandidate draw_light_uniformly(uvec4 bits) {
    uint count = get_light_count() + (has_environment() ? 1u : 0u);
    if (count == 0u) return no_candidate();
    uint index = uniform_index(bits.x, count);
    float pmf = 1.0f / float(count);
    if (!SCENE_HAS_ENVIRONMENT || index < get_light_count()) {
        return draw_on_light(index, pmf, vec2(float_from_bits(bits.z), float_from_bits(bits.w)));
    }
    LightCandidate sky = draw_environment(hash_pcg4d(bits));
    sky.pdf *= pmf;
    return sky;
}

// Probability that a single draw by power goes to the sky.
FN float environment_probability() {
    if (!has_environment()) return 0.0f;
    return get_light_count() > 0u ? ENVIRONMENT_SHARE : 1.0f;
}
