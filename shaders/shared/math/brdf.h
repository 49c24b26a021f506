// The glTF metallic-roughness BRDF: a diffuse base under a GGX layer (height-correlated Smith), in local
// space (+Z is the shading normal). It keeps the energy: a white dielectric or metal reflects all light.
//
// Source: Khronos glTF 2.0 specification, appendix B, with two departures. E is the layer's directional
// albedo were its Fresnel term 1, R its true one with both lobes, "avg" a mean over the hemisphere.
//
// Light that leaves the layer after two and more bounces is a second lobe (Kulla and Conty, "Revisiting
// Physically Based Shading at Imageworks", 2017), where each bounce costs F_avg:
//     F_ms (1 - E(v)) (1 - E(l)) / (pi (1 - E_avg)),    F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg))
// To scale the layer by the view's albedo instead (Turquin, "Practical Multiple Scattering Compensation for
// Microfacet Models", 2019) would be cheaper, but not reciprocal.
//
// The base gets what the layer lets through in both directions (Kelemen and Szirmay-Kalos, "A Microfacet
// Based Coupled Specular-Matte BRDF Model", 2001):
//     albedo (1 - R(v)) (1 - R(l)) / (pi (1 - R_avg))
// The specification's 1 - F(v.h) reflects up to 1.8 times the light that arrives at grazing angles;
// (1 - F(n.v)) (1 - F(n.l)) (Shirley et al. 1997) loses more than a quarter of it.
//
// In a white furnace white surfaces reflect 0.99 to 1.001 up to 85 degrees, and nothing reflects more
// (tests/unit/brdf_furnace.cpp).
#pragma once

#include "shared/dialect.h"
#include "shared/math/colour.h"
#include "shared/math/layer_albedo.h"
#include "shared/math/warp.h"

SHARED_BEGIN

// What the BRDF needs of a surface; textures and factors are already multiplied in.
struct SurfaceMaterial {
    vec3 diffuse_albedo;  // base colour * (1 - metallic), made whole under the layer (mix_material)
    vec3 f0;              // reflectance at normal incidence
    float f90;            // reflectance at grazing incidence; f0 = f90 = 0 is a pure Lambert surface
    float alpha;          // GGX width, roughness^2, at least MIN_ALPHA
};

// Below this width a highlight is narrower than single precision resolves.
CONSTANT float MIN_ALPHA = 1e-3f;
// Least cosine between the view direction and a shading normal; shading normals may turn away from the
// viewer.
CONSTANT float MIN_VIEW_COSINE = 1e-4f;
// Below this mean transmission the base is next to nothing and no longer made whole.
CONSTANT float LEAST_TRANSMISSION = 1e-6f;

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
    vec3 diffuse;   // of the base, demodulated: without its albedo
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

// What the BRDF takes of material and view alone; candidates at one place share it.
struct BrdfView {
    vec3 view;  // in the upper hemisphere
    LayerFit fit;
    vec3 multiple_fresnel;  // F_ms: share of the light lost to single scattering that leaves in the end
    vec3 multiple;          // F_ms (1 - E(v)) / (pi (1 - E_avg))
    vec3 base;              // (1 - R(v)) / (pi (1 - R_avg))
    float layer_probability;
};

// The share of light from one direction that the layer lets through: 1 - R.
FN vec3 transmit_to_base(SurfaceMaterial m, vec3 multiple_fresnel, LayerAlbedo a) {
    vec3 transmitted =
        vec3(1.0f) - m.f0 + (m.f0 - multiple_fresnel) * a.loss - (vec3(m.f90) - m.f0) * a.fresnel;
    return max(transmitted, vec3(0.0f));
}

// F_ms, from the mean of Schlick's term over the hemisphere: f0 + (f90 - f0) / 21.
FN vec3 mean_multiple_fresnel(SurfaceMaterial m, float mean_loss) {
    vec3 mean = m.f0 + (vec3(m.f90) - m.f0) * (1.0f / 21.0f);
    return mean * mean * (1.0f - mean_loss) / (vec3(1.0f) - mean * mean_loss);
}

// The share of evenly arriving light that the layer lets through, on the mean over all directions.
FN vec3 mean_transmission(SurfaceMaterial m, LayerAlbedo mean) {
    return transmit_to_base(m, mean_multiple_fresnel(m, mean.loss), mean);
}

// glTF's mix of the BRDFs of a dielectric (`dielectric_f0`, `dielectric_f90`) and a metal (`base_color`):
// specification, appendix B.2. Their layers become one with mixed f0 and f90, exact for single scattering,
// since Schlick's term is linear in both. What is left of the energy of the true mix goes to the base: the
// dielectric's own, which lies under a layer that lets more through than the mixed one, and what the mixed
// layer lacks of multiple scattering. The sample formula of appendix B.3.5 gives the base what the mixed
// layer lets through, and a white surface halfway between loses a quarter of the light.
FN SurfaceMaterial mix_material(vec3 base_color, float metallic, vec3 dielectric_f0, float dielectric_f90,
                                float alpha) {
    SurfaceMaterial dielectric;
    dielectric.diffuse_albedo = base_color;
    dielectric.f0 = dielectric_f0;
    dielectric.f90 = dielectric_f90;
    dielectric.alpha = alpha;
    SurfaceMaterial metal = dielectric;
    metal.f0 = base_color;
    metal.f90 = 1.0f;
    SurfaceMaterial m = dielectric;
    m.f0 = mix(dielectric_f0, base_color, metallic);
    m.f90 = mix(dielectric_f90, 1.0f, metallic);
    LayerAlbedo mean = evaluate_mean_layer_albedo(alpha);
    vec3 mixed = mean_transmission(m, mean);
    vec3 through = mean_transmission(dielectric, mean);
    // Exactly 0 for dielectrics and metals.
    vec3 missing = mixed - mix(through, mean_transmission(metal, mean), metallic);
    vec3 base = base_color * through * (1.0f - metallic) + missing;
    m.diffuse_albedo = clamp(base / max(mixed, vec3(LEAST_TRANSMISSION)), vec3(0.0f), vec3(1.0f));
    return m;
}

