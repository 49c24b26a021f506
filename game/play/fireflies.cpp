#include "fireflies.h"

#include <algorithm>
#include <cmath>

#include "../vectors.h"
#include "random_stream.h"

namespace game {
namespace {

constexpr double TURN_RAD = 6.28318530717958647692;
constexpr double CLEARANCE_M = 0.05;  // between where it wanders and what is solid
constexpr double HIGHEST_M = 2.4;     // above what is below
constexpr double HOP_M = 7.0;
constexpr int FEWEST_HOPS = 2, MOST_HOPS = 9;  // from the start to a firefly's place: more are near than far
constexpr int TRIES = 40;                      // for one hop
constexpr double FLAT = 0.6;                   // up and down it goes less far than to the sides
constexpr double FAINTEST = 0.04;

// Walks through the open air in straight lines.
class Walker {
  public:
    Walker(const Physics& physics, const Level& level)
        : physics_(physics), level_(level), start_(physics.to_local(level.start_eye)), place_(start_) {}

    void begin() { place_ = start_; }
    // Goes to another place, where a firefly has room and is not too high; false where it finds none.
    bool hop() {
        for (int i = 0; i < TRIES; ++i) {
            const double yaw = random_.next(0.0, TURN_RAD), rise_m = random_.next(-1.5, 1.5);
            const double way_m = HOP_M * std::sqrt(random_.next(0.02, 1.0));
            const btVector3 way{btScalar(std::cos(yaw) * way_m), btScalar(rise_m),
                                btScalar(std::sin(yaw) * way_m)};
            const btVector3 to = place_ + way * sweep(way);
            if (!is_good(to)) continue;
            place_ = to;
            return true;
        }
        return false;
    }
    Vec3 place() const { return physics_.to_world(place_); }

  private:
    // How much of a way is free.
    btScalar sweep(const btVector3& way) const {
        return physics_.sweep(btSphereShape(btScalar(Fireflies::WANDER_M + CLEARANCE_M)), place_,
                              place_ + way, GROUP_LEVEL);
    }
    bool is_good(const btVector3& to) const {
        constexpr double LEAST_HOP_M = 0.5;
        if (to.distance(place_) < btScalar(LEAST_HOP_M) || !is_in_bounds(physics_.to_world(to))) return false;
        const btVector3 below{to.x(), to.y() - btScalar(HIGHEST_M), to.z()};
        return physics_.is_surface_between(to, below);
    }
    bool is_in_bounds(const Vec3& p) const {
        constexpr double REACH_M = Fireflies::WANDER_M, NEAR_M = 20.0;
        const bool is_empty = level_.triangles.empty();
        const Vec3 near{NEAR_M, NEAR_M, NEAR_M};
        const Box box = is_empty ? Box{level_.start_eye - near, level_.start_eye + near} : level_.bounds;
        // Up is where the air is: its height above the floor is limited elsewhere.
        return p.x > box.lower.x + REACH_M && p.x < box.upper.x - REACH_M && p.y > box.lower.y + REACH_M &&
               p.z > box.lower.z + REACH_M && p.z < box.upper.z - REACH_M;
    }

    const Physics& physics_;
    const Level& level_;
    btVector3 start_;
    btVector3 place_;
    RandomStream random_{1};
};

}  // namespace

Fireflies::Fireflies(const Physics& physics, const Level& level, int count) {
    Walker walker(physics, level);
    for (int i = 0; i < std::min(count, FIREFLY_LIMIT); ++i) {
        walker.begin();
        const int hops = FEWEST_HOPS + i % (MOST_HOPS - FEWEST_HOPS + 1);
        for (int hop = 0; hop < hops; ++hop) {
            if (!walker.hop()) return;
        }
        fireflies_.push_back(make(walker.place(), std::uint64_t(i)));
    }
}

Fireflies::Firefly Fireflies::make(const Vec3& place, std::uint64_t index) {
    RandomStream random(index << 32);
    const auto swing = [&](double shortest_s, double longest_s) {
        return Swing{TURN_RAD * STEP_S / random.next(shortest_s, longest_s), random.next(0.0, TURN_RAD)};
    };
    Firefly firefly;
    firefly.place = place;
    for (std::array<Swing, 2>& axis : firefly.ways) axis = {swing(9.0, 20.0), swing(3.0, 7.0)};
    firefly.blink = swing(2.5, 6.0);
    return firefly;
}

void Fireflies::describe(std::uint64_t step, std::vector<FireflyState>& fireflies) const {
    // So that the corner of the box that it swings in is as far away as it may be.
    const double reach_m = WANDER_M / std::sqrt(2.0 + FLAT * FLAT);
    const auto turn = [&](const Swing& swing) {
        return std::sin(swing.rad_per_step * double(step) + swing.phase_rad);
    };
    const auto sway = [&](const std::array<Swing, 2>& axis) {
        return reach_m * (0.65 * turn(axis[0]) + 0.35 * turn(axis[1]));
    };
    fireflies.resize(fireflies_.size());
    for (std::size_t i = 0; i < fireflies.size(); ++i) {
        const Firefly& firefly = fireflies_[i];
        fireflies[i].position =
            firefly.place + Vec3{sway(firefly.ways[0]), FLAT * sway(firefly.ways[1]), sway(firefly.ways[2])};
        // Short and soft; never quite dark, since what begins to shine costs more than what shines more.
        const double wave = 0.5 + 0.5 * turn(firefly.blink);
        fireflies[i].brightness = FAINTEST + (1.0 - FAINTEST) * wave * wave * wave;
    }
}

}  // namespace game
