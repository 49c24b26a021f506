#include "ui/setting_widgets.h"

#include <imgui.h>

namespace tarn {
namespace {

constexpr double LOGARITHMIC_FROM = 100.0;  // sliders over a wider ratio would crowd the small values

void draw_choice(const Setting& setting, RenderSettings& settings) {
    const std::size_t current = std::size_t(setting.get(settings));
    if (!ImGui::BeginCombo(setting.name.c_str(), setting.choices[current].c_str())) return;
    for (std::size_t i = 0; i < setting.choices.size(); ++i) {
        if (ImGui::Selectable(setting.choices[i].c_str(), i == current)) setting.set(settings, double(i));
    }
    ImGui::EndCombo();
}

void draw_number(const Setting& setting, RenderSettings& settings) {
    const bool wide = setting.minimum > 0.0 && setting.maximum / setting.minimum >= LOGARITHMIC_FROM;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
    const std::string format = setting.unit.empty() ? "%.4g" : "%.4g " + setting.unit;
    double value = setting.get(settings);
    if (ImGui::SliderScalar(setting.name.c_str(), ImGuiDataType_Double, &value, &setting.minimum,
                            &setting.maximum, format.c_str(), flags)) {
        setting.set(settings, value);
    }
}

}  // namespace

void draw_settings(RenderSettings& settings) {
    for (const Setting& setting : setting_table()) {
        if (setting.applies && !setting.applies(settings)) continue;
        if (setting.choices.empty()) {
            draw_number(setting, settings);
        } else {
            draw_choice(setting, settings);
        }
        add_tooltip(setting.sentence.c_str());
    }
}

void add_tooltip(const char* text) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace tarn
