// FLIP: the difference that a person sees when two images alternate on a screen.
//
// LDR-FLIP: P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", HPG 2020. HDR-FLIP: P. Andersson, J. Nilsson, P. Shirley, T.
// Akenine-Moller, "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021. Written from
// the papers' definitions.
#pragma once

#include "core/image.h"

namespace tarn {

// A screen 0.7 m and 3840 pixels wide, seen from 0.7 m, as in the papers: 3840 * pi / 180, "67 pixels per
// degree".
constexpr double FLIP_PIXELS_PER_DEGREE = 67.02064327658225;

// Returns the error of each pixel in [0, 1] (1 channel) between display-encoded sRGB images; values outside
// [0, 1] are clamped. Pixels that are not finite in either image are NaN in the map and count as black in
// their neighbourhood. Throws Error where sizes differ or channels are not 3.
Image compute_ldr_flip(const Image& reference, const Image& image,
                       double pixels_per_degree = FLIP_PIXELS_PER_DEGREE);

struct HdrFlip {
    Image map;  // per pixel the largest LDR-FLIP error over the exposures, in [0, 1]; NaN as in
                // compute_ldr_flip
    double start_exposure_ev = 0;
    double stop_exposure_ev = 0;
    int exposure_count = 0;
};

// The same for linear radiance, at every exposure at which a person would look at the reference: from that
// which maps its brightest luminance to 85 % of white under the ACES approximation, to that which does so for
// its median, about one stop apart. Negative radiance counts as 0.
HdrFlip compute_hdr_flip(const Image& reference, const Image& image,
                         double pixels_per_degree = FLIP_PIXELS_PER_DEGREE);

// The mean of the finite pixels of a map: "the FLIP value" of two images. NaN where there is none.
double mean_error(const Image& map);

}  // namespace tarn
