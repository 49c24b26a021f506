#include "stage.h"

#include <utility>

#include "../fly_camera.h"

namespace game {

namespace {

Level make_level_with(const Scene& scene, std::optional<int> fireflies) {
    Level level = make_level(scene);
    if (fireflies) level.fireflies = *fireflies;
    return level;
}

}  // namespace

Stage::Stage(Scene scene, std::optional<int> fireflies)
    : scene_(std::move(scene)),
      level_(make_level_with(scene_, fireflies)),
      level_hash_(compute_hash(level_)),
      simulation_(level_),
      actors_(scene_, level_, simulation_.state()),
      is_animated_(scene_.duration_s() > 0.0) {
    show();
}

void Stage::show() {
    const PlayState& state = simulation_.state();
    if (is_animated_) scene_.move_to(double(state.step) * STEP_S);
    actors_.show(state, lit_fireflies_);
}

Frame Stage::make_frame(const StageLook& look, std::uint32_t number, double elapsed_s) const {
    const PlayerState& player = simulation_.state().player;
    FlyCamera eye;
    eye.position_ws = player.eye();
    eye.yaw_rad = player.yaw_rad;
    eye.pitch_rad = player.pitch_rad;
    eye.half_height = level_.half_height;
    Frame frame;
    frame.camera = to_camera(eye);
    frame.number = number;
    frame.seed = look.seed;
    frame.settings = look.settings;
    frame.display.glare_strength = look.glare_strength;
    frame.display.elapsed_s = elapsed_s;
    return frame;
}

}  // namespace game
