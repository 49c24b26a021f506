// What the channels of linear RGB (Rec. 709) add to luminance: the one place of these weights.
#pragma once

#include "shared/dialect.h"

// Of red, green and blue. A macro, for both precisions: vec3(LUMINANCE_WEIGHTS), in C++ dvec3 too.
#define LUMINANCE_WEIGHTS 0.2126, 0.7152, 0.0722

SHARED_BEGIN

// Luminance of linear RGB.
FN float luminance(vec3 rgb) {
    const vec3 weights = vec3(LUMINANCE_WEIGHTS);
    return weights.x * rgb.x + weights.y * rgb.y + weights.z * rgb.z;
}

SHARED_END
