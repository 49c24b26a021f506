// The viewer's panel: every setting, and what the last frames cost, counted and decided.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "recent_timings.h"
#include "tarn_names.h"

namespace game {

// What the panel changes.
struct ViewerState {
    Settings settings;
    std::string preset = "clean";  // that was last chosen: settings may have changed since
    std::string view;              // a name out of ViewerFacts::views
    std::string tone = "neutral";  // out of ViewerFacts::tone_curves
    float glare_strength = 1.0f;
    bool auto_exposure = true;
    float exposure_ev = 0.0f;  // automatic: follows the picture
    bool converge = true;      // at rest, to the mean of many frames
    std::uint32_t seed = 0;
    bool playing = false;
    double time_s = 0.0;
    float animation_speed = 1.0f;
    float fly_speed_m_s = 1.0f;
    bool panel_visible = true;
    std::string screenshot_file;  // empty: a new name under out/
};

// What the panel shows.
struct ViewerFacts {
    std::vector<SettingInfo> settings = Settings::list();
    std::vector<PresetInfo> presets = Settings::list_presets();
    std::vector<DisplayViewInfo> views = Display::list_views();
    std::vector<std::string> tone_curves = Display::list_tone_curves();
    std::string scene_name;
    std::vector<std::pair<std::string, std::string>> scene_facts;  // "triangles", "74512"
    std::vector<std::string> camera_names;
    std::optional<std::size_t> followed_camera;  // none: flying freely
    Vec3 camera_position_ws;
    double animation_duration_s = 0.0;  // 0: nothing moves
    int width_px = 0;
    int height_px = 0;
    double frames_per_s = 0.0;
    FrameReport report;       // of the last frame
    FrameCost cost;           // medians of the last frames
    double rays_per_s = 0.0;  // of all kinds, while they are traced
    std::string message;      // the last screenshot or error
    bool message_is_error = false;
};

// What the panel asks for.
struct PanelActions {
    std::optional<std::size_t> camera;  // go there
    bool screenshot = false;
    bool reload_shaders = false;
};

// Describes the panel and the message to Dear ImGui; call between Overlay::begin() and end().
PanelActions draw_panel(ViewerState& state, const ViewerFacts& facts);

}  // namespace game
