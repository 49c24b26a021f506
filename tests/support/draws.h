// Numbers for tests: a stream of uniform doubles that is independent of the generator under test.
#pragma once

#include <cstdint>
#include <random>

#include "shared/dialect.h"

namespace tarn::test {

// Uniform numbers, the same on every platform: std::mt19937_64 is fixed by the standard, its distributions
// are not.
class Draws {
  public:
    explicit Draws(std::uint64_t seed) : engine_(seed) {}

    // In [0, 1), 53 bits.
    double uniform() { return double(engine_() >> 11) * 0x1p-53; }
    // In [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    // In [0, 1), with the 24 bits that the shaders' numbers have.
    float uniform_float() { return float(engine_() >> 40) * 0x1p-24f; }
    vec2 uniform_vec2() {
        const float x = uniform_float();
        const float y = uniform_float();
        return vec2(x, y);
    }
    vec3 uniform_vec3() {
        const vec2 xy = uniform_vec2();
        return vec3(xy, uniform_float());
    }
    std::uint32_t bits() { return std::uint32_t(engine_() >> 32); }
    // A unit vector, uniform on the sphere, rounded to single precision.
    vec3 unit_vector() {
        const double z = uniform(-1.0, 1.0);
        const double phi = uniform(0.0, 6.283185307179586);
        const double r = std::sqrt(1.0 - z * z);
        return vec3(float(r * std::cos(phi)), float(r * std::sin(phi)), float(z));
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace tarn::test
