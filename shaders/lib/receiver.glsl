// A lit point of the picture, and the target function of all resampling there.
//
// After lib/scene_buffers.glsl, lib/frame.glsl and lib/gbuffer.glsl.
#include "shared/math/shadow_ray.h"

// (Rec. 709 luminance, or a single channel) . reflected radiance is the target (p-hat).
uniform vec3 target_weights = vec3(0.2126f, 0.7152f, 0.0722f);

struct Receiver {
    ShadingPoint point;
    Frame frame;
    vec3 view_local;
};

Receiver make_receiver(ShadingPoint point, vec3 to_viewer) {
    Receiver r;
    r.point = point;
    r.frame = make_frame(point.shading_normal);
    r.view_local = to_local(r.frame, to_viewer);
    return r;
}

// The receiver of a pixel; false where nothing is lit.
bool load_receiver(ivec2 pixel, out Receiver r) {
    ShadingPoint point;
    bool lit = load_shading_point(pixel, point);
    r = make_receiver(point, -pixel_ray(pixel).direction);
    return lit;
}

vec3 reflect_at(Receiver r, IncidentLight incident) {
    return reflect_light(r.point, r.frame, r.view_local, incident);
}

// p-hat without visibility.
float target_at(Receiver r, IncidentLight incident) {
    return target_function(reflect_at(r, incident), target_weights);
}

float sample_target(Receiver r, LightSample drawn) {
    return target_at(r, load_incident_light(drawn, r.point.position));
}

// The ray that asks whether the receiver of `pixel` sees `drawn`; inactive where the answer does not matter.
RayRecord sample_ray(Receiver r, LightSample drawn, ivec2 pixel) {
    IncidentLight incident = load_incident_light(drawn, r.point.position);
    if (max_component(incident.value) == 0.0f) return inactive_ray();
    return make_shadow_ray(r.point, incident, load_light_error(drawn), pixel_index(pixel));
}
