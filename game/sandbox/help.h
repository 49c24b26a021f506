// The help that F1 shows: which keys do what, as they are bound.
#pragma once

#include <string>
#include <vector>

#include "key_map.h"

namespace game {

struct HelpLine {
    std::string keys;  // empty: a sentence of its own
    std::string sentence;
};

std::vector<HelpLine> list_help(const KeyMap& keys);

// In the middle of the window, in two columns whose lines are broken to fit. Where a small window has no room
// for that, in one paragraph, and if it must be in smaller letters. Call between Widgets::begin() and end().
void draw_help(const std::vector<HelpLine>& lines);

}  // namespace game
