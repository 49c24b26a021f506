// The dialect: one text that compiles as GLSL 4.50 and as C++ (GLM). Every header of shared/ includes this
// first.
//
// Rules: no swizzles, float literals as 1.0f, INOUT(T) / OUT(T) for parameters, FN before each function. C++
// does not fix the order in which arguments are evaluated, so a call that advances a state gets a line of its
// own.
#pragma once

#ifdef TARN_GLSL

#define FN
#define INOUT(T) inout T
#define OUT(T) out T
#define SHARED_BEGIN
#define SHARED_END
#define CONSTANT const
#define CONSTANT_MEMBER const

#else

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#define FN inline
#define INOUT(T) T&
#define OUT(T) T&
#define SHARED_BEGIN namespace tarn {
#define SHARED_END }
#define CONSTANT inline constexpr
#define CONSTANT_MEMBER static constexpr

namespace tarn {

using uint = unsigned int;
using glm::abs, glm::clamp, glm::cross, glm::dot, glm::floor, glm::length, glm::max, glm::min, glm::mix;
using glm::cos, glm::sin, glm::sqrt, glm::exp2, glm::log2, glm::pow, glm::acos, glm::normalize;
using glm::floatBitsToUint, glm::uintBitsToFloat, glm::packUnorm2x16, glm::unpackUnorm2x16;
using glm::vec2, glm::vec3, glm::vec4, glm::ivec2, glm::ivec4, glm::uvec2, glm::uvec3, glm::uvec4;

// GLSL's two-argument arc tangent.
inline float atan(float y, float x) {
    return std::atan2(y, x);
}

}  // namespace tarn

#endif

SHARED_BEGIN

CONSTANT float PI = 3.14159265358979f;
CONSTANT float INV_PI = 0.318309886183791f;
CONSTANT uint INVALID_INDEX = 0xffffffffu;
// Distance of a ray that goes on for ever. Finite, so that products with 0 stay 0.
CONSTANT float RAY_INFINITY = 1e30f;

FN float max_component(vec3 v) {
    return max(v.x, max(v.y, v.z));
}

// True for a number that is neither NaN nor infinite. Looks at the exponent's bits, which no compiler folds
// away.
FN bool is_finite(float x) {
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
}

FN bool is_finite3(vec3 v) {
    return is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
}

// The upper 32 bits of the 64-bit product.
FN uint multiply_high(uint a, uint b) {
#ifdef TARN_GLSL
    uint high, low;
    umulExtended(a, b, high, low);
    return high;
#else
    return uint((std::uint64_t(a) * b) >> 32);
#endif
}

// a / b, and 0 where b is exactly 0.
FN float ratio_or_zero(float a, float b) {
    return b == 0.0f ? 0.0f : a / b;
}

// v / |v| without underflow or overflow on the way; +Y for a vector without direction.
FN vec3 normalize_or_up(vec3 v) {
    float scale = max_component(abs(v));
    if (!(scale > 0.0f) || !is_finite(scale)) return vec3(0.0f, 1.0f, 0.0f);
    return normalize(v / scale);
}

SHARED_END
