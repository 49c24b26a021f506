// A path on its way: the sample that it will be, and what lies beyond the sample's place.
//
// From the place (the first surface that the path met) light comes from two directions: `sample.incident_direction`, by
// next-event estimation there, and `further_direction`, along which the path went on. Rows of the state, a pixel:
//   0  instance, primitive, normal of the place       further direction
//   1  barycentrics, incident direction, 0
//   2  material
//   3  incident light (by next-event estimation)      0
//   4  light from the further direction so far        1: it is irradiance of the base, from everywhere
//   5  throughput from the place on                   0
//   6  light that waits for its shadow ray            0
#include "shared/interface/path_state.h"
#include "shared/math/path_sample.h"

struct PathState {
    PathSample place;
    vec3 further_direction;
    vec3 further;                // over the density of its direction
    bool further_is_irradiance;  // out of a cache, W/m^2, and from no direction
    vec3 throughput;             // BRDF * cosine / density along the way; first: 1 / density
    vec3 waiting;                // throughput included
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
    s.throughput = row_xyz(texelFetch(rows, row + 5));
    s.waiting = row_xyz(texelFetch(rows, row + 6));
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
