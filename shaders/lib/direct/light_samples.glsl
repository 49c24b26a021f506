// Direct light's part of reuse: what a sample is, its target, its ray, and how it moves between receivers and frames.
//
// The other part, lib/reuse, knows no light. After lib/receiver.glsl; for reuse over time after lib/previous.glsl with
// TARN_PREVIOUS_FRAME defined.
#include "shared/math/light_sample.h"

#define SAMPLE LightSample
#define SAMPLE_ROWS LIGHT_SAMPLE_ROWS
const uint TEMPORAL_DIMENSION = DIMENSION_TEMPORAL;
const uint SPATIAL_DIMENSION = DIMENSION_SPATIAL;

SAMPLE no_sample() { return no_light_sample(); }
uvec3 pack_sample(SAMPLE drawn) { return pack_light_sample(drawn); }
SAMPLE load_sample(usamplerBuffer rows, uvec3 head, int row) { return unpack_light_sample(head); }
uvec4 pack_sample_row(SAMPLE drawn, uint index) { return uvec4(0u); }
// False for a sample that a move between frames has lost.
bool is_sample(SAMPLE drawn) { return drawn.light != INVALID_INDEX; }

// p-hat without visibility.
float sample_target(Receiver r, SAMPLE drawn) {
    return target_at(r, load_incident_light(drawn, r.point.position));
}

// What the sample sends to the viewer if it is seen, not yet weighed by W.
BrdfValue reflect_sample(Receiver r, SAMPLE drawn) {
    return reflect_at(r, load_incident_light(drawn, r.point.position));
}

// The ray that asks whether the receiver of `pixel` sees the sample; inactive where the answer does not matter.
RayRecord sample_ray(Receiver r, SAMPLE drawn, ivec2 pixel) {
    IncidentLight incident = load_incident_light(drawn, r.point.position);
    if (max_component(incident.value) == 0.0f) return inactive_ray();
    return make_shadow_ray(r.point, incident, load_light_error(drawn), pixel_index(pixel));
}

// |dT/dx| of the shift from one receiver's domain to another's. A place on a light is the same for both.
float shift_jacobian(Receiver from, Receiver to, SAMPLE drawn) { return 1.0f; }

// Whether receivers of these GGX widths may share samples, whatever the weights.
bool can_share(float alpha, float other_alpha) { return true; }

#ifdef TARN_PREVIOUS_FRAME
#include "lib/direct/previous_lights.glsl"
#endif
