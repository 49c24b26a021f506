// The glTF metallic-roughness BRDF: a Lambert base under a GGX layer (height-correlated Smith), in local
// space (+Z is the shading normal).
//
// Source: Khronos glTF 2.0 specification, appendix B. One departure: its sample formula weighs the base with
// 1 - F(v.h), which reflects up to 1.8 times the light that arrives at grazing angles. Here the base is
// weighed with (1 - F(n.v)) (1 - F(n.l)) (Shirley et al., "A Practitioners' Assessment of Light Reflection
// Models", 1997): reciprocal, and never above 1 in a white furnace (tests/unit/brdf.cpp).
#pragma once

#include "shared/dialect.h"
#include "shared/math/colour.h"
#include "shared/math/warp.h"

SHARED_BEGIN

// What the BRDF needs of a surface; textures and factors are already multiplied in.
struct SurfaceMaterial {
    vec3 diffuse_albedo;  // base colour * (1 - metallic)
    vec3 f0;              // reflectance at normal incidence
    float f90;            // reflectance at grazing incidence; f0 = f90 = 0 is a pure Lambert surface
    float alpha;          // GGX width, roughness^2, at least MIN_ALPHA
};

// Below this width a highlight is narrower than single precision resolves.
CONSTANT float MIN_ALPHA = 1e-3f;
// Least cosine between the view direction and a shading normal; shading normals may turn away from the
// viewer.
CONSTANT float MIN_VIEW_COSINE = 1e-4f;

FN vec3 fresnel_schlick(vec3 f0, float f90, float cosine) {
    float m = clamp(1.0f - cosine, 0.0f, 1.0f);
    float m2 = m * m;
    return f0 + (vec3(f90) - f0) * (m2 * m2 * m);
}

// GGX distribution of normals for a unit half vector. Written with sin^2 = x^2 + y^2, since 1 - z^2 loses all
// digits on narrow highlights.
FN float evaluate_ggx(vec3 half_vector, float alpha) {
    float alpha2 = alpha * alpha;
    float sine2 = half_vector.x * half_vector.x + half_vector.y * half_vector.y;
    float d = half_vector.z * half_vector.z * alpha2 + sine2;
    return alpha2 / (PI * d * d);
}

// Smith's height-correlated masking-shadowing over 4 n.l n.v.
FN float evaluate_visibility_smith(float cos_l, float cos_v, float alpha) {
    float alpha2 = alpha * alpha;
    float lambda_v = cos_l * sqrt(cos_v * cos_v * (1.0f - alpha2) + alpha2);
    float lambda_l = cos_v * sqrt(cos_l * cos_l * (1.0f - alpha2) + alpha2);
    return 0.5f / (lambda_v + lambda_l);
}

// The view direction, kept in the upper hemisphere.
FN vec3 clamp_view(vec3 view) {
    if (view.z >= MIN_VIEW_COSINE) return view;
    return normalize(vec3(view.x, view.y, MIN_VIEW_COSINE));
}

// Shaders of a scene without any specular layer leave it out (plan/frame_plan.cpp).
#ifdef TARN_LAMBERT_ONLY
CONSTANT bool SCENE_HAS_SPECULAR = false;
#else
CONSTANT bool SCENE_HAS_SPECULAR = true;
#endif

// What base and layer reflect, apart: 1/sr for a BRDF value, W sr^-1 m^-2 for light.
struct BrdfValue {
    vec3 diffuse;   // of the base, without its albedo
    vec3 specular;  // of the layer
};

FN BrdfValue no_reflection() {
    BrdfValue none;
    none.diffuse = vec3(0.0f);
    none.specular = vec3(0.0f);
    return none;
}

FN BrdfValue scale_parts(BrdfValue value, vec3 factor) {
    value.diffuse = value.diffuse * factor;
    value.specular = value.specular * factor;
    return value;
}

FN vec3 join_parts(SurfaceMaterial m, BrdfValue value) {
    return m.diffuse_albedo * value.diffuse + value.specular;
}

