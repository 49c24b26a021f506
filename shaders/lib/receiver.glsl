// A lit point of the picture, and what light is worth there: the target function of all resampling.
//
// After lib/scene_buffers.glsl, lib/frame.glsl, lib/gbuffer.glsl and the constants of the pass, whose
// `target_weights` are Rec. 709 luminance or a single channel.
#include "shared/math/shadow_ray.h"

struct Receiver {
    ShadingPoint point;
    Frame frame;
    BrdfView brdf;
};

Receiver make_receiver(ShadingPoint point, vec3 to_viewer) {
    Receiver r;
    r.point = point;
    r.frame = make_frame(point.shading_normal);
    r.brdf = prepare_brdf(point.material, to_local(r.frame, to_viewer));
    return r;
}

// The receiver of a pixel; false where nothing is lit.
bool load_receiver(ivec2 pixel, out Receiver r) {
    ShadingPoint point;
    bool lit = load_shading_point(pixel, point);
    r = make_receiver(point, -pixel_ray(pixel).direction);
    return lit;
}

BrdfValue reflect_at(Receiver r, IncidentLight incident) {
    return reflect_light_parts(r.point, r.frame, r.brdf, incident);
}

// p-hat of what a receiver reflects.
float target_of(Receiver r, BrdfValue reflected) {
    return target_function(join_parts(r.point.material, reflected), target_weights.xyz);
}

// p-hat without visibility.
float target_at(Receiver r, IncidentLight incident) { return target_of(r, reflect_at(r, incident)); }
