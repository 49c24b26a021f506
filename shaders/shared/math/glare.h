// Glare: what is brighter than white scatters in the eye. core/glare.cpp spreads it on the CPU, passes/glare
// on the device, both by this text.
//
// The veil at an angle t from a lamp is 10 E / t^2 (t in degrees, E in lux: Stiles and Holladay; Vos,
// "Disability glare - a state of the art report", CIE Journal 3, 1984). Each doubling of the angle holds the
// same energy: 10 (pi / 180)^2 2 pi ln 2, 1.3 % of the lamp's. So light is spread by a pyramid of pictures,
// each half as wide as the one before (after Jimenez, "Next Generation Post Processing in Call of Duty:
// Advanced Warfare", SIGGRAPH 2014), that all weigh the same.
//
// A picture is enlarged by linear interpolation between cells, and made smaller by the transpose of that: a
// cell is the mean of the pixels that it would enlarge into, weighted by their areas. So energy is kept to
// rounding, also at borders and odd sizes, and an even picture stays as it is. The alpha channel holds the
// areas.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// Of a lamp's light, in each octave of distance, at strength 1.
CONSTANT float GLARE_PER_OCTAVE = 0.0133f;
CONSTANT float GLARE_BRIGHTEST = 1024.0f;  // times white; the rest of a pixel's light stays where it is
CONSTANT int GLARE_MOST_LEVELS = 10;

// Of exposed light, what is brighter than white: what scatters, a share of it, the colour kept.
FN vec3 find_excess(vec3 exposed) {
    float brightest = max_component(exposed);
    if (!(brightest > 1.0f)) return vec3(0.0f);
    return exposed * ((min(brightest, GLARE_BRIGHTEST) - 1.0f) / brightest);
}

// How many pictures the pyramid has: the last one's cells are a quarter of the picture's larger side or less.
FN int count_glare_levels(int width_px, int height_px) {
    int levels = 1;
    while (levels < GLARE_MOST_LEVELS && (8 << levels) <= max(width_px, height_px)) ++levels;
    return levels;
}

// Cells along an axis of `size` pixels.
FN int halve_size(int size) {
    return (size + 1) / 2;
}

// A cell is a mean of four pixels along each axis. Pixel `tap` (0 to 3) of `cell`, -1 beyond the picture's
// end; beyond its start it is the first pixel, as the last one at an even end.
FN int glare_pixel(int cell, int tap, int size) {
    int pixel = clamp(2 * cell - 1 + tap, 0, 2 * halve_size(size) - 1);
    return pixel < size ? pixel : -1;
}

FN float glare_weight(int tap) {
    return tap == 1 || tap == 2 ? 0.75f : 0.25f;
}

// A pixel lies between two cells: the nearer one, of weight 0.75, and this one, of weight 0.25.
FN int glare_neighbour(int pixel, int cells) {
    return clamp(pixel / 2 + (pixel & 1) * 2 - 1, 0, cells - 1);
}

// Exposed light of a pixel after scattering. `spread` is the sum of the pyramid's `levels` pictures there.
FN vec3 add_glare(vec3 exposed, vec3 spread, int levels, float strength) {
    float share = GLARE_PER_OCTAVE * strength;
    return exposed + share * (spread - float(levels) * find_excess(exposed));
}

SHARED_END
