// From where a picture is taken.
#pragma once

#include "tarn/values.h"

namespace tarn::api {

// Position in metres and directions, all in world space. The three directions must be at right angles to each
// other; their lengths do not matter. A picture's width follows from its height and its pixels, which are
// square.
struct Camera {
    Vec3 position;
    Vec3 right{1.0, 0.0, 0.0};
    Vec3 up{0.0, 1.0, 0.0};
    Vec3 forward{0.0, 0.0, -1.0};
    // Half the height of what is seen: at a distance of 1 m, so the tangent of half the field of view; of an
    // orthographic camera everywhere, in metres.
    double half_height = 0.5;
    bool orthographic = false;

    // Looks from `position` to `target`, +Y up, with a vertical field of view in degrees, between 0 and 180.
    static Camera look_at(const Vec3& position, const Vec3& target, double vertical_fov_deg);
};

}  // namespace tarn::api
