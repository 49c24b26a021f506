#include "torch.h"

#include <cmath>

#include "../vectors.h"

namespace game {
namespace {

constexpr double RIGHT_M = 0.35;
constexpr double BELOW_M = 0.1;
constexpr double AHEAD_M = 0.45;

}  // namespace

Vec3 compute_torch_reach(double yaw_rad, double pitch_rad) {
    const Vec3 right{std::cos(yaw_rad), 0.0, -std::sin(yaw_rad)};
    const Vec3 ahead{-std::sin(yaw_rad) * std::cos(pitch_rad), std::sin(pitch_rad),
                     -std::cos(yaw_rad) * std::cos(pitch_rad)};
    return right * RIGHT_M + ahead * AHEAD_M - Vec3{0.0, BELOW_M, 0.0};
}

double compute_flicker(std::uint64_t step) {
    // Three periods that have no common one within an hour: 1.9 s, 0.62 s and 0.22 s.
    const double t = double(step);
    return 1.0 + 0.09 * std::sin(t * 0.0551) + 0.06 * std::sin(t * 0.1689 + 1.0) +
           0.04 * std::sin(t * 0.4763);
}

}  // namespace game
