#include "actors.h"

#include "palette.h"

namespace game {
namespace {

constexpr int BALL_SUBDIVISIONS = 1;  // 80 triangles, each of which is a light
constexpr double PARKED_BELOW_M = 0.6;
constexpr double PARKED_APART_M = 0.3;

template <class State>
bool is_same_place(const State& a, const State& b) {
    return a.position.x == b.position.x && a.position.y == b.position.y && a.position.z == b.position.z &&
           a.rotation.x == b.rotation.x && a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z &&
           a.rotation.w == b.rotation.w;
}

Surface ball_surface(const BallState& ball) {
    const Vec3& radiance = PALETTE[std::size_t(ball.color)];
    Surface surface;
    surface.base_color = {0.4, 0.4, 0.4};
    surface.roughness = 0.6;
    if (ball.is_alive) surface.emission = radiance;
    return surface;
}

// Oiled wood; no two of the same tree.
Surface crate_surface(std::size_t index) {
    const double shade = 0.8 + 0.1 * double(index % 5);
    Surface surface;
    surface.base_color = Vec3{0.34, 0.19, 0.085} * shade;
    surface.roughness = 0.55;
    return surface;
}

Transform place_at(const Vec3& position) {
    Transform place;
    place.translation = position;
    return place;
}

// A flame without extent: nothing of it is in the picture, however close it is to the eye.
Light torch_light(const TorchState& torch) {
    Light light;
    light.intensity = Vec3{7.4, 3.7, 1.4} * torch.brightness;
    return light;
}

// In a row below the middle of the level.
Transform parking_place(const Level& level, int index) {
    const Box& b = level.bounds;
    const bool is_empty = b.lower.x > b.upper.x;
    Transform place;
    place.translation = is_empty ? level.start_eye - Vec3{0.0, 3.0, 0.0}
                                 : Vec3{0.5 * (b.lower.x + b.upper.x), b.lower.y - PARKED_BELOW_M,
                                        0.5 * (b.lower.z + b.upper.z)};
    place.translation.x += PARKED_APART_M * (index - 0.5 * BALL_LIMIT);
    return place;
}

Vec3 lantern_emission(const Vec3& own, const LanternState& lantern) {
    if (!lantern.is_lit) return {};
    if (lantern.color < 0) return own * lantern.brightness;
    const Vec3& chosen = PALETTE[std::size_t(lantern.color)];
    return chosen * (lantern.brightness * luminance(own) / luminance(chosen));
}

}  // namespace

Actors::Actors(Scene& scene, const Level& level, const PlayState& start)
    : scene_(scene), fireflies_(scene, start.fireflies, parking_place(level, 0).translation) {
    for (int i = 0; i < BALL_LIMIT; ++i) {
        Ball ball;
        ball.parked = parking_place(level, i);
        ball.node = scene.add_sphere(BALL_RADIUS_M, BALL_SUBDIVISIONS, ball_surface(ball.shown), ball.parked);
        ball.material = scene.materials(ball.node).at(0);
        balls_.push_back(ball);
    }
    for (const CrateState& state : start.crates) {
        const Vec3 half{CRATE_HALF_M, CRATE_HALF_M, CRATE_HALF_M};
        const Surface wood = crate_surface(crates_.size());
        crates_.push_back({scene.add_box(half, wood, {state.position, state.rotation}), state});
    }
    torch_ = scene.add_light(torch_light(start.torch), place_at(start.torch.position));
    torch_shown_ = start.torch;
    for (const Lantern& lantern : level.lanterns) {
        scene.separate_materials(lantern.node);
        LanternActor actor;
        for (const std::size_t material : scene.materials(lantern.node)) {
            const Surface surface = scene.surface(material);
            if (luminance(surface.emission) > 0.0) actor.parts.push_back({material, surface});
        }
        lanterns_.push_back(std::move(actor));
    }
}

void Actors::show_ball(Ball& ball, const BallState& state) {
    const bool moves =
        state.is_alive ? !ball.shown.is_alive || !is_same_place(state, ball.shown) : ball.shown.is_alive;
    if (moves && state.is_alive) {
        scene_.set_transform(ball.node, {state.position, state.rotation});
    } else if (moves) {
        scene_.set_transform(ball.node, ball.parked);
    }
    if (state.is_alive != ball.shown.is_alive || state.color != ball.shown.color)
        scene_.set_surface(ball.material, ball_surface(state));
    ball.shown = state;
}

void Actors::show_torch(const TorchState& state) {
    if (!state.is_lit && !torch_shown_.is_lit) return;
    scene_.set_transform(torch_, place_at(state.position));
    if (state.brightness != torch_shown_.brightness) scene_.set_light(torch_, torch_light(state));
    torch_shown_ = state;
}

void Actors::show_crate(Crate& crate, const CrateState& state) {
    if (!is_same_place(state, crate.shown))
        scene_.set_transform(crate.node, {state.position, state.rotation});
    crate.shown = state;
}

void Actors::show_lantern(LanternActor& lantern, const LanternState& state) {
    const LanternState& shown = lantern.shown;
    if (state.is_lit == shown.is_lit && state.color == shown.color && state.brightness == shown.brightness)
        return;
    for (const LanternPart& part : lantern.parts) {
        Surface surface = part.surface;
        surface.emission = lantern_emission(part.surface.emission, state);
        scene_.set_surface(part.material, surface);
    }
    lantern.shown = state;
}

void Actors::show(const PlayState& state, int lit_fireflies) {
    fireflies_.show(state.fireflies, lit_fireflies);
    show_torch(state.torch);
    for (std::size_t i = 0; i < balls_.size(); ++i) show_ball(balls_[i], state.balls[i]);
    for (std::size_t i = 0; i < crates_.size(); ++i) show_crate(crates_[i], state.crates[i]);
    for (std::size_t i = 0; i < lanterns_.size(); ++i) show_lantern(lanterns_[i], state.lanterns[i]);
}

}  // namespace game
