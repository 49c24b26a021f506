// Points, rotations and placements, as plain numbers.
#pragma once

namespace tarn::api {

// A point or a direction; doubles, so that a scene far from the world's origin keeps its millimetres.
struct Vec3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

// A rotation as a unit quaternion; of any other length it is normalized.
struct Rotation {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double w = 1.0;

    // By `angle_rad` about `axis`, counter-clockwise as seen from where the axis points to.
    static Rotation about(const Vec3& axis, double angle_rad);
};

// Where a node stands in its parent: scaled, then rotated, then moved, as in glTF.
struct Transform {
    Vec3 translation;
    Rotation rotation;
    Vec3 scale{1.0, 1.0, 1.0};
};

// An axis-aligned box. Empty where lower.x > upper.x.
struct Box {
    Vec3 lower;
    Vec3 upper;
};

}  // namespace tarn::api
