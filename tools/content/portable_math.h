// Sine, cosine, rotations and random numbers that give the same bits on every machine, so that the content
// does too.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace tarn::content {

inline constexpr double PI = 3.14159265358979323846;

// Sine and cosine from IEEE additions and multiplications alone (libm may differ between machines); error
// below 1e-14 for angles of a few turns.
double sine(double angle_rad);
double cosine(double angle_rad);

// Rotation by an angle about a unit axis, counter-clockwise seen against the axis.
glm::quat rotate_about(const glm::vec3& axis, double angle_rad);

// Column-major matrices for placing shapes.
glm::mat4 move_by(const glm::vec3& offset);
glm::mat4 turn_x(double angle_rad);
glm::mat4 turn_y(double angle_rad);
glm::mat4 stretch(const glm::vec3& factors);

// Counter-based random numbers: a pure function of (seed, index, dimension).
class Random {
  public:
    explicit Random(std::uint64_t seed) : seed_(seed) {}

    // 64 well-mixed bits.
    std::uint64_t bits(std::uint64_t index, std::uint64_t dimension) const;

    // Uniform in [0, 1), a multiple of 2^-24.
    float unit(std::uint64_t index, std::uint64_t dimension) const;

    // Uniform in [low, high).
    float between(float low, float high, std::uint64_t index, std::uint64_t dimension) const;

    // Uniform direction; uses `dimension` and the one after it.
    glm::vec3 direction(std::uint64_t index, std::uint64_t dimension) const;

  private:
    std::uint64_t seed_;
};

}  // namespace tarn::content
