#include "help.h"

#include <imgui.h>

#include <algorithm>

namespace game {
namespace {

constexpr ImGuiWindowFlags HELP_WINDOW = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                         ImGuiWindowFlags_NoFocusOnAppearing;
constexpr float WIDEST_LETTERS = 66.0f;  // of the window, in widths of an x
constexpr float KEYS_SHARE = 0.26f;      // of its width
constexpr float SMALLEST = 0.5f;         // of the usual size of letters

struct Columns {
    float keys_px = 0.0f;
    float gap_px = 0.0f;
    float sentence_px = 0.0f;
};

Columns find_columns(float width_px) {
    Columns columns;
    columns.keys_px = KEYS_SHARE * width_px;
    columns.gap_px = ImGui::GetStyle().ItemSpacing.x;
    columns.sentence_px = width_px - columns.keys_px - columns.gap_px;
    return columns;
}

float text_height(const std::string& text, float width_px) {
    return text.empty() ? 0.0f : ImGui::CalcTextSize(text.c_str(), nullptr, false, width_px).y;
}

float line_height(const HelpLine& line, const Columns& columns) {
    if (line.keys.empty())
        return text_height(line.sentence, columns.keys_px + columns.gap_px + columns.sentence_px);
    return std::max(text_height(line.keys, columns.keys_px), text_height(line.sentence, columns.sentence_px));
}

// At the usual size of letters, in a column so many times as wide as there is room.
float total_height(const std::vector<HelpLine>& lines, float width_px) {
    const Columns columns = find_columns(width_px);
    float height = 0.0f;
    for (const HelpLine& line : lines) height += line_height(line, columns);
    return height;
}

// The largest size of letters at which all lines fit: smaller letters also need fewer lines.
float find_letter_size(const std::vector<HelpLine>& lines, const ImVec2& room) {
    for (float size = 1.0f; size > SMALLEST; size -= 0.05f) {
        if (size * total_height(lines, room.x / size) <= room.y) return size;
    }
    return SMALLEST;
}

// All in one paragraph, which needs fewer lines in a small window.
std::vector<HelpLine> join(const std::vector<HelpLine>& lines) {
    HelpLine all;
    for (const HelpLine& line : lines) {
        if (!all.sentence.empty()) all.sentence += ' ';
        if (!line.keys.empty()) all.sentence += line.keys + ": ";
        all.sentence += line.sentence;
        if (!line.sentence.ends_with('.')) all.sentence += '.';
    }
    return {all};
}

void write_wrapped(const std::string& text, const ImVec2& place, float width_px) {
    ImGui::SetCursorPos(place);
    ImGui::PushTextWrapPos(place.x + width_px);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
}

void write_lines(const std::vector<HelpLine>& lines, float width_px) {
    const Columns columns = find_columns(width_px);
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    float y = padding.y;
    for (const HelpLine& line : lines) {
        const float left = line.keys.empty() ? 0.0f : columns.keys_px + columns.gap_px;
        if (!line.keys.empty()) write_wrapped(line.keys, {padding.x, y}, columns.keys_px);
        write_wrapped(line.sentence, {padding.x + left, y}, width_px - left);
        y += line_height(line, columns);
    }
}

}  // namespace

std::vector<HelpLine> list_help(const KeyMap& keys) {
    const auto of = [&](Action action) { return keys.describe(action); };
    return {{of(Action::FORWARD) + " " + of(Action::LEFT) + " " + of(Action::BACK) + " " + of(Action::RIGHT),
             "walk; the mouse looks around"},
            {of(Action::RUN), "run"},
            {of(Action::JUMP), "jump"},
            {of(Action::CROUCH), "crouch"},
            {"left button", "throw a ball; the wheel chooses its colour"},
            {of(Action::USE), "light the lantern in view, or put it out"},
            {"wheel", "recolour that lantern; running: dim it"},
            {of(Action::TORCH), "take out a torch, or put it away"},
            {of(Action::RESTART), "start again"},
            {of(Action::SAVE), "save"},
            {of(Action::LOAD), "load what was saved"},
            {of(Action::HELP), "this help"},
            {of(Action::PANEL), "panel"},
            {of(Action::FULLSCREEN), "fullscreen"},
            {of(Action::SCREENSHOT), "screenshot; with Shift as EXR"},
            {"gamepad", "A jumps, B crouches, X lights; triggers run and throw"},
            {"dropped file", ".gltf, .glb: play in it; .hdr, .exr: sky"},
            {"Escape", "free the mouse, then quit"},
            {"", "Some lanterns of the court are dead: light them all."}};
}

void draw_help(const std::vector<HelpLine>& lines) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    const ImVec2 room(screen.x - 2.0f * padding.x, screen.y - 2.0f * padding.y);
    const float widest = WIDEST_LETTERS * ImGui::CalcTextSize("x").x;
    const float width = std::min(room.x, widest);
    const std::vector<HelpLine> joined = join(lines);
    const float size_of_columns = find_letter_size(lines, {width, room.y});
    const float size_of_joined = find_letter_size(joined, {width, room.y});
    const bool has_columns = size_of_columns >= size_of_joined;
    const std::vector<HelpLine>& shown = has_columns ? lines : joined;
    const float size = has_columns ? size_of_columns : size_of_joined;
    const float height = size * total_height(shown, width / size);
    ImGui::SetNextWindowPos(ImVec2(0.5f * screen.x, 0.5f * screen.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(ImVec2(width + 2.0f * padding.x, height + 2.0f * padding.y));
    ImGui::SetNextWindowBgAlpha(0.55f);
    if (ImGui::Begin("help", nullptr, HELP_WINDOW)) {
        ImGui::SetWindowFontScale(size);
        write_lines(shown, width);
    }
    ImGui::End();
}

}  // namespace game
