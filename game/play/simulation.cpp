#include "simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../vectors.h"
#include "balls.h"
#include "character.h"
#include "crates.h"
#include "fireflies.h"
#include "hash.h"
#include "lantern_rules.h"
#include "physics.h"
#include "snapshot.h"
#include "torch.h"

namespace game {
namespace {

constexpr int SUBSTEPS = 4;  // a thrown ball moves by less than its radius in one
constexpr double RADIANS_PER_PX = 0.0022;
constexpr double HALF_TURN_RAD = 3.14159265358979323846;
constexpr double STEEPEST_LOOK_RAD = 89.0 / 180.0 * HALF_TURN_RAD;
constexpr double THROW_M_S = 9.0;
constexpr double HAND_AHEAD_M = 0.5;
constexpr double HAND_BELOW_EYE_M = 0.15;
constexpr double FALL_LIMIT_M = 5.0;  // below the level: who falls farther starts again, balls are gone

Vec3 look_direction(const PlayerState& player) {
    return {-std::sin(player.yaw_rad) * std::cos(player.pitch_rad), std::sin(player.pitch_rad),
            -std::cos(player.yaw_rad) * std::cos(player.pitch_rad)};
}

btVector3 to_bullet(const Vec3& direction) {
    return {btScalar(direction.x), btScalar(direction.y), btScalar(direction.z)};
}

// How far a ball's middle gets from `from` towards `to`; 1: all the way.
double sweep_ball(const Physics& physics, const btVector3& from, const btVector3& to) {
    return double(physics.sweep(btSphereShape(btScalar(BALL_RADIUS_M)), from, to, GROUP_LEVEL | GROUP_CRATE));
}

// Where the feet are when the eye has dropped to the floor. Many scenes have none below their camera: those
// get an endless one, as low as the lowest of their triangles.
btVector3 find_start(const std::shared_ptr<LevelShape>& shape, const Level& level) {
    Physics physics(shape);
    constexpr btScalar ABOVE_FLOOR_M = 0.02f;
    const btVector3 eye = physics.to_local(level.start_eye);
    const double depth_m = std::max(2.0, level.start_eye.y - level.bounds.lower.y + 1.0);
    const btVector3 below = eye - btVector3(0.0f, btScalar(std::min(depth_m, 1e4)), 0.0f);
    btCollisionWorld::ClosestRayResultCallback floor(eye, below);
    floor.m_collisionFilterGroup = GROUP_CHARACTER;
    floor.m_collisionFilterMask = GROUP_LEVEL;
    physics.world().rayTest(eye, below, floor);
    if (floor.hasHit()) return floor.m_hitPointWorld + btVector3(0.0f, ABOVE_FLOOR_M, 0.0f);
    const double lowest = level.triangles.empty() ? level.start_eye.y : level.bounds.lower.y;
    const auto ground =
        btScalar(std::min(lowest, level.start_eye.y - double(Character::HEIGHT_M)) - level.origin.y);
    physics.add_ground(ground);
    return {eye.x(), ground + ABOVE_FLOOR_M, eye.z()};
}

}  // namespace

struct Simulation::Parts {
    // All that moves, in a world of its own.
    struct Bodies {
        Bodies(std::shared_ptr<LevelShape> shape, const btVector3& feet, btScalar lowest_m)
            : physics(std::move(shape)),
              character(physics, feet),
              balls(physics, lowest_m),
              crates(physics, lowest_m) {}

        Physics physics;
        Character character;
        Balls balls;
        Crates crates;
    };

    explicit Parts(const Level& level)
        : shape(std::make_shared<LevelShape>(level)),
          lowest_m(level.triangles.empty() ? -1e6 : level.bounds.lower.y - level.origin.y - FALL_LIMIT_M),
          start_feet(find_start(shape, level)),
          lanterns(level.lanterns),
          fireflies(Physics(shape), level, level.fireflies),
          bodies(make_bodies()) {
        bodies->crates.place(level);
        state.player.yaw_rad = level.start_yaw_rad;
        state.player.pitch_rad = std::clamp(level.start_pitch_rad, -STEEPEST_LOOK_RAD, STEEPEST_LOOK_RAD);
        lanterns.restart(state);
        start = take();
        restore(start);
    }

    std::unique_ptr<Bodies> make_bodies() const {
        return std::make_unique<Bodies>(shape, start_feet, btScalar(lowest_m));
    }

