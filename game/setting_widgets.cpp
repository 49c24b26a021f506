#include "setting_widgets.h"

#include <imgui.h>

#include <cmath>

namespace game {
namespace {

constexpr double LOGARITHMIC_FROM = 100.0;  // sliders over a wider ratio would crowd the small values

void draw_choice(const SettingInfo& row, Settings& settings) {
    const std::size_t current = std::size_t(settings.number(row.name));
    if (!ImGui::BeginCombo(row.name.c_str(), row.choices[current].c_str())) return;
    for (std::size_t i = 0; i < row.choices.size(); ++i) {
        if (ImGui::Selectable(row.choices[i].c_str(), i == current)) settings.set_number(row.name, double(i));
    }
    ImGui::EndCombo();
}

void draw_number(const SettingInfo& row, Settings& settings) {
    const bool wide = row.minimum > 0.0 && row.maximum / row.minimum >= LOGARITHMIC_FROM;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
    const std::string format = row.unit.empty() ? "%.4g" : "%.4g " + row.unit;
    double value = settings.number(row.name);
    if (ImGui::SliderScalar(row.name.c_str(), ImGuiDataType_Double, &value, &row.minimum, &row.maximum,
                            format.c_str(), flags)) {
        settings.set_number(row.name, row.is_whole ? std::floor(value) : value);
    }
}

}  // namespace

void draw_settings(const std::vector<SettingInfo>& rows, const std::string& elsewhere, Settings& settings) {
    for (const SettingInfo& row : rows) {
        if (row.name == elsewhere || !settings.applies(row.name)) continue;
        if (row.choices.empty()) {
            draw_number(row, settings);
        } else {
            draw_choice(row, settings);
        }
        add_tooltip(row.sentence);
    }
}

void add_tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace game
