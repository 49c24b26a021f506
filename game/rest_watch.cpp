#include "rest_watch.h"

#include <algorithm>
#include <vector>

namespace game {
namespace {

bool are_same(const Settings& a, const Settings& b) {
    static const std::vector<SettingInfo> ROWS = Settings::list();
    return std::all_of(ROWS.begin(), ROWS.end(),
                       [&](const SettingInfo& row) { return a.number(row.name) == b.number(row.name); });
}

bool are_same(const FlyCamera& a, const FlyCamera& b) {
    return a.position_ws.x == b.position_ws.x && a.position_ws.y == b.position_ws.y &&
           a.position_ws.z == b.position_ws.z && a.yaw_rad == b.yaw_rad && a.pitch_rad == b.pitch_rad &&
           a.roll_rad == b.roll_rad && a.orthographic == b.orthographic && a.half_height == b.half_height;
}

}  // namespace

bool RestWatch::is_at_rest(const ShownState& state) {
    const bool rests = are_same(state.camera, last_.camera) && state.seed == last_.seed &&
                       state.time_s == last_.time_s && state.size == last_.size &&
                       are_same(state.settings, last_.settings);
    frames_ = rests ? frames_ + 1 : 0;
    last_ = state;
    return frames_ >= REST_FRAMES;
}

}  // namespace game
