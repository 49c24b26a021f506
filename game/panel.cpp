#include "panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "setting_widgets.h"

namespace game {
namespace {

constexpr float WIDTH_EM = 25.0f;
constexpr const char* SCALE_ROW = "scale";
const ImVec4 ERROR_COLOUR(1.0f, 0.35f, 0.3f, 1.0f);
const ImVec4 QUIET_COLOUR(0.65f, 0.65f, 0.65f, 1.0f);

bool begin_section(const char* name, bool open = true) {
    return ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void show_text(const std::string& text) {
    ImGui::TextUnformatted(text.c_str());
}

void show_wrapped(const std::string& text, const ImVec4& colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::PushTextWrapPos(0.0f);
    show_text(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

// Two columns: a name and what it is.
template <class Rows, class ShowValue>
void draw_table(const char* id, const Rows& rows, const ShowValue& show_value) {
    if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp)) return;
    for (const auto& [name, value] : rows) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        show_text(name);
        ImGui::TableNextColumn();
        show_value(value);
    }
    ImGui::EndTable();
}

void draw_headline(const ViewerFacts& facts) {
    show_text(fmt::format("{}x{}  {:.1f} ms  {:.1f} frames/s", facts.width_px, facts.height_px,
                          facts.cost.frame_ms, facts.frames_per_s));
    const FrameReport& report = facts.report;
    if (report.averaged_frames > 1) {
        show_text(fmt::format("at rest: mean of {} frames, error {:.2g} %", report.averaged_frames,
                              100.0 * report.relative_error));
    } else {
        show_wrapped("single frames", QUIET_COLOUR);
    }
}

void draw_view_combo(const std::vector<DisplayViewInfo>& views, std::string& chosen) {
    const bool open = ImGui::BeginCombo("view", chosen.c_str());
    if (!open) {
        for (const DisplayViewInfo& view : views) {
            if (view.name == chosen) add_tooltip(view.sentence);
        }
        return;
    }
    for (const DisplayViewInfo& view : views) {
        if (ImGui::Selectable(view.name.c_str(), view.name == chosen)) chosen = view.name;
        add_tooltip(view.sentence);
    }
    ImGui::EndCombo();
}

// "raw": each setting at its default.
void draw_preset_combo(const std::vector<PresetInfo>& presets, ViewerState& state) {
    if (ImGui::BeginCombo("preset", state.preset.c_str())) {
        for (const PresetInfo& preset : presets) {
            if (ImGui::Selectable(preset.name.c_str(), preset.name == state.preset)) {
                state.preset = preset.name;
                state.settings = Settings::preset(preset.name);
            }
            add_tooltip(preset.sentence);
        }
        if (ImGui::Selectable("raw", state.preset == "raw")) {
            state.preset = "raw";
            state.settings = Settings();
        }
        ImGui::EndCombo();
    }
    add_tooltip("How light is computed: a named set of the settings below");
}

void draw_tone_combo(const std::vector<std::string>& curves, std::string& chosen) {
    if (ImGui::BeginCombo("tone", chosen.c_str())) {
        for (const std::string& curve : curves) {
            if (ImGui::Selectable(curve.c_str(), curve == chosen)) chosen = curve;
        }
        ImGui::EndCombo();
    }
    add_tooltip("What is brighter than white: cut off, or compressed with its hue kept");
}

// In steps: each size needs memory of its own.
void draw_scale_combo(Settings& settings) {
    constexpr std::array<double, 6> STEPS = {0.25, 0.33, 0.5, 0.67, 0.75, 1.0};
    const double scale = settings.number(SCALE_ROW);
    if (ImGui::BeginCombo("scale", fmt::format("{:.0f} %", 100.0 * scale).c_str())) {
        for (const double step : STEPS) {
            if (ImGui::Selectable(fmt::format("{:.0f} %", 100.0 * step).c_str(), step == scale))
                settings.set_number(SCALE_ROW, step);
        }
        ImGui::EndCombo();
    }
    add_tooltip("Width and height of what is rendered, relative to the window");
}

void draw_picture_section(ViewerState& state, const ViewerFacts& facts) {
    if (!begin_section("Picture")) return;
    draw_preset_combo(facts.presets, state);
    draw_view_combo(facts.views, state.view);
    ImGui::Checkbox("auto", &state.auto_exposure);
    add_tooltip(
        "The middle of the picture becomes middle grey, unless too much would be brighter than white");
    ImGui::SameLine();
    if (ImGui::SliderFloat("exposure", &state.exposure_ev, -20.0f, 20.0f, "%.2f EV"))
        state.auto_exposure = false;
    add_tooltip("Stops: radiance is multiplied by 2^EV before tone mapping");
    draw_scale_combo(state.settings);
    ImGui::Checkbox("converge at rest", &state.converge);
    add_tooltip("While camera and scene rest, the mean of fresh, unbiased frames replaces the picture");
    ImGui::InputScalar("seed", ImGuiDataType_U32, &state.seed);
    add_tooltip("Seed of all random numbers");
}

void draw_display_section(ViewerState& state, const ViewerFacts& facts) {
    if (!begin_section("Display", false)) return;
    draw_tone_combo(facts.tone_curves, state.tone);
    ImGui::SliderFloat("glare", &state.glare_strength, 0.0f, 8.0f, "%.2f x", ImGuiSliderFlags_AlwaysClamp);
    add_tooltip("Light that scatters around what is brighter than white; 1: as much as in an eye");
}

void draw_keys_section() {
    if (!begin_section("Keys")) return;
    show_wrapped(
        "W A S D Q E fly, Shift is faster, the wheel changes the speed; drag with the right button to look. "
        "Tab: panel. Space: animation. F5: reload shaders. F12: screenshot. Escape: end.",
        QUIET_COLOUR);
}

void draw_camera_section(ViewerState& state, const ViewerFacts& facts, PanelActions& actions) {
    if (!begin_section("Camera")) return;
    const std::string current = facts.followed_camera ? facts.camera_names[*facts.followed_camera] : "flying";
    if (ImGui::BeginCombo("camera", current.c_str())) {
        for (std::size_t i = 0; i < facts.camera_names.size(); ++i) {
            ImGui::PushID(int(i));
            if (ImGui::Selectable(facts.camera_names[i].c_str(), facts.followed_camera == i))
                actions.camera = i;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    add_tooltip("Go to a camera of the scene, and with it where it is animated");
    const Vec3& p = facts.camera_position_ws;
    show_text(fmt::format("at {:.3f}, {:.3f}, {:.3f} m", p.x, p.y, p.z));
    ImGui::SliderFloat("speed", &state.fly_speed_m_s, 1e-3f, 1e3f, "%.3g m/s", ImGuiSliderFlags_Logarithmic);
    add_tooltip(
        "W A S D Q E fly, Shift is faster, the wheel changes the speed; drag with the right button to look");
}

void draw_animation_section(ViewerState& state, const ViewerFacts& facts) {
    if (facts.animation_duration_s <= 0.0 || !begin_section("Animation")) return;
    if (ImGui::Button(state.playing ? "Pause" : "Play")) state.playing = !state.playing;
    add_tooltip("Space");
    ImGui::SameLine();
    const double start_s = 0.0;
    ImGui::SliderScalar("time", ImGuiDataType_Double, &state.time_s, &start_s, &facts.animation_duration_s,
                        "%.2f s");
    ImGui::SliderFloat("rate", &state.animation_speed, 0.0f, 4.0f, "%.2f x");
    add_tooltip("How fast the animation runs, relative to real time");
}

// One row a pass: name, a bar relative to the frame, milliseconds.
void draw_pass_rows(const FrameCost& cost) {
    if (!ImGui::BeginTable("passes", 2)) return;
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthStretch);
    const float height = ImGui::GetFontSize();
    for (const PassTime& pass : cost.passes) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        show_text(pass.name);
        ImGui::TableNextColumn();
        const double share = cost.frame_ms > 0.0 ? pass.ms / cost.frame_ms : 0.0;
        ImGui::ProgressBar(float(std::clamp(share, 0.0, 1.0)), ImVec2(-1.0f, height),
                           fmt::format("{:.2f} ms", pass.ms).c_str());
    }
    ImGui::EndTable();
}

void draw_cost_section(const ViewerFacts& facts) {
    if (!begin_section("Cost (median of the last frames)", false)) return;
    const FrameReport& report = facts.report;
    draw_pass_rows(facts.cost);
    show_text(fmt::format("{} shadow rays, {:.2f} M rays/s", report.shadow_rays, facts.rays_per_s * 1e-6));
    if (report.camera_rays > 0) {
        show_text(fmt::format("{} camera rays, {} triangles", report.camera_rays, report.triangles_total));
    } else {
        show_text(fmt::format("{} of {} triangles drawn", report.triangles_drawn, report.triangles_total));
    }
}

void draw_counter_section(const ViewerFacts& facts) {
    if (!begin_section("Counters", false)) return;
    draw_table("counters", facts.report.counters, [](std::uint64_t count) {
        if (count == 0) {
            show_text("0");
        } else {
            ImGui::TextColored(ERROR_COLOUR, "%llu", static_cast<unsigned long long>(count));
        }
    });
}

void draw_plan_section(const ViewerFacts& facts) {
    if (!begin_section("Plan", false)) return;
    for (const PlanReason& entry : facts.report.plan) {
        show_text(entry.name);
        ImGui::Indent();
        show_wrapped(entry.reason, QUIET_COLOUR);
        ImGui::Unindent();
    }
}

void draw_scene_section(const ViewerFacts& facts) {
    if (!begin_section("Scene", false)) return;
    draw_table("scene", facts.scene_facts,
               [](const std::string& value) { show_wrapped(value, QUIET_COLOUR); });
}

void draw_tools_section(ViewerState& state, PanelActions& actions) {
    if (!begin_section("Tools")) return;
    actions.screenshot = ImGui::Button("Screenshot");
    add_tooltip("F12: writes the picture, without the panel, as PNG");
    ImGui::SameLine();
    actions.reload_shaders = ImGui::Button("Reload shaders");
    add_tooltip("F5: recompiles the shaders that changed; one that fails keeps its old version");
    ImGui::InputTextWithHint("file", "a new name under out/", &state.screenshot_file);
}

// In the lower right corner, so that it moves no widget.
void draw_message(const ViewerFacts& facts) {
    if (facts.message.empty()) return;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float margin = 0.5f * ImGui::GetFontSize();
    const float widest = std::min(60.0f * ImGui::GetFontSize(), window.x - 2.0f * margin);
    ImGui::SetNextWindowPos(ImVec2(window.x - margin, window.y - margin), ImGuiCond_Always,
                            ImVec2(1.0f, 1.0f));
    ImGui::Begin("message", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos(widest);
    ImGui::PushStyleColor(ImGuiCol_Text, facts.message_is_error ? ERROR_COLOUR : QUIET_COLOUR);
    show_text(facts.message);
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::End();
}

}  // namespace

PanelActions draw_panel(ViewerState& state, const ViewerFacts& facts) {
    PanelActions actions;
    draw_message(facts);
    if (!state.panel_visible) return actions;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float margin = 0.5f * ImGui::GetFontSize();
    const float width = std::min(WIDTH_EM * ImGui::GetFontSize(), window.x - 2.0f * margin);
    ImGui::SetNextWindowPos(ImVec2(margin, margin));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0.0f),
                                        ImVec2(width, std::max(1.0f, window.y - 2.0f * margin)));
    ImGui::Begin((facts.scene_name + "###panel").c_str(), nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(-9.0f * ImGui::GetFontSize());
    draw_headline(facts);
    // What is seen comes first: its place does not depend on which settings apply.
    draw_picture_section(state, facts);
    if (begin_section("Settings", false)) draw_settings(facts.settings, SCALE_ROW, state.settings);
    draw_display_section(state, facts);
    draw_keys_section();
    draw_camera_section(state, facts, actions);
    draw_animation_section(state, facts);
    draw_cost_section(facts);
    draw_counter_section(facts);
    draw_plan_section(facts);
    draw_scene_section(facts);
    draw_tools_section(state, actions);
    ImGui::PopItemWidth();
    ImGui::End();
    return actions;
}

}  // namespace game