// Probability of sampling the layer's single scattering. All else follows the cosine closely, so that its
// share of the energy is enough for it; the Fresnel term may be far above its mean.
FN float choose_layer_probability(SurfaceMaterial m, BrdfView prepared, LayerAlbedo a, vec3 transmitted) {
    float layer = luminance(m.f0 * (1.0f - a.loss - a.fresnel) + vec3(m.f90 * a.fresnel));
    float rest = luminance(m.diffuse_albedo * transmitted + prepared.multiple_fresnel * a.loss);
    if (!SCENE_HAS_SPECULAR || layer <= 0.0f) return 0.0f;
    return max(layer / (layer + rest), 0.1f);
}

// For a unit `view` that points away from the surface.
FN BrdfView prepare_brdf(SurfaceMaterial m, vec3 view) {
    BrdfView prepared;
    prepared.view = clamp_view(view);
    prepared.fit = fit_layer(m.alpha);
    LayerAlbedo mean = evaluate_mean_layer_albedo(m.alpha);
    LayerAlbedo at_view = evaluate_layer_albedo(prepared.fit, prepared.view.z);
    prepared.multiple_fresnel = mean_multiple_fresnel(m, mean.loss);
    prepared.multiple = prepared.multiple_fresnel * (INV_PI * at_view.loss / mean.loss);
    vec3 transmitted = transmit_to_base(m, prepared.multiple_fresnel, at_view);
    // The bound keeps 0 / 0 away where the layer reflects everything.
    prepared.base = transmitted * INV_PI /
                    max(transmit_to_base(m, prepared.multiple_fresnel, mean), vec3(LEAST_TRANSMISSION));
    prepared.layer_probability = choose_layer_probability(m, prepared, at_view, transmitted);
    return prepared;
}

// BRDF value, 1/sr, without the cosine. `light` is a unit vector that points away from the surface.
FN BrdfValue evaluate_brdf_parts(SurfaceMaterial m, BrdfView prepared, vec3 light) {
    BrdfValue value = no_reflection();
    if (light.z <= 0.0f) return value;
    value.diffuse = vec3(INV_PI);
    if (!SCENE_HAS_SPECULAR) return value;
    vec3 v = prepared.view;
    LayerAlbedo at_light = evaluate_layer_albedo(prepared.fit, min(light.z, 1.0f));
    value.diffuse = prepared.base * transmit_to_base(m, prepared.multiple_fresnel, at_light);
    vec3 half_vector = normalize(v + light);
    float cos_h = clamp(dot(v, half_vector), 0.0f, 1.0f);
    float layer = evaluate_ggx(half_vector, m.alpha) * evaluate_visibility_smith(light.z, v.z, m.alpha);
    value.specular = fresnel_schlick(m.f0, m.f90, cos_h) * layer + prepared.multiple * at_light.loss;
    return value;
}

// The same for a single light.
FN BrdfValue evaluate_brdf_parts(SurfaceMaterial m, vec3 view, vec3 light) {
    return evaluate_brdf_parts(m, prepare_brdf(m, view), light);
}

FN vec3 evaluate_brdf(SurfaceMaterial m, vec3 view, vec3 light) {
    return join_parts(m, evaluate_brdf_parts(m, view, light));
}

// Probability with which sample_brdf samples the GGX layer rather than the cosine.
FN float layer_probability(SurfaceMaterial m, vec3 view) {
    return prepare_brdf(m, view).layer_probability;
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
FN float pdf_brdf_solid_angle(SurfaceMaterial m, BrdfView prepared, vec3 light) {
    if (light.z <= 0.0f) return 0.0f;
    vec3 v = prepared.view;
    float layer = prepared.layer_probability;
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

FN float pdf_brdf_solid_angle(SurfaceMaterial m, vec3 view, vec3 light) {
    return pdf_brdf_solid_angle(m, prepare_brdf(m, view), light);
}

// A direction to continue in, roughly in proportion to BRDF * cosine. May point below the surface: such a
// sample carries nothing and its pdf is 0.
FN vec3 sample_brdf(SurfaceMaterial m, BrdfView prepared, vec3 u) {
    vec3 v = prepared.view;
    vec2 u2 = vec2(u.y, u.z);
    if (u.x >= prepared.layer_probability) return sample_cosine_hemisphere(u2);
    vec3 half_vector = sample_visible_normal(v, m.alpha, u2);
    return half_vector * (2.0f * dot(v, half_vector)) - v;
}

FN vec3 sample_brdf(SurfaceMaterial m, vec3 view, vec3 u) {
    return sample_brdf(m, prepare_brdf(m, view), u);
}

SHARED_END