    Snapshot take() const {
        Snapshot snapshot;
        snapshot.step = state.step;
        snapshot.yaw_rad = state.player.yaw_rad;
        snapshot.pitch_rad = state.player.pitch_rad;
        snapshot.aimed_lantern = state.aimed_lantern;
        snapshot.next_color = state.next_color;
        snapshot.finished_step = state.finished_step;
        snapshot.torch = state.torch.is_lit;
        snapshot.character = bodies->character.take();
        bodies->balls.take(snapshot);
        snapshot.crates = bodies->crates.take();
        snapshot.lanterns = state.lanterns;
        return snapshot;
    }

    void restore(const Snapshot& snapshot) {
        std::unique_ptr<Bodies> made = make_bodies();
        made->character.restore(snapshot.character);
        made->balls.restore(snapshot);
        made->crates.restore(bodies->crates, snapshot.crates);
        bodies = std::move(made);
        state = {};
        state.step = snapshot.step;
        state.player.yaw_rad = snapshot.yaw_rad;
        state.player.pitch_rad = snapshot.pitch_rad;
        state.aimed_lantern = snapshot.aimed_lantern;
        state.next_color = snapshot.next_color;
        state.finished_step = snapshot.finished_step;
        state.torch.is_lit = snapshot.torch;
        state.lanterns = snapshot.lanterns;
        lanterns.count(state);
        describe();
        hold_torch();
        last = {snapshot, {}};
    }

    void check(const SavedPlay& saved) const {
        const auto expect = [](std::size_t found, std::size_t expected, const char* things) {
            if (found != expected)
                throw Error(fmt::format("{} {} are saved, the level has {}", found, things, expected));
        };
        expect(saved.snapshot.lanterns.size(), start.lanterns.size(), "lanterns");
        expect(saved.snapshot.crates.size(), start.crates.size(), "crates");
        expect(saved.snapshot.balls.size(), start.balls.size(), "balls");
        if (saved.snapshot.aimed_lantern >= int(start.lanterns.size()))
            throw Error(fmt::format("lantern {} is aimed at, the level has {}", saved.snapshot.aimed_lantern,
                                    start.lanterns.size()));
    }

    void step(const StepInput& input) {
        if (input.restart) return restore(start);
        last.since.push_back(input);
        look(input);
        move(input);
        ++state.step;
        describe();
        if (input.torch) state.torch.is_lit = !state.torch.is_lit;
        hold_torch();
        lanterns.step(input, look_direction(state.player), state);
        if (input.throw_ball) {
            throw_ball();
            describe();
        }
        if (state.step % SNAPSHOT_STEPS == 0) restore(take());
    }

    void look(const StepInput& input) {
        PlayerState& player = state.player;
        player.yaw_rad =
            std::remainder(player.yaw_rad - input.look_right * RADIANS_PER_PX, 2.0 * HALF_TURN_RAD);
        player.pitch_rad = std::clamp(player.pitch_rad - input.look_down * RADIANS_PER_PX, -STEEPEST_LOOK_RAD,
                                      STEEPEST_LOOK_RAD);
    }

    WalkInput walk_input(const StepInput& input) const {
        const double yaw = state.player.yaw_rad;
        const Vec3 right = {std::cos(yaw), 0.0, -std::sin(yaw)};
        const Vec3 forward = {-std::sin(yaw), 0.0, -std::cos(yaw)};
        const auto share = [](int speed) {
            return double(std::clamp(speed, -FULL_SPEED, FULL_SPEED)) / FULL_SPEED;
        };
        const Vec3 way = right * share(input.right) + forward * share(input.forward);
        WalkInput walk;
        walk.direction = to_bullet(way * (1.0 / std::max(1.0, length(way))));
        walk.run = input.run;
        walk.crouch = input.crouch;
        walk.jump = input.jump;
        return walk;
    }

    // From the hand, which is where no wall is between it and the eye.
    void throw_ball() {
        const PlayerState& player = state.player;
        const Vec3 ahead = look_direction(player);
        const btVector3 eye = bodies->physics.to_local(player.eye());
        const btVector3 reach = to_bullet(ahead * HAND_AHEAD_M - Vec3{0.0, HAND_BELOW_EYE_M, 0.0});
        const btVector3 hand = eye + reach * btScalar(sweep_ball(bodies->physics, eye, eye + reach));
        bodies->balls.add(hand, to_bullet(ahead * THROW_M_S), state.next_color);
        state.next_color = (state.next_color + 1) % PLAY_COLORS;
    }

