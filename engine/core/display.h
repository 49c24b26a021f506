// From linear radiance to what a screen shows: exposure, tone mapping, sRGB.
#pragma once

#include "core/image.h"

namespace tarn {

// The sRGB transfer function (IEC 61966-2-1) of a linear value, and its inverse. Both continue below 0
// linearly.
float encode_srgb(float linear);
float decode_srgb(float encoded);

// Returns display-encoded RGB in [0, 1]: radiance times 2^exposure_ev, tone-mapped, sRGB-encoded. Negative
// and NaN values count as 0, infinite ones as white. 3 channels in and out.
Image display_from_radiance(const Image& radiance, float exposure_ev);

// The EV that maps the log-average luminance to middle grey 0.18, over finite pixels that are not black,
// without the darkest and the brightest 1 %. Within +-20; 0 where no pixel counts.
float auto_exposure_ev(const Image& radiance);

}  // namespace tarn
