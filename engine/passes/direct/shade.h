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

    // RGBA32F, W sr^-1 m^-2.
    const Texture2D& radiance() const { return radiance_; }

  private:
    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
    Texture2D radiance_;
};

}  // namespace tarn
