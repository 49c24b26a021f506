// The viewer's panel: every setting, and what the last frames cost, counted and decided.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frame/timings.h"
#include "passes/display.h"
#include "plan/frame_plan.h"
#include "settings/settings.h"

namespace tarn {

// What the panel changes.
struct ViewerState {
    RenderSettings settings;
    DisplayView view = DisplayView::RADIANCE;
    bool auto_exposure = true;
    float exposure_ev = 0.0f;  // automatic: follows the picture
    std::uint32_t seed = 0;
    int resolution_percent = 100;  // of the window's width and height
    bool playing = false;
    double time_s = 0.0;
    float animation_speed = 1.0f;
    float fly_speed_m_s = 1.0f;
    bool panel_visible = true;
    std::string screenshot_file;  // empty: a new name under out/
};

// What the panel shows.
struct ViewerFacts {
    std::string scene_name;
    std::vector<std::pair<std::string, std::string>> scene_facts;  // "triangles", "74512"
    std::vector<std::string> camera_names;
    std::optional<std::size_t> followed_camera;  // none: flying freely
    glm::dvec3 camera_position_ws{0.0};
    double animation_duration_s = 0.0;  // 0: nothing moves
    int width_px = 0;
    int height_px = 0;
    double frames_per_s = 0.0;
    FrameTimings timings;
    std::uint64_t shadow_rays = 0;  // of the last frame
    double rays_per_s = 0.0;        // of all kinds, while they are traced
    std::uint64_t triangles_drawn = 0;
    std::uint64_t triangles_total = 0;
    std::map<std::string, std::uint64_t> counters;
    const FramePlan* plan = nullptr;
    std::string message;  // the last screenshot or error
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

}  // namespace tarn
