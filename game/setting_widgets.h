// A widget for each setting. For panel.cpp alone.
#pragma once

#include <string>
#include <vector>

#include "tarn_names.h"

namespace game {

// A combo for a choice, a slider for a number, for each row that applies; its sentence is the tooltip.
// The row `elsewhere` has a widget of its own.
void draw_settings(const std::vector<SettingInfo>& rows, const std::string& elsewhere, Settings& settings);

// Shows `text` while the mouse rests on the last widget.
void add_tooltip(const std::string& text);

}  // namespace game
