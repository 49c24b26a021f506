// A point to be lit, and the light that it reflects towards the viewer.
#pragma once

#include "shared/dialect.h"
#include "shared/math/brdf.h"
#include "shared/math/light.h"

SHARED_BEGIN

// All that shading and rays need of a visible surface. Normals are unit and on the viewer's side.
struct ShadingPoint {
    vec3 position;         // relative to the world's origin, metres
    float position_error;  // bound on its rounding error, metres; see ray_offset.h
    vec3 geometric_normal;
    vec3 shading_normal;  // interpolated, normal-mapped
    SurfaceMaterial material;
};

// What scene/surface.h finds at a hit.
struct Surface {
    ShadingPoint point;
    vec3 emission;  // towards the viewer: W sr^-1 m^-2; 0 on the back of a single-sided material
    bool unlit;     // emission is the whole answer and holds for the camera alone
};

// Reflected radiance for one incident sample: BRDF * cosine * value. Divide by the sample's pdf. Light from
// behind the true surface reflects nothing, whatever the shading normal says. `diffuse` is demodulated: times
// the albedo and plus `specular` it is the whole.
FN BrdfValue reflect_light_parts(ShadingPoint p, Frame frame, BrdfView prepared, IncidentLight incident) {
    vec3 light_local = to_local(frame, incident.direction);
    vec3 arriving = incident.value * max(light_local.z, 0.0f);
#ifdef TARN_PLANT_DROP_COSINE
    arriving = incident.value;
#endif
    if (dot(p.geometric_normal, incident.direction) <= 0.0f) arriving = vec3(0.0f);
    return scale_parts(evaluate_brdf_parts(p.material, prepared, light_local), arriving);
}

FN BrdfValue reflect_light_parts(ShadingPoint p, Frame frame, vec3 view_local, IncidentLight incident) {
    return reflect_light_parts(p, frame, prepare_brdf(p.material, view_local), incident);
}

FN vec3 reflect_light(ShadingPoint p, Frame frame, BrdfView prepared, IncidentLight incident) {
    return join_parts(p.material, reflect_light_parts(p, frame, prepared, incident));
}

// The same for a single sample.
FN vec3 reflect_light(ShadingPoint p, Frame frame, vec3 view_local, IncidentLight incident) {
    return reflect_light(p, frame, prepare_brdf(p.material, view_local), incident);
}

// The resampling target (p-hat): BRDF * Le * G without visibility, its channels weighed by `weights`: those
// of the luminance, or a single channel.
FN float target_function(vec3 reflected, vec3 weights) {
    return dot(reflected, weights);
}

SHARED_END
