// Directional albedo of the GGX layer: which share of the light from one direction it reflects into all
// others.
//
// With Schlick's Fresnel term that is f0 A + f90 B, A + B = E: E is the albedo of a layer with F = 1, B the
// part of it that (1 - v.h)^5 weighs (Karis, "Real Shading in Unreal Engine 4", 2013). Both are the single
// scattering of height-correlated Smith; the light that E lacks meets the surface again.
//
// E and B have no closed form. Here they are rational functions of s = cosine / alpha, whose coefficients are
// polynomials of the roughness; the scale s follows how masking sets in at grazing angles. They were fitted
// to quadrature at 40 x 72 places for the least maximum of the error, leaning upwards: E and B are at most
// 0.001 below the truth, so that nothing reflects more than arrives. tests/unit/layer_albedo.cpp has the
// error at all widths and angles.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// Loss and Fresnel part for one direction, or their means.
struct LayerAlbedo {
    float loss;     // 1 - E
    float fresnel;  // B
};

// What the fits take of the width: coefficients of powers of s, the first is that of s^0 or s^1 (loss).
struct LayerFit {
    float inv_alpha;
    vec4 denominator;
    vec2 loss;
    vec4 fresnel;
    float edge;
};

FN float evaluate_cubic(float x, float c0, float c1, float c2, float c3) {
    return c0 + x * (c1 + x * (c2 + x * c3));
}

FN float evaluate_quartic(float x, float c0, float c1, float c2, float c3, float c4) {
    return c0 + x * evaluate_cubic(x, c1, c2, c3, c4);
}

// The fits at width `alpha`, at least MIN_ALPHA and at most 1.
FN LayerFit fit_layer(float alpha) {
    float r = sqrt(alpha);
    float d0 = evaluate_quartic(r, 0.93317f, -2.51011f, 10.5322f, -24.4663f, 23.5006f - 7.904f * r);
    float d2 = evaluate_quartic(r, 0.186128f, -0.5435f, 2.19422f, -3.13199f, 1.42446f + 0.391772f * r);
    float d3 = evaluate_quartic(r, 0.188126f, -0.193785f, -0.533169f, 2.88454f, -4.30526f + 2.12291f * r);
    float b0 = evaluate_quartic(r, 0.943381f, -3.40559f, 4.67831f, -2.87174f, 0.660288f);
    float b1 = evaluate_quartic(r, -0.0644984f, 2.39011f, -6.54767f, 6.59986f, -2.36013f);
    float b2 = evaluate_quartic(r, 0.174056f, -0.305824f, -0.49073f, 0.0371509f, 0.557765f);
    float b3 = evaluate_quartic(r, 0.1902f, -0.189671f, -1.2555f, 4.39775f, -2.80088f);
    LayerFit fit;
    fit.inv_alpha = 1.0f / alpha;
    fit.denominator = vec4(d0, 1.0f - d0, d2, d3);
    fit.loss = vec2(evaluate_quartic(r, 0.15471f, -0.202997f, 0.611574f, -0.128668f, -0.078348f),
                    evaluate_quartic(r, -0.00477068f, -0.0313356f, 0.321584f, -1.18025f, 1.699f));
    fit.fresnel = vec4(b0, b1, b2, b3);
    fit.edge = 1.06269f - 1.65003f * r;
    return fit;
}

// Loss and Fresnel part of a direction whose cosine to the normal is in [0, 1].
FN LayerAlbedo evaluate_layer_albedo(LayerFit fit, float cosine) {
    float s = cosine * fit.inv_alpha;
    vec4 d = fit.denominator;
    vec4 b = fit.fresnel;
    float scale = 1.0f / evaluate_cubic(s, d.x, d.y, d.z, d.w);
    float m2 = (1.0f - cosine) * (1.0f - cosine);
    LayerAlbedo a;
    a.loss = max(0.0f, s * (fit.loss.x + s * fit.loss.y) * scale);
    a.fresnel =
        max(0.0f, m2 * m2 * (1.0f - fit.edge * cosine) * evaluate_cubic(s, b.x, b.y, b.z, b.w) * scale);
    return a;
}

// Means of evaluate_layer_albedo over all directions, weighed with the cosine.
FN LayerAlbedo evaluate_mean_layer_albedo(float alpha) {
    float r = sqrt(alpha);
    LayerAlbedo a;
    a.loss = alpha * alpha * evaluate_quartic(r, 2.70727f, -24.9466f, 119.607f, -126.613f, 41.0586f) /
             evaluate_cubic(r, 1.0f, -6.96359f, 23.5376f, 2.40249f);
    a.fresnel = evaluate_quartic(r, 0.0461209f, 0.0669705f, -0.512391f, 0.686595f, -0.284183f);
    return a;
}

SHARED_END
