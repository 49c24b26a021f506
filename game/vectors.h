// Arithmetic of points and directions.
#pragma once

#include <cmath>

#include "tarn_names.h"

namespace game {

struct Vec2 {
    double x = 0.0;
    double y = 0.0;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline Vec3 operator*(const Vec3& v, double factor) {
    return {v.x * factor, v.y * factor, v.z * factor};
}

inline double dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(const Vec3& v) {
    return std::hypot(v.x, v.y, v.z);
}

// `v` must not be 0.
inline Vec3 normalize(const Vec3& v) {
    return v * (1.0 / length(v));
}

}  // namespace game
