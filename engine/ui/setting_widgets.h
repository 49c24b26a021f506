// A widget for each row of the settings table. Private to this folder.
#pragma once

#include "settings/settings.h"

namespace tarn {

// A combo for a choice, a slider for a number; the row's sentence is the tooltip.
void draw_settings(RenderSettings& settings);

// Shows `text` while the mouse rests on the last widget.
void add_tooltip(const char* text);

}  // namespace tarn
