// Colour spaces of FLIP: linear Rec. 709 RGB, YCxCz (a linearized CIELAB) and Hunt-adjusted CIELAB, all for
// D65.
#pragma once

namespace tarn {

struct Colour {
    float x = 0;
    float y = 0;
    float z = 0;
};

Colour ycxcz_from_linear_rgb(const Colour& rgb);
Colour linear_rgb_from_ycxcz(const Colour& ycxcz);

// CIELAB with a* and b* scaled by L* / 100: colours look less colourful in the dark (the Hunt effect).
Colour hunt_lab_from_linear_rgb(const Colour& rgb);

// The HyAB distance: |dL| + sqrt(da^2 + db^2) (Abasi et al. 2020).
float hyab_distance(const Colour& a, const Colour& b);

}  // namespace tarn
