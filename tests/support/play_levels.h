// Small levels for tests of the sandbox, and inputs for them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

#include "game/play/simulation.h"

namespace tarn::test {

// Lies around the origin. Play starts there, looking along -Z.
class LevelBuilder {
  public:
    LevelBuilder() {
        level_.bounds = {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
        level_.start_eye = {0.0, 1.62, 0.0};
    }

    LevelBuilder& quad(const game::Vec3& a, const game::Vec3& b, const game::Vec3& c, const game::Vec3& d) {
        for (const auto& [p, q, r] : {std::array{a, b, c}, std::array{a, c, d}}) {
            level_.triangles.push_back({float(p.x), float(p.y), float(p.z), float(q.x), float(q.y),
                                        float(q.z), float(r.x), float(r.y), float(r.z)});
        }
        for (const game::Vec3& p : {a, b, c, d}) grow(p);
        return *this;
    }
    LevelBuilder& floor(double half_m, double y = 0.0) {
        return quad({-half_m, y, half_m}, {half_m, y, half_m}, {half_m, y, -half_m}, {-half_m, y, -half_m});
    }
    // A wall without thickness across the way ahead, from x = -20 to 20.
    LevelBuilder& wall_ahead(double z, double low = 0.0, double high = 4.0) {
        return quad({-20, low, z}, {20, low, z}, {20, high, z}, {-20, high, z});
    }
    // A step as wide as the wall, whose top reaches from z to z - depth.
    LevelBuilder& step_ahead(double z, double low, double high, double depth) {
        wall_ahead(z, low, high);
        return quad({-20, high, z}, {20, high, z}, {20, high, z - depth}, {-20, high, z - depth});
    }
    // Four walls and a ceiling around the floor.
    LevelBuilder& room(double half_m, double height_m) {
        const double h = half_m;
        floor(h).floor(h, height_m);
        const game::Vec3 a{-h, 0, -h}, b{h, 0, -h}, c{h, 0, h}, d{-h, 0, h};
        const auto raise = [&](const game::Vec3& p) { return game::Vec3{p.x, height_m, p.z}; };
        quad(a, b, raise(b), raise(a)).quad(b, c, raise(c), raise(b));
        return quad(c, d, raise(d), raise(c)).quad(d, a, raise(a), raise(d));
    }
    LevelBuilder& start_at(const game::Vec3& eye, double yaw_rad = 0.0, double pitch_rad = 0.0) {
        level_.start_eye = eye;
        level_.start_yaw_rad = yaw_rad;
        level_.start_pitch_rad = pitch_rad;
        return *this;
    }
    LevelBuilder& lantern(const game::Vec3& position, bool is_dead) {
        level_.lanterns.push_back({{}, position, is_dead});
        return *this;
    }
    LevelBuilder& crate(const game::Vec3& above, double yaw_rad = 0.0) {
        level_.crates.push_back({above, yaw_rad});
        return *this;
    }
    const game::Level& level() const { return level_; }

  private:
    void grow(const game::Vec3& p) {
        game::Vec3 &lower = level_.bounds.lower, &upper = level_.bounds.upper;
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }

    game::Level level_;
};

inline game::StepInput go_ahead(bool run = false) {
    game::StepInput input;
    input.forward = game::FULL_SPEED;
    input.run = run;
    return input;
}

inline void run_steps(game::Simulation& simulation, int steps, const game::StepInput& input = {}) {
    for (int i = 0; i < steps; ++i) simulation.step(input);
}

// Somebody who presses keys without a plan: each for a while.
class RandomPlayer {
  public:
    explicit RandomPlayer(std::uint32_t seed) : random_(seed) {}

    game::StepInput next() {
        if (left_-- <= 0) {
            left_ = int(random_() % 60);
            input_ = {};
            input_.right = game::FULL_SPEED * (int(random_() % 3) - 1);
            input_.forward = game::FULL_SPEED * (int(random_() % 3) - 1);
            input_.run = random_() % 2 == 0;
            input_.crouch = random_() % 6 == 0;
            input_.look_right = int(random_() % 41) - 20;
            input_.look_down = int(random_() % 11) - 5;
        }
        input_.jump = random_() % 40 == 0;
        input_.throw_ball = random_() % 30 == 0;
        input_.use = random_() % 20 == 0;
        input_.torch = random_() % 200 == 0;
        input_.wheel = random_() % 50 == 0 ? int(random_() % 3) - 1 : 0;
        return input_;
    }

  private:
    std::mt19937 random_;
    game::StepInput input_;
    int left_ = 0;
};

}  // namespace tarn::test
