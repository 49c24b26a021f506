// Conversions between FLIP's colour spaces.
#include "metrics/flip_colour.h"

#include <cmath>

namespace tarn {
namespace {

struct Matrix {
    double m[3][3];
};

Colour multiply(const Matrix& a, const Colour& c) {
    const auto row = [&](int i) { return float(a.m[i][0] * c.x + a.m[i][1] * c.y + a.m[i][2] * c.z); };
    return {row(0), row(1), row(2)};
}

// From linear Rec. 709 to CIE XYZ, as exact fractions of the primaries' and D65's chromaticities.
constexpr Matrix XYZ_FROM_RGB = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                  {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                  {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

constexpr double determinant(const Matrix& a) {
    const auto& m = a.m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

constexpr Matrix inverse(const Matrix& a) {
    Matrix result{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            // The cyclic order of the minors carries the cofactors' signs.
            const int r0 = (j + 1) % 3;
            const int r1 = (j + 2) % 3;
            const int c0 = (i + 1) % 3;
            const int c1 = (i + 2) % 3;
            result.m[i][j] = (a.m[r0][c0] * a.m[r1][c1] - a.m[r0][c1] * a.m[r1][c0]) / determinant(a);
        }
    }
    return result;
}

constexpr Matrix RGB_FROM_XYZ = inverse(XYZ_FROM_RGB);

// White is the XYZ of RGB (1, 1, 1).
constexpr double white(int i) {
    return XYZ_FROM_RGB.m[i][0] + XYZ_FROM_RGB.m[i][1] + XYZ_FROM_RGB.m[i][2];
}
constexpr float WHITE_X = float(white(0));
constexpr float WHITE_Z = float(white(2));

Colour normalized_xyz(const Colour& rgb) {
    const Colour xyz = multiply(XYZ_FROM_RGB, rgb);
    return {xyz.x / WHITE_X, xyz.y, xyz.z / WHITE_Z};
}

float lab_curve(float t) {
    constexpr float DELTA = 6.0f / 29.0f;
    return t > DELTA * DELTA * DELTA ? std::cbrt(t) : t / (3.0f * DELTA * DELTA) + 4.0f / 29.0f;
}

Colour opponents(float x, float y, float z) {
    return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

}  // namespace

Colour ycxcz_from_linear_rgb(const Colour& rgb) {
    const Colour xyz = normalized_xyz(rgb);
    return opponents(xyz.x, xyz.y, xyz.z);
}

Colour linear_rgb_from_ycxcz(const Colour& ycxcz) {
    const float y = (ycxcz.x + 16.0f) / 116.0f;
    return multiply(RGB_FROM_XYZ, {(y + ycxcz.y / 500.0f) * WHITE_X, y, (y - ycxcz.z / 200.0f) * WHITE_Z});
}

Colour hunt_lab_from_linear_rgb(const Colour& rgb) {
    const Colour xyz = normalized_xyz(rgb);
    const Colour lab = opponents(lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z));
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

float hyab_distance(const Colour& a, const Colour& b) {
    const float da = a.y - b.y;
    const float db = a.z - b.z;
    return std::abs(a.x - b.x) + std::sqrt(da * da + db * db);
}

}  // namespace tarn
