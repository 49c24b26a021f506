// The last pass: radiance, or another view of the frame, as display-encoded colours, and from there to a
// window.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <string>

#include "frame/frame_recorder.h"
#include "gl/program_library.h"
#include "passes/gbuffer.h"
#include "plan/shader_variants.h"

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

class DisplayPass {
  public:
    DisplayPass(ProgramLibrary& programs, int width_px, int height_px);

    // Shows a finished frame: RGBA8, row 0 on top. Radiance and emission are scaled by 2^exposure_ev and run
    // through shared/math/display.h, as PNG files are.
    const Texture2D& record(FrameRecorder& frame, const Texture2D& radiance, const GBuffer& gbuffer,
                            DisplayView view, float exposure_ev);

    // Draws the last picture over the whole of a framebuffer (0: the window's), scaled to its size.
    void present(const glm::ivec2& window_size_px, unsigned framebuffer = 0) const;

  private:
    ProgramLibrary& programs_;
    Texture2D picture_;
    Framebuffer framebuffer_;
};

}  // namespace tarn
