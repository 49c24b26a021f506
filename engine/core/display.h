// From linear radiance to what a screen shows: exposure, tone mapping, sRGB.
#pragma once

#include <span>
#include <string>

#include "core/image.h"

namespace tarn {

// The sRGB transfer function (IEC 61966-2-1) of a linear value, and its inverse. Both continue below 0
// linearly.
float encode_srgb(float linear);
float decode_srgb(float encoded);

// How exposed radiance becomes a colour of the screen; values are those of TONE_* in shared/math/display.h.
enum class ToneCurve {
    CLIP,     // cut off at white
    NEUTRAL,  // Khronos PBR Neutral: hues and base colours stay, highlights are compressed
};

// The names of the curves, in the order of the enumeration.
std::span<const char* const> tone_curve_names();

// The curve of that name. Throws Error that lists the names.
ToneCurve parse_tone_curve(const std::string& name);

// How radiance is shown. As it is by default, pictures are measured: without glare.
struct DisplayLook {
    ToneCurve tone = ToneCurve::NEUTRAL;
    float glare = 0.0f;  // its strength (core/glare.h); 0: none
};

// Returns display-encoded RGB in [0, 1]: radiance times 2^exposure_ev, with glare, tone-mapped, sRGB-encoded.
// Negative and NaN values count as 0, infinite ones as white. 3 channels in and out.
Image display_from_radiance(const Image& radiance, float exposure_ev, const DisplayLook& look = {});

// The EV for pictures that people look at, by the two rules at the head of shared/math/exposure.h: the middle
// of the picture becomes middle grey, unless more than 2 % of the pixels, besides a few lamps, would be
// brighter than white. Pixels that are black or not finite do not count. Within +-20; 0 where no pixel
// counts.
float auto_exposure_ev(const Image& radiance, ToneCurve tone = ToneCurve::NEUTRAL);

// The EV by which errors are measured: it maps the log-average luminance to middle grey 0.18, over finite
// pixels that are not black, without the darkest and the brightest 1 %. Within +-20; 0 where no pixel counts.
float measuring_exposure_ev(const Image& radiance);

}  // namespace tarn
