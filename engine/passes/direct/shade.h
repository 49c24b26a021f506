// Direct light, last step: the chosen samples light their pixels.
#pragma once

#include "passes/direct/direct_frame.h"

namespace tarn {

class DirectShadePass {
  public:
    DirectShadePass(ProgramLibrary& programs, int width_px, int height_px);

    // Adds the light of `reservoirs` to the picture; the first call of a frame starts it with emission.
    // `answers`: one a pixel, where its sample was traced after all reuse, else null: what the reservoir
    // knows is used.
    void record(const DirectFrame& direct, const RowBuffer& reservoirs, const RowBuffer* answers, bool first);
    // The same with light that reuse has summed (ReuseStep::Io::light).
    void record(const DirectFrame& direct, const Texture2D& light, bool first);

    // RGBA32F, W sr^-1 m^-2.
    const Texture2D& radiance() const { return radiance_; }

  private:
    const Program& prepare(const DirectFrame& direct, std::vector<std::string> defines, bool first);

    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
    Texture2D radiance_;
};

}  // namespace tarn
