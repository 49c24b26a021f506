#include "governor.h"

#include <fmt/format.h>

#include <algorithm>

namespace game {
namespace {

// What a rung asks for: a setting and what it becomes, where it is dearer.
struct Cut {
    const char* setting;
    double value;           // of a choice, its place
    bool is_least = false;  // greater values are cheaper
};

// By what each costs in error and gains in time: game/README.md has the measurement.
constexpr Cut CUTS[] = {
    {"scale", 0.75}, {"scale", 0.5},  {"indirect-resolution", 2.0, true}, {"scale", 0.4}, {"candidates", 8.0},
    {"scale", 0.33}, {"scale", 0.25},
};

constexpr std::size_t SETTLING_FRAMES = 6;  // after a change: shaders may compile, and histories are new
constexpr std::size_t WINDOW_FRAMES = 9;
constexpr double TOO_LONG = 1.1;  // over the target
constexpr double FAR_TOO_LONG = 2.0;
constexpr double SPARE = 0.7;
constexpr int LEAST_PATIENCE = 32;  // frames
constexpr int MOST_PATIENCE = 1024;

// Whether there was anything to cut.
bool apply(const Cut& cut, Settings& settings) {
    const double value = settings.number(cut.setting);
    const bool is_dearer = cut.is_least ? value < cut.value : value > cut.value;
    if (!is_dearer || !settings.applies(cut.setting)) return false;
    settings.set_number(cut.setting, cut.value);
    return true;
}

double compute_median(std::deque<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

Ladder::Ladder(const Settings& chosen) : rungs_({{chosen, "as chosen"}}) {
    Settings settings = chosen;
    for (const Cut& cut : CUTS) {
        if (!apply(cut, settings)) continue;
        rungs_.push_back({settings, fmt::format("{} {}", cut.setting, settings.get(cut.setting))});
    }
}

int Governor::follow(double frame_ms, double target_ms, int rungs) {
    if (target_ms <= 0.0) {
        move(0);
        patience_ = LEAST_PATIENCE;
        return rung_;
    }
    if (rung_ >= rungs) move(rungs - 1);
    recent_ms_.push_back(frame_ms);
    ++frames_on_rung_;
    if (recent_ms_.size() < SETTLING_FRAMES + WINDOW_FRAMES) return rung_;
    if (recent_ms_.size() > SETTLING_FRAMES + WINDOW_FRAMES) recent_ms_.pop_front();

    const std::deque<double> window(recent_ms_.end() - WINDOW_FRAMES, recent_ms_.end());
    const double median = compute_median(window);
    if (median > TOO_LONG * target_ms && rung_ + 1 < rungs) {
        // Who has just climbed in vain waits longer before the next try.
        if (has_climbed_) patience_ = std::min(2 * patience_, MOST_PATIENCE);
        has_climbed_ = false;
        move(std::min(rungs - 1, rung_ + (median > FAR_TOO_LONG * target_ms ? 2 : 1)));
    } else if (median < SPARE * target_ms && rung_ > 0 && frames_on_rung_ >= patience_) {
        has_climbed_ = true;
        move(rung_ - 1);
    } else if (has_climbed_ && frames_on_rung_ >= LEAST_PATIENCE) {
        has_climbed_ = false;
        patience_ = LEAST_PATIENCE;
    }
    return rung_;
}

void Governor::move(int rung) {
    if (rung == rung_) return;
    rung_ = rung;
    frames_on_rung_ = 0;
    recent_ms_.clear();
}

}  // namespace game
