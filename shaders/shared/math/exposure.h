// Automatic exposure: from a histogram of how bright pixels are to an EV. core/display.cpp counts on the CPU,
// passes/exposure on the device, both by this text.
//
// Two rules, of which the darker one holds:
//  * grey: the mean in stops of the middle half of the pixels becomes middle grey;
//  * white: at most EXPOSURE_CLIPPED_SHARE of the pixels are brighter than white: 1 where the tone curve cuts
//  off,
//    2 with "neutral", which shows that 4 steps of 255 below white. Beside that share, lamps that are seen
//    directly may be: pixels EXPOSURE_LAMP_STOPS brighter than the middle, while few pixels
//    (EXPOSURE_BRIGHT_FEW) would be brighter than white by the rule of grey. The more there are (up to
//    EXPOSURE_BRIGHT_MANY), the more the rule includes lamps.
//
// A pixel is as bright as its brightest channel, for that one clips first. Black pixels and those that are
// not finite do not count.
#pragma once

#include "shared/dialect.h"
#include "shared/math/display.h"

SHARED_BEGIN

CONSTANT float EXPOSURE_MIDDLE_GREY = 0.18f;
CONSTANT float EXPOSURE_CLIPPED_SHARE = 0.02f;
CONSTANT float EXPOSURE_LAMP_STOPS = 6.0f;
CONSTANT float EXPOSURE_BRIGHT_FEW = 0.1f;
CONSTANT float EXPOSURE_BRIGHT_MANY = 0.2f;
CONSTANT float EXPOSURE_LIMIT_EV = 20.0f;

// Bins of the histogram: 16 an octave, from 2^-32 to 2^32; what lies outside counts in the outermost ones.
CONSTANT int EXPOSURE_BINS = 1024;
CONSTANT int EXPOSURE_BINS_PER_OCTAVE = 16;
CONSTANT float EXPOSURE_FIRST_STOPS = -32.0f;

CONSTANT int EXPOSURE_GROUPS = 16;  // of the device's threads, each with a histogram of its own

// At most so many places of a picture are looked at, in a grid.
CONSTANT int EXPOSURE_PLACES = 262144;

// Every so many pixels along each axis are looked at.
FN int exposure_stride(int width_px, int height_px) {
    float pixels = float(width_px) * float(height_px);
    int stride = 1;
    while (pixels > float(EXPOSURE_PLACES) * float(stride * stride)) ++stride;
    return stride;
}

// The bin of a pixel; -1: it does not count. The leading bits of a float are its octave and sixteenth: no
// logarithm, and the same bin on every machine.
FN int exposure_bin(vec3 rgb) {
    float brightest = max_component(rgb);
    if (!is_finite3(rgb) || !(brightest > 0.0f)) return -1;
    int sixteenth = int(floatBitsToUint(brightest) >> 19);
    return clamp(sixteenth - (127 + int(EXPOSURE_FIRST_STOPS)) * EXPOSURE_BINS_PER_OCTAVE, 0,
                 EXPOSURE_BINS - 1);
}

// Where a bin begins, in stops.
FN float exposure_bin_stops(int bin) {
    int octave = bin / EXPOSURE_BINS_PER_OCTAVE;
    float part = float(bin - octave * EXPOSURE_BINS_PER_OCTAVE) / float(EXPOSURE_BINS_PER_OCTAVE);
    return EXPOSURE_FIRST_STOPS + float(octave) + log2(1.0f + part);
}

// The middle of a bin, in stops.
FN float exposure_bin_middle(int bin) {
    return 0.5f * (exposure_bin_stops(bin) + exposure_bin_stops(bin + 1));
}

// How many of the `count` pixels of a bin, with `before` in the bins below, are of the middle half of
// `total`.
FN float count_in_middle_half(uint before, uint count, uint total) {
    uint from = max(before, total / 4u);
    uint to = min(before + count, total - total / 4u);
    return to > from ? float(to - from) : 0.0f;
}

// What the histogram of `total` pixels says, in stops. Nothing but the top of a bin is called white: so no
// more pixels clip than may.
struct ExposureLevels {
    float middle;        // mean of the middle half
    float white;         // few enough pixels are brighter
    float white_lit;     // the same where lamps do not count
    float bright_share;  // of the pixels: brighter than white by the rule of grey
};

FN float find_white_level(uint tone) {
    return tone == TONE_CLIP ? 1.0f : 2.0f;
}

// From here on a pixel is brighter than white by the rule of grey.
FN float find_bright_stops(float middle, uint tone) {
    return middle + log2(find_white_level(tone) / EXPOSURE_MIDDLE_GREY);
}

FN float choose_exposure_ev(ExposureLevels levels, uint tone) {
    float many = (levels.bright_share - EXPOSURE_BRIGHT_FEW) / (EXPOSURE_BRIGHT_MANY - EXPOSURE_BRIGHT_FEW);
    float white = mix(levels.white_lit, levels.white, clamp(many, 0.0f, 1.0f));
    float ev = min(log2(EXPOSURE_MIDDLE_GREY) - levels.middle, log2(find_white_level(tone)) - white);
    return clamp(ev, -EXPOSURE_LIMIT_EV, EXPOSURE_LIMIT_EV);
}

SHARED_END
