// A path on its way: the sample that it will be, and what lies beyond the sample's place.
//
// From the place (the first surface that the path met) light comes from two directions: `sample.incident_direction`, by
// next-event estimation there, and `further_direction`, along which the path went on. Rows of the state, a pixel:
//   0  instance, primitive, normal of the place       further direction
//   1  barycentrics, incident direction, 0
//   2  material
//   3  incident light (by next-event estimation)      0
//   4  light from the further direction so far        1: it is irradiance of the base, from everywhere
//   5  throughput from the place on                   shading normal of the last surface
//   6  light that waits for its shadow ray            0
//   7  position of the last surface                   density of the direction in which the path left it
#include "shared/interface/path_state.h"
#include "shared/math/path_sample.h"

struct PathState {
    PathSample place;
    vec3 further_direction;
    vec3 further;                // over the density of its direction
    bool further_is_irradiance;  // out of a cache, W/m^2, and from no direction
    vec3 throughput;             // BRDF * cosine / density along the way; first: 1 / density
    vec3 waiting;                // throughput included
    vec3 position;               // of the surface that the path left last
    vec3 normal;                 // its shading normal
    float pdf;                   // of the direction, solid angle; 0: no ray was sent
};

PathState load_path_state(usamplerBuffer rows, uint pixel) {
    int row = int(pixel * PATH_STATE_ROWS);
    uvec4 head = texelFetch(rows, row);
    PathState s;
    s.place = unpack_path_sample(head.xyz, texelFetch(rows, row + 1), texelFetch(rows, row + 2),
                                 texelFetch(rows, row + 3));
    s.further_direction = unpack_direction(head.w);
    uvec4 further = texelFetch(rows, row + 4);
    s.further = row_xyz(further);
    s.further_is_irradiance = further.w != 0u;
    uvec4 throughput = texelFetch(rows, row + 5);
    s.throughput = row_xyz(throughput);
    s.normal = unpack_direction(throughput.w);
    s.waiting = row_xyz(texelFetch(rows, row + 6));
    uvec4 last = texelFetch(rows, row + 7);
    s.position = row_xyz(last);
    s.pdf = uintBitsToFloat(last.w);
    return s;
}

// What waited has its answer: `visible` is 1 or 0.
void settle_waiting(inout PathState s, float visible, bool at_place) {
    if (at_place) {
        s.place.incident *= visible;
    } else {
        s.further += s.waiting * visible;
    }
}
