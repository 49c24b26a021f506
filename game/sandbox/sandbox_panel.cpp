#include "sandbox_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "../setting_widgets.h"
#include "palette.h"

namespace game {
namespace {

constexpr ImGuiWindowFlags PLAIN = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
constexpr const char* SCALE_ROW = "scale";

void write(const std::string& text) {
    ImGui::TextUnformatted(text.c_str());
}

// A window without frame whose point `pivot` (0 to 1) stands at a share of the screen.
void draw_note(const char* id, const ImVec2& share, const std::string& text) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(share.x * size.x, share.y * size.y), ImGuiCond_Always, share);
    ImGui::SetNextWindowBgAlpha(0.55f);
    if (ImGui::Begin(id, nullptr, PLAIN)) {
        ImGui::PushTextWrapPos(0.95f * size.x);
        write(text);
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void draw_cross(const PlayState& state) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const ImVec2 middle(0.5f * size.x, 0.5f * size.y);
    const Vec3& c = PALETTE[std::size_t(state.next_color)];
    const double largest = std::max({c.x, c.y, c.z});
    const auto channel = [&](double value) { return int(80.0 + 175.0 * value / largest); };
    const ImU32 color = IM_COL32(channel(c.x), channel(c.y), channel(c.z), 220);
    const bool is_aimed = state.aimed_lantern >= 0;
    ImGui::GetBackgroundDrawList()->AddCircle(middle, is_aimed ? 9.0f : 4.0f, color, 16, 2.0f);
}

std::string describe_task(const PlayState& state) {
    if (state.finished_step > 0) {
        return fmt::format("The court is lit: {} lanterns in {:.0f} s. R starts again.", state.dead_count,
                           double(state.finished_step) * STEP_S);
    }
    std::string text = fmt::format("dead lanterns lit: {} of {}", state.relit_count, state.dead_count);
    if (state.aimed_lantern < 0) return text;
    const bool is_lit = state.lanterns[std::size_t(state.aimed_lantern)].is_lit;
    return text + (is_lit ? "   E: put it out" : "   E: light it");
}

void draw_preset_combo(SandboxSettings& settings) {
    static const std::vector<PresetInfo> PRESETS = Settings::list_presets();
    if (!ImGui::BeginCombo("preset", settings.preset.c_str())) return;
    for (const PresetInfo& preset : PRESETS) {
        if (ImGui::Selectable(preset.name.c_str(), preset.name == settings.preset)) {
            const double scale = settings.settings.number(SCALE_ROW);
            settings.preset = preset.name;
            settings.settings = Settings::preset(preset.name);
            settings.settings.set_number(SCALE_ROW, scale);
        }
        add_tooltip(preset.sentence);
    }
    ImGui::EndCombo();
}

// In steps: each size needs memory of its own.
void draw_scale_combo(Settings& settings) {
    const double scale = settings.number(SCALE_ROW);
    if (!ImGui::BeginCombo("scale", fmt::format("{:.0f} %", 100.0 * scale).c_str())) return;
    for (const double step : {0.25, 0.33, 0.5, 0.67, 0.75, 1.0}) {
        if (ImGui::Selectable(fmt::format("{:.0f} %", 100.0 * step).c_str(), step == scale))
            settings.set_number(SCALE_ROW, step);
    }
    ImGui::EndCombo();
}

void draw_governor(float& frame_ms, const SandboxFacts& facts) {
    ImGui::SliderFloat("hold", &frame_ms, 0.0f, 200.0f, frame_ms > 0.0f ? "%.0f ms a frame" : "off",
                       ImGuiSliderFlags_AlwaysClamp);
    add_tooltip("renders less where frames take longer, and more again where there is time to spare");
    if (frame_ms > 0.0f)
        write(fmt::format("step {} of {}: {}", facts.rung, facts.rungs - 1, facts.rung_sentence));
}

void draw_fireflies(int& lit, int count) {
    if (count == 0) return;
    ImGui::SliderInt("fireflies", &lit, 0, count, fmt::format("%d of {}", count).c_str(),
                     ImGuiSliderFlags_AlwaysClamp);
    add_tooltip("how many of them shine");
}

void draw_costs(const SandboxFacts& facts) {
    write(fmt::format("{}x{}  {:.1f} ms a frame, {:.1f} frames/s", facts.width_px, facts.height_px,
                      facts.cost.frame_ms, facts.frames_per_s));
    write(fmt::format("simulation {:.2f} ms a frame", facts.step_ms));
    write(fmt::format("rays: {} shadow, {} closest", facts.report.shadow_rays, facts.report.closest_rays));
    if (!ImGui::BeginTable("passes", 2)) return;
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthStretch);
    for (const PassTime& pass : facts.cost.passes) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        write(pass.name);
        ImGui::TableNextColumn();
        write(fmt::format("{:.2f} ms", pass.ms));
    }
    ImGui::EndTable();
}

// At most half of the window's width.
void draw_panel_window(SandboxSettings& settings, const SandboxFacts& facts, const PlayState& state) {
    static const std::vector<SettingInfo> ROWS = Settings::list();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float width = std::min(22.0f * ImGui::GetFontSize(), 0.5f * size.x);
    ImGui::SetNextWindowPos(ImVec2(size.x - width - 6.0f, 6.0f));
    ImGui::SetNextWindowSize(ImVec2(width, size.y - 12.0f));
    if (ImGui::Begin("Engine", nullptr,
                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoSavedSettings)) {
        draw_preset_combo(settings);
        draw_scale_combo(settings.settings);
        draw_governor(settings.frame_ms, facts);
        ImGui::SliderFloat("glare", &settings.glare_strength, 0.0f, 8.0f, "%.2f x",
                           ImGuiSliderFlags_AlwaysClamp);
        draw_fireflies(settings.fireflies, int(state.fireflies.size()));
        if (ImGui::CollapsingHeader("Cost", ImGuiTreeNodeFlags_DefaultOpen)) draw_costs(facts);
        if (ImGui::CollapsingHeader("Settings")) draw_settings(ROWS, SCALE_ROW, settings.settings);
    }
    ImGui::End();
}

}  // namespace

void draw_sandbox_panel(SandboxSettings& settings, const SandboxFacts& facts, const PlayState& state) {
    draw_cross(state);
    if (state.dead_count > 0) draw_note("task", ImVec2(0.5f, 0.0f), describe_task(state));
    if (!facts.message.empty()) draw_note("message", ImVec2(0.0f, 1.0f), facts.message);
    if (facts.shows_help) draw_help(facts.help);
    if (facts.shows_panel) draw_panel_window(settings, facts, state);
    if (!facts.has_mouse) draw_note("paused", ImVec2(0.3f, 0.9f), "Click to go on. Escape quits.");
}

}  // namespace game
