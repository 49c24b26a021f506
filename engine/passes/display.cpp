#include "passes/display.h"

#include <array>

#include "core/error.h"
#include "gl/framebuffer.h"
#include "passes/glare.h"
#include "shared/interface/bindings.h"
#include "shared/interface/constants/display.h"

namespace tarn {
namespace {

constexpr std::array<DisplayViewInfo, DISPLAY_VIEW_COUNT> VIEWS = {{
    {"radiance", "The picture: exposed, tone-mapped, sRGB"},
    {"luminance",
     "False colour, one step a stop: black 2^-8 or less of middle grey, green at it, white 2^8 or more"},
    {"albedo", "Diffuse albedo + F0, sRGB"},
    {"emission", "Light sources, the sky and unlit materials alone, exposed as the picture"},
    {"geometric normals", "Triangle normals: red +X, green +Y, blue +Z"},
    {"shading normals", "Interpolated and mapped normals: red +X, green +Y, blue +Z"},
    {"position error",
     "False colour of the bound on the position's rounding error: black 1 nm or less, white 1 mm or more"},
    {"primitives", "One colour a triangle"},
}};

}  // namespace

std::span<const DisplayViewInfo> display_views() {
    return VIEWS;
}

std::string list_display_views() {
    std::string names;
    for (const DisplayViewInfo& view : VIEWS) names += (names.empty() ? "" : ", ") + std::string(view.name);
    return names;
}

DisplayView parse_display_view(const std::string& name) {
    for (std::size_t i = 0; i < VIEWS.size(); ++i) {
        if (name == VIEWS[i].name) return DisplayView(i);
    }
    throw Error("view '{}' is none of: {}", name, list_display_views());
}

Picture show_frame(const FrameContext& frame, const DisplayChoice& choice, const Picture& radiance,
                   const GBuffer& gbuffer, const Exposure& exposure) {
    const bool has_glare = choice.view == DisplayView::RADIANCE && choice.look.glare > 0.0f;
    const Picture glare = has_glare ? spread_glare(frame, radiance, exposure) : nullptr;
    const Picture shown = frame.recorder.take_picture("display", frame.output_px, GL_RGBA8);
    PassRecorder pass = frame.pass("display");
    read_gbuffer(pass, gbuffer)
        .read(UNIT_PASS_A, radiance)
        .read(UNIT_PASS_B, gbuffer.seen)
        .read(UNIT_PASS_C, exposure)
        .constants(DisplayConstants{std::uint32_t(frame.output_px.x), std::uint32_t(frame.output_px.y),
                                    std::uint32_t(choice.look.tone), choice.look.glare})
        .write_image(0, *shown);
    if (glare) pass.read(UNIT_PASS_D, glare);
    pass.dispatch(frame.compute(DisplayVariant{choice.view, has_glare}), frame.output_px);
    return shown;
}

void present(const Texture2D& picture, const glm::ivec2& window_size_px, unsigned framebuffer) {
    const bool same_size = window_size_px == glm::ivec2(picture.width_px(), picture.height_px());
    const Framebuffer source("display/present", {&picture}, nullptr);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    // Row 0 of our pictures is the top one, row 0 of a window the bottom one.
    glBlitNamedFramebuffer(source.id(), framebuffer, 0, 0, picture.width_px(), picture.height_px(), 0,
                           window_size_px.y, window_size_px.x, 0, GL_COLOR_BUFFER_BIT,
                           same_size ? GL_NEAREST : GL_LINEAR);
}

}  // namespace tarn
