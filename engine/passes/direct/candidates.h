// Direct light, first step: a fresh sample a pixel, chosen out of candidates, and the ray that tests it.
#pragma once

#include "passes/direct/direct_frame.h"

namespace tarn {

struct Candidates {
    const RowBuffer& reservoirs;  // RESERVOIR_ROWS rows a pixel
    const Buffer& rays;           // RAY_ROWS rows a pixel, shared with the CPU
};

// Where candidates come from besides the light tables; null where the settings do not ask for them.
struct CandidateSources {
    const RowBuffer* tiles = nullptr;
    const RowBuffer* tree = nullptr;
    const RowBuffer* brdf_hits = nullptr;
};

class DirectCandidatesPass {
  public:
    DirectCandidatesPass(ProgramLibrary& programs, int width_px, int height_px);

    Candidates record(const DirectFrame& direct, const CandidateSources& sources);

  private:
    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
    RowBuffer reservoirs_;
    RowBuffer rays_;
};

// Tells fresh samples whether they are seen, and drops those that are not where the settings ask for it.
class InitialVisibilityPass {
  public:
    InitialVisibilityPass(ProgramLibrary& programs, int width_px, int height_px);

    void record(const DirectFrame& direct, const Candidates& candidates, const RowBuffer& answers);

  private:
    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
};

}  // namespace tarn
