// The last pass of a frame that is shown: radiance, or another view of it, as display-encoded colours, and
// from there to a window.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <string>

#include "core/display.h"
#include "passes/exposure.h"
#include "passes/gbuffer.h"

namespace tarn {

struct DisplayViewInfo {
    const char* name;      // "shading normals"
    const char* sentence;  // what its colours mean
};

// All views, in the order of the enumeration.
std::span<const DisplayViewInfo> display_views();

// Their names: "radiance, luminance, ...".
std::string list_display_views();

// The view of that name. Throws Error that lists the names.
DisplayView parse_display_view(const std::string& name);

// Whether a view is one of the light of a picture; else it is one of its surfaces.
inline bool shows_light(DisplayView view) {
    return view == DisplayView::RADIANCE || view == DisplayView::LUMINANCE;
}

// What is shown of a frame, and how.
struct DisplayChoice {
    DisplayView view = DisplayView::RADIANCE;
    DisplayLook look;  // its glare is that of the radiance, not of other views
};

// A view of the frame, RGBA8 at its output size, row 0 on top. `radiance` has that size too. Radiance and
// emission are exposed and run through shared/math/display.h, as PNG files are.
Picture show_frame(const FrameContext& frame, const DisplayChoice& choice, const Picture& radiance,
                   const GBuffer& gbuffer, const Exposure& exposure);

// Draws `picture` over the whole of a framebuffer (0: the window's), scaled to its size.
void present(const Texture2D& picture, const glm::ivec2& window_size_px, unsigned framebuffer = 0);

}  // namespace tarn
