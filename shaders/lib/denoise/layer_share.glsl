// The share of light that a surface's layer reflects towards its viewer. After lib/frame.glsl, lib/gbuffer.glsl.
#include "shared/math/brdf.h"

// Directional albedo of the layer with both lobes, one number a channel: 0 where there is no layer. Light of the layer
// over this share is light that arrives: textures of colour and roughness are not blurred with it.
vec3 find_layer_share(SurfaceMaterial material, float view_cosine) {
    LayerAlbedo at_view =
        evaluate_layer_albedo(fit_layer(material.alpha), clamp(view_cosine, MIN_VIEW_COSINE, 1.0f));
    LayerAlbedo mean = evaluate_mean_layer_albedo(material.alpha);
    return material.f0 * (1.0f - at_view.loss - at_view.fresnel) + vec3(material.f90) * at_view.fresnel +
           mean_multiple_fresnel(material, mean.loss) * at_view.loss;
}

vec3 load_layer_share(ivec2 pixel) {
#if defined(TARN_LAMBERT_ONLY)
    return vec3(0.0f);
#else
    ShadingPoint point;
    bool lit = load_shading_point(pixel, point);
    vec3 share = find_layer_share(point.material, -dot(point.shading_normal, pixel_ray(pixel).direction));
    return lit ? share : vec3(0.0f);
#endif
}
