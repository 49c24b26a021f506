// Sine and cosine by range reduction and Taylor series; rotations; a counter-based hash as random numbers.
#include "content/portable_math.h"

#include <cmath>

namespace tarn::content {
namespace {

// Taylor series, good to double precision for |x| <= pi/4.
double sine_series(double x) {
    const double square = x * x;
    double sum = 0.0;
    for (int n = 17; n >= 3; n -= 2) sum = (1.0 + sum) * -square / (n * (n - 1));
    return x * (1.0 + sum);
}

double cosine_series(double x) {
    const double square = x * x;
    double sum = 0.0;
    for (int n = 18; n >= 2; n -= 2) sum = (1.0 + sum) * -square / (n * (n - 1));
    return 1.0 + sum;
}

std::uint64_t mix(std::uint64_t x) {
    x ^= x >> 32;
    x *= 0xd6e8feb86659fd93ull;
    x ^= x >> 32;
    x *= 0xd6e8feb86659fd93ull;
    return x ^ (x >> 32);
}

glm::mat4 turn(const glm::vec3& axis, double angle_rad) {
    return glm::mat4_cast(rotate_about(axis, angle_rad));
}

}  // namespace

double sine(double angle_rad) {
    const double quarter_turns = std::floor(angle_rad * (2.0 / PI) + 0.5);
    const double rest = angle_rad - quarter_turns * (0.5 * PI);
    switch (static_cast<long long>(quarter_turns) & 3) {
        case 0:
            return sine_series(rest);
        case 1:
            return cosine_series(rest);
        case 2:
            return -sine_series(rest);
        default:
            return -cosine_series(rest);
    }
}

double cosine(double angle_rad) {
    return sine(angle_rad + 0.5 * PI);
}

glm::quat rotate_about(const glm::vec3& axis, double angle_rad) {
    const float s = static_cast<float>(sine(0.5 * angle_rad));
    return glm::quat(static_cast<float>(cosine(0.5 * angle_rad)), s * axis.x, s * axis.y, s * axis.z);
}

glm::mat4 move_by(const glm::vec3& offset) {
    glm::mat4 matrix(1.0f);
    matrix[3] = glm::vec4(offset, 1.0f);
    return matrix;
}

glm::mat4 turn_x(double angle_rad) {
    return turn({1, 0, 0}, angle_rad);
}
glm::mat4 turn_y(double angle_rad) {
    return turn({0, 1, 0}, angle_rad);
}

glm::mat4 stretch(const glm::vec3& factors) {
    glm::mat4 matrix(1.0f);
    for (int axis = 0; axis < 3; ++axis) matrix[axis][axis] = factors[axis];
    return matrix;
}

std::uint64_t Random::bits(std::uint64_t index, std::uint64_t dimension) const {
    return mix(mix(mix(seed_ + 0x9e3779b97f4a7c15ull) + index) + dimension * 0xbf58476d1ce4e5b9ull);
}

float Random::unit(std::uint64_t index, std::uint64_t dimension) const {
    return static_cast<float>(bits(index, dimension) >> 40) * (1.0f / 16777216.0f);
}

float Random::between(float low, float high, std::uint64_t index, std::uint64_t dimension) const {
    return low + (high - low) * unit(index, dimension);
}

glm::vec3 Random::direction(std::uint64_t index, std::uint64_t dimension) const {
    const double z = 1.0 - 2.0 * unit(index, dimension);
    const double angle = 2.0 * PI * unit(index, dimension + 1);
    const double radius = std::sqrt(1.0 - z * z);
    return glm::vec3(radius * cosine(angle), radius * sine(angle), z);
}

}  // namespace tarn::content
