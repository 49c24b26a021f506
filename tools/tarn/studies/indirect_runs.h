// Indirect light alone, as studies of it look at it: of frames, and of references. Direct light is taken out
// of all pictures: it is the same, bit by bit, with and without indirect light.
#pragma once

#include <limits>
#include <vector>

#include "studies/study.h"

namespace tarn {

// a - b, value by value.
Image subtract(Image a, const Image& b);

// Over all values.
double mean_of(const Image& image);

struct IndirectRun {
    std::vector<Image> frames;                                     // after the warm-up
    double indirect_ms = std::numeric_limits<double>::infinity();  // least of a frame: others only add
};

// Throws Error on Ctrl-C.
IndirectRun render_indirect_run(Renderer& renderer, const StudySequence& sequence);

// Light of `bounces` surfaces before the one that is seen.
class IndirectReferences {
  public:
    IndirectReferences(RenderSession& session, const SceneOptions& scene, int spp);

    Image find(int bounces) { return subtract(render(bounces + 1), direct_); }

  private:
    Image render(int bounces);

    RenderSession& session_;
    const SceneOptions& scene_;
    int spp_;
    Image direct_;
};

}  // namespace tarn
