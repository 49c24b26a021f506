// The mean of pictures that come one by one, and how far it may be from where it goes.
#pragma once

#include "shared/dialect.h"
#include "shared/math/colour.h"

SHARED_BEGIN

// `mean`: RGB, and the sum of squared deviations of luminance (Welford, "Note on a method for calculating
// corrected sums of squares and products", Technometrics 1962). `frames` have been added before `radiance`;
// what is not finite counts as the mean.
FN vec4 add_to_mean(vec4 mean, vec3 radiance, uint frames) {
    if (frames == 0u) return is_finite3(radiance) ? vec4(radiance, 0.0f) : vec4(0.0f);
    vec3 before = vec3(mean);
    vec3 added = is_finite3(radiance) ? radiance : before;
    vec3 after = before + (added - before) / float(frames + 1u);
    return vec4(after, mean.w + luminance(added - before) * luminance(added - after));
}

// Variance of the mean's luminance, of two frames or more.
FN float variance_of_mean(vec4 mean, uint frames) {
    return mean.w / (float(frames) * float(frames - 1u));
}

// How much of the mean is shown in place of the picture before it: few frames are noisier than that one.
FN float share_of_mean(uint frames) {
    const float FIRST = 4.0f;
    const float LAST = 48.0f;
    float t = clamp((float(frames) - FIRST) / (LAST - FIRST), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

SHARED_END