// BRDF value without the cosine. `view` and `light` are unit vectors that point away from the surface.
FN BrdfValue evaluate_brdf_parts(SurfaceMaterial m, vec3 view, vec3 light) {
    BrdfValue value = no_reflection();
    if (light.z <= 0.0f) return value;
    vec3 v = clamp_view(view);
    value.diffuse = vec3(INV_PI);
    if (!SCENE_HAS_SPECULAR || (m.f90 == 0.0f && max_component(m.f0) == 0.0f)) return value;
    vec3 half_vector = normalize(v + light);
    float cos_h = clamp(dot(v, half_vector), 0.0f, 1.0f);
    float layer = evaluate_ggx(half_vector, m.alpha) * evaluate_visibility_smith(light.z, v.z, m.alpha);
    vec3 transmitted = (vec3(1.0f) - fresnel_schlick(m.f0, m.f90, v.z)) *
                       (vec3(1.0f) - fresnel_schlick(m.f0, m.f90, light.z));
    value.diffuse = transmitted * INV_PI;
    value.specular = fresnel_schlick(m.f0, m.f90, cos_h) * layer;
    return value;
}

// Both parts together, 1/sr.
FN vec3 evaluate_brdf(SurfaceMaterial m, vec3 view, vec3 light) {
    return join_parts(m, evaluate_brdf_parts(m, view, light));
}

// Probability of sampling the GGX layer rather than the base.
FN float layer_probability(SurfaceMaterial m, vec3 view) {
    vec3 fresnel = fresnel_schlick(m.f0, m.f90, clamp_view(view).z);
    float layer = luminance(fresnel);
    float base = luminance(m.diffuse_albedo * (vec3(1.0f) - fresnel));
    if (layer == 0.0f) return 0.0f;
    if (base == 0.0f) return 1.0f;
    return clamp(layer / (layer + base), 0.1f, 0.9f);
}

// A half vector from the distribution of visible normals (Dupuy and Benyoub, "Sampling Visible GGX Normals
// with Spherical Caps", 2023).
FN vec3 sample_visible_normal(vec3 view, float alpha, vec2 u) {
    vec3 stretched = normalize(vec3(view.x * alpha, view.y * alpha, view.z));
    float phi = 2.0f * PI * u.x;
    float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    float sine = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    vec3 h = vec3(sine * cos(phi), sine * sin(phi), z) + stretched;
    return normalize(vec3(h.x * alpha, h.y * alpha, max(0.0f, h.z)));
}

// Solid-angle pdf with which sample_brdf returns `light`; 0 below the surface.
FN float pdf_brdf_solid_angle(SurfaceMaterial m, vec3 view, vec3 light) {
    if (light.z <= 0.0f) return 0.0f;
    vec3 v = clamp_view(view);
    float layer = layer_probability(m, v);
    float pdf = (1.0f - layer) * light.z * INV_PI;
    if (layer > 0.0f) {
        vec3 half_vector = normalize(v + light);
        float alpha2 = m.alpha * m.alpha;
        float root = sqrt(alpha2 + (1.0f - alpha2) * v.z * v.z);
        // D * G1 / (4 n.v), with G1 = 2 n.v / (n.v + root)
        pdf += layer * evaluate_ggx(half_vector, m.alpha) / (2.0f * (v.z + root));
    }
    return pdf;
}

// A direction to continue in, roughly in proportion to BRDF * cosine. May point below the surface: such a
// sample carries nothing and its pdf is 0.
FN vec3 sample_brdf(SurfaceMaterial m, vec3 view, vec3 u) {
    vec3 v = clamp_view(view);
    vec2 u2 = vec2(u.y, u.z);
    if (u.x >= layer_probability(m, v)) return sample_cosine_hemisphere(u2);
    vec3 half_vector = sample_visible_normal(v, m.alpha, u2);
    return half_vector * (2.0f * dot(v, half_vector)) - v;
}

SHARED_END
