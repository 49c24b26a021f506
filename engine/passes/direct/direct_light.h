// Direct light: choose a sample a pixel, ask whether it is seen, shade.
#pragma once

#include <string>
#include <vector>

#include "frame/frame_recorder.h"
#include "gl/program_library.h"
#include "passes/gbuffer.h"
#include "passes/visibility.h"

namespace tarn {

enum class DirectMode {
    UNIFORM,  // one random light, one ray
    RIS,      // streaming RIS over M candidates by power, one ray for the winner
};

// A chosen sample a pixel, and the ray that tests it.
struct Candidates {
    const Buffer& reservoirs;  // RESERVOIR_ROWS rows a pixel
    const BufferTexture& reservoir_texture;
    const Buffer& rays;  // RAY_ROWS rows a pixel, shared with the CPU
};

class DirectCandidatesPass {
  public:
    DirectCandidatesPass(ProgramLibrary& programs, int width_px, int height_px);

    Candidates record(FrameRecorder& frame, const GBuffer& gbuffer, DirectMode mode, const Buffer& counters,
                      const std::vector<std::string>& scene_defines);

  private:
    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
    Buffer reservoirs_;
    BufferTexture reservoir_texture_;
    Buffer rays_;
};

class DirectShadePass {
  public:
    DirectShadePass(ProgramLibrary& programs, int width_px, int height_px);

    // RGBA32F: emission and direct light, W sr^-1 m^-2.
    const Texture2D& record(FrameRecorder& frame, const GBuffer& gbuffer, const Candidates& candidates,
                            const Visibility& visibility, const Buffer& counters,
                            const std::vector<std::string>& scene_defines);

  private:
    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
    Texture2D radiance_;
};

}  // namespace tarn
