#include "crate_places.h"

#include <cmath>

#include "../vectors.h"

namespace game {
namespace {

struct Spot {
    double right_m;
    double ahead_m;
    double yaw_rad;
};

// Each is dropped: where one stands already, the next comes to stand on it.
constexpr double ABOVE_COURT_M = 2.4;
constexpr Spot COURT[] = {
    // A wall to jump onto, between the start and the fountain.
    {5.6, -6.6, 0.1},
    {6.3, -6.5, -0.05},
    {5.95, -6.55, 0.3},
    // A tower to throw at.
    {2.6, -6.4, 0.5},
    {2.6, -6.4, 0.6},
    {2.6, -6.4, 0.4},
    // Beside the way to the stair.
    {-9.6, -3.2, 0.2},
    {-9.6, -2.5, 0.0},
    {-9.6, -2.85, -0.3},
    // In the north-east, near the dead lanterns of the stalls.
    {3.9, 5.0, 0.8},
    {4.7, 5.3, 0.7},
    {10.8, 1.6, 0.0},
};

constexpr double ABOVE_EYE_M = 0.5;
constexpr Spot NEAR_START[] = {{1.0, 2.6, 0.1}, {1.65, 2.6, -0.05}, {1.3, 2.6, 0.2}, {-1.5, 3.2, 0.5}};

}  // namespace

std::vector<CratePlace> find_crate_places(const std::string& scene_name, const Level& level) {
    std::vector<CratePlace> places;
    if (scene_name == "lantern_court") {
        for (const Spot& spot : COURT)
            places.push_back({{spot.right_m, ABOVE_COURT_M, -spot.ahead_m}, spot.yaw_rad});
        return places;
    }
    const double yaw = level.start_yaw_rad;
    const Vec3 right{std::cos(yaw), 0.0, -std::sin(yaw)}, ahead{-std::sin(yaw), 0.0, -std::cos(yaw)};
    for (const Spot& spot : NEAR_START) {
        const Vec3 above = level.start_eye + right * spot.right_m + ahead * spot.ahead_m;
        places.push_back({above + Vec3{0.0, ABOVE_EYE_M, 0.0}, yaw + spot.yaw_rad});
    }
    return places;
}

}  // namespace game
