// The help over the picture: in windows of every size it has all its lines inside, and none over another.
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "game/sandbox/help.h"

namespace {

struct Glyphs {
    float left = 1e9f, right = -1e9f, top = 1e9f, bottom = -1e9f;
    int count = 0;
    std::vector<ImVec4> places;  // left, top, right, bottom
    float letter_px = 0.0f;      // the height of the highest letter
};

// Draws it without a window and finds what letters there are.
Glyphs draw(float width, float height, const std::vector<game::HelpLine>& lines) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    ImGui::GetStyle().WindowBorderSize = 0.0f;
    io.DisplaySize = ImVec2(width, height);
    unsigned char* pixels = nullptr;
    int atlas_width = 0, atlas_height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &atlas_width, &atlas_height);
    // A window takes its first frame to find its place.
    for (int frame = 0; frame < 3; ++frame) {
        ImGui::NewFrame();
        game::draw_help(lines);
        ImGui::Render();
    }
    Glyphs glyphs;
    const ImDrawData& data = *ImGui::GetDrawData();
    for (int list = 0; list < data.CmdListsCount; ++list) {
        const ImDrawList& drawn = *data.CmdLists[list];
        for (int i = 0; i + 5 < drawn.IdxBuffer.Size; i += 3) {
            const ImDrawVert &a = drawn.VtxBuffer[drawn.IdxBuffer[i]],
                             &b = drawn.VtxBuffer[drawn.IdxBuffer[i + 1]],
                             &c = drawn.VtxBuffer[drawn.IdxBuffer[i + 2]];
            // The upper right half of a letter's rectangle. What is plain has no extent in the atlas.
            if (!(a.uv.x < c.uv.x && a.uv.y < c.uv.y && b.uv.x == c.uv.x && b.uv.y == a.uv.y)) continue;
            glyphs.left = std::min(glyphs.left, a.pos.x);
            glyphs.top = std::min(glyphs.top, a.pos.y);
            glyphs.right = std::max(glyphs.right, c.pos.x);
            glyphs.bottom = std::max(glyphs.bottom, c.pos.y);
            glyphs.letter_px = std::max(glyphs.letter_px, c.pos.y - a.pos.y);
            ++glyphs.count;
            glyphs.places.emplace_back(a.pos.x, a.pos.y, c.pos.x, c.pos.y);
        }
    }
    ImGui::DestroyContext();
    return glyphs;
}

// Pairs of letters of which one covers a part of the other.
int count_overlaps(const Glyphs& glyphs) {
    constexpr float TOUCHING_PX = 0.5f;
    int count = 0;
    for (std::size_t i = 0; i < glyphs.places.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const ImVec4 &a = glyphs.places[i], &b = glyphs.places[j];
            const float width = std::min(a.z, b.z) - std::max(a.x, b.x),
                        height = std::min(a.w, b.w) - std::max(a.y, b.y);
            if (width > TOUCHING_PX && height > TOUCHING_PX) ++count;
        }
    }
    return count;
}

int count_letters(const std::vector<game::HelpLine>& lines) {
    int count = 0;
    for (const game::HelpLine& line : lines) {
        for (const char letter : line.keys + line.sentence) count += letter == ' ' ? 0 : 1;
    }
    return count;
}

TEST(Help, IsInsideOfEveryWindow) {
    const std::vector<game::HelpLine> lines = game::list_help({});
    for (const ImVec2& size :
         {ImVec2(1280, 720), ImVec2(640, 360), ImVec2(320, 240), ImVec2(320, 480), ImVec2(320, 180)}) {
        const Glyphs glyphs = draw(size.x, size.y, lines);
        // Those outside of its window would not be drawn.
        // In a paragraph there are colons and points besides.
        EXPECT_GE(glyphs.count, count_letters(lines)) << size.x << "x" << size.y;
        EXPECT_LE(glyphs.count, count_letters(lines) + 2 * int(lines.size())) << size.x << "x" << size.y;
        EXPECT_EQ(count_overlaps(glyphs), 0) << size.x << "x" << size.y;
        EXPECT_GE(glyphs.left, 0.0f) << size.x << "x" << size.y;
        EXPECT_GE(glyphs.top, 0.0f) << size.x << "x" << size.y;
        EXPECT_LE(glyphs.right, size.x) << size.x << "x" << size.y;
        EXPECT_LE(glyphs.bottom, size.y) << size.x << "x" << size.y;
    }
}

TEST(Help, HasSmallerLettersOnlyWhereItMust) {
    const std::vector<game::HelpLine> lines = game::list_help({});
    const float usual = draw(1280, 720, lines).letter_px;
    for (const ImVec2& size : {ImVec2(640, 360), ImVec2(320, 480), ImVec2(320, 240)})
        EXPECT_EQ(draw(size.x, size.y, lines).letter_px, usual) << size.x << "x" << size.y;
    EXPECT_LT(draw(320, 180, lines).letter_px, usual);
    EXPECT_GE(draw(320, 180, lines).letter_px, 0.5f * usual);
}

// A key with a long name pushes the lines below it down.
TEST(Help, HasColumnsWhereThereIsRoomForThem) {
    const std::vector<game::HelpLine> lines = game::list_help({});
    EXPECT_EQ(draw(640, 360, lines).count, count_letters(lines));
    EXPECT_EQ(draw(320, 600, lines).count, count_letters(lines));
    EXPECT_GT(draw(320, 240, lines).count, count_letters(lines));
}

TEST(Help, LinesThatAreBrokenMakeTheHelpHigher) {
    std::vector<game::HelpLine> lines = {{"E", "short"}, {"F", "short"}};
    const Glyphs before = draw(320, 400, lines);
    lines[0].keys = "LeftControl, RightControl, LeftAlt, RightAlt";
    const Glyphs after = draw(320, 400, lines);
    EXPECT_GT(after.bottom - after.top, before.bottom - before.top + before.letter_px);
    EXPECT_EQ(after.count, count_letters(lines));
    EXPECT_EQ(count_overlaps(after), 0);
}

}  // namespace
