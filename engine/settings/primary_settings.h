// How a frame finds what its pixels see.
#pragma once

namespace tarn {

enum class PrimaryVisibility {
    AUTO,    // whichever costs less here (plan_primary)
    RASTER,  // GL draws all triangles in view
    RAYS,    // the ray tracer's workers trace a ray through each pixel
};

struct PrimarySettings {
    PrimaryVisibility visibility = PrimaryVisibility::AUTO;

    bool operator==(const PrimarySettings&) const = default;
};

}  // namespace tarn