    // As a ball in the hand, so that its flame is on this side of walls.
    void hold_torch() {
        TorchState& torch = state.torch;
        torch.position = state.player.eye();
        torch.brightness = torch.is_lit ? compute_flicker(state.step) : 0.0;
        if (!torch.is_lit) return;
        const Vec3 reach = compute_torch_reach(state.player.yaw_rad, state.player.pitch_rad);
        const btVector3 eye = bodies->physics.to_local(torch.position);
        torch.position = torch.position + reach * sweep_ball(bodies->physics, eye, eye + to_bullet(reach));
    }

    void move(const StepInput& input) {
        WalkInput walk = walk_input(input);
        constexpr auto DT_S = btScalar(STEP_S / SUBSTEPS);
        for (int i = 0; i < SUBSTEPS; ++i) {
            bodies->character.step(walk, DT_S);
            bodies->crates.push(bodies->character, DT_S);
            bodies->physics.world().stepSimulation(DT_S, 0);
            bodies->balls.hold();
            bodies->crates.hold();
            walk.jump = false;
        }
        if (bodies->character.feet().y() < lowest_m) bodies->character.teleport(start_feet);
    }

    void describe() {
        state.player.feet = bodies->physics.to_world(bodies->character.feet());
        state.player.eye_height_m = double(bodies->character.eye_height_m());
        state.player.is_on_ground = bodies->character.is_on_ground();
        state.player.is_crouching = bodies->character.is_crouching();
        bodies->balls.describe(state.balls);
        bodies->crates.describe(state.crates);
        fireflies.describe(state.step, state.fireflies);
    }

    std::shared_ptr<LevelShape> shape;
    double lowest_m;  // relative to the level's origin
    btVector3 start_feet;
    LanternRules lanterns;
    Fireflies fireflies;
    std::unique_ptr<Bodies> bodies;
    PlayState state;
    Snapshot start;
    SavedPlay last;  // snapshot, and what was done since
};

Simulation::Simulation(const Level& level) : parts_(std::make_unique<Parts>(level)) {}
Simulation::~Simulation() = default;

void Simulation::step(const StepInput& input) {
    parts_->step(input);
}

SavedPlay Simulation::save() const {
    return parts_->last;
}

void Simulation::load(const SavedPlay& saved) {
    parts_->check(saved);
    // A copy: what was saved may be this simulation's own.
    const SavedPlay copy = saved;
    parts_->restore(copy.snapshot);
    for (const StepInput& input : copy.since) parts_->step(input);
}

const PlayState& Simulation::state() const {
    return parts_->state;
}

std::uint64_t compute_hash(const PlayState& state) {
    Hash hash;
    const auto add_point = [&](const Vec3& p) {
        for (const double value : {p.x, p.y, p.z}) hash.add(value);
    };
    const auto add_turn = [&](const Rotation& r) {
        for (const double value : {r.x, r.y, r.z, r.w}) hash.add(value);
    };
    hash.add(state.step);
    const PlayerState& player = state.player;
    add_point(player.feet);
    for (const double value : {player.eye_height_m, player.yaw_rad, player.pitch_rad}) hash.add(value);
    hash.add(int(player.is_on_ground) + 2 * int(player.is_crouching));
    for (const BallState& ball : state.balls) {
        hash.add(int(ball.is_alive) + 2 * ball.color);
        add_point(ball.position);
        add_point(ball.velocity);
        add_turn(ball.rotation);
    }
    for (const CrateState& crate : state.crates) {
        add_point(crate.position);
        add_point(crate.velocity);
        add_turn(crate.rotation);
    }
    add_point(state.torch.position);
    hash.add(state.torch.brightness);
    hash.add(int(state.torch.is_lit));
    for (const LanternState& lantern : state.lanterns) {
        hash.add(int(lantern.is_lit) + 2 * lantern.color);
        hash.add(lantern.brightness);
    }
    for (const FireflyState& firefly : state.fireflies) {
        add_point(firefly.position);
        hash.add(firefly.brightness);
    }
    for (const int value : {state.aimed_lantern, state.next_color, state.dead_count, state.relit_count})
        hash.add(value);
    hash.add(state.finished_step);
    return hash.value();
}

}  // namespace game
