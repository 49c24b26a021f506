#include "lantern_rules.h"

#include <algorithm>
#include <cmath>

#include "../vectors.h"

namespace game {
namespace {

constexpr double AIM_COSINE = 0.9;  // within 26 degrees of the middle of the view
constexpr double BRIGHTNESS_STEP = 1.25;
constexpr double DIMMEST = 0.1, BRIGHTEST = 4.0;

int turn(int value, int by, int count) {
    return ((value + by) % count + count) % count;
}

}  // namespace

void LanternRules::restart(PlayState& state) const {
    state.lanterns.assign(lanterns_.size(), {});
    for (std::size_t i = 0; i < lanterns_.size(); ++i) state.lanterns[i].is_lit = !lanterns_[i].is_dead;
    state.finished_step = 0;
    count(state);
}

void LanternRules::count(PlayState& state) const {
    state.dead_count = 0;
    state.relit_count = 0;
    for (std::size_t i = 0; i < lanterns_.size(); ++i) {
        if (!lanterns_[i].is_dead) continue;
        ++state.dead_count;
        state.relit_count += state.lanterns[i].is_lit ? 1 : 0;
    }
    const bool is_done = state.dead_count > 0 && state.relit_count == state.dead_count;
    if (is_done && state.finished_step == 0) state.finished_step = state.step;
}

// The one nearest to the middle of the view.
int LanternRules::find_aimed(const Vec3& eye, const Vec3& ahead) const {
    int best = -1;
    double best_cosine = AIM_COSINE;
    for (std::size_t i = 0; i < lanterns_.size(); ++i) {
        const Vec3 way = lanterns_[i].position - eye;
        const double distance = length(way);
        if (distance > REACH_M || distance == 0.0) continue;
        const double cosine = dot(way, ahead) / distance;
        if (cosine <= best_cosine) continue;
        best = int(i);
        best_cosine = cosine;
    }
    return best;
}

void LanternRules::step(const StepInput& input, const Vec3& ahead, PlayState& state) const {
    state.aimed_lantern = find_aimed(state.player.eye(), ahead);
    if (state.aimed_lantern < 0) {
        state.next_color = turn(state.next_color, input.wheel, PLAY_COLORS);
        return;
    }
    LanternState& lantern = state.lanterns[std::size_t(state.aimed_lantern)];
    if (input.use) lantern.is_lit = !lantern.is_lit;
    if (input.wheel != 0 && input.run) {
        const double brighter = lantern.brightness * std::pow(BRIGHTNESS_STEP, input.wheel);
        lantern.brightness = std::clamp(brighter, DIMMEST, BRIGHTEST);
    } else if (input.wheel != 0) {
        // One more than the colours: -1 is the scene's own.
        lantern.color = turn(lantern.color + 1, input.wheel, PLAY_COLORS + 1) - 1;
    }
    if (input.use) count(state);
}

}  // namespace game
