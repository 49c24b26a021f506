// How a method follows a world that changes at once: how much of the change its pictures show, frame by
// frame, and how noisy they are meanwhile.
#pragma once

#include <optional>
#include <vector>

#include "core/image.h"
#include "metrics/frame_mean.h"

namespace tarn {

// Pictures from before the change and from each of a number of frames after it, of any number of seeds. The
// mean over the second half of the frames after stands for what the method comes to in the end.
class StepResponse {
  public:
    explicit StepResponse(int frames) : frames_(std::size_t(frames)), pictures_(std::size_t(frames)) {}

    void add_before(const Image& picture) { before_.add(picture); }
    // `frame` 0 is the first after the change.
    void add_after(int frame, const Image& picture);

    // Of each frame's mean over seeds: its projection on the whole change, 0 where nothing has changed yet, 1
    // at the end; all 1 where nothing changes.
    std::vector<double> progress() const;
    // Squared distance of each frame's single pictures from the end, averaged over values.
    std::vector<double> noise() const;

    // Frames until the change is reached to this share, and until the noise is at most this many times that
    // of the second half; 1: at once. Nullopt where it never is.
    std::optional<int> frames_to_reach(double share) const;
    std::optional<int> frames_to_settle(double times) const;

  private:
    FrameMean before_;
    FrameMean after_;
    std::vector<FrameMean> frames_;             // over seeds
    std::vector<std::vector<Image>> pictures_;  // [frame][seed]
};

}  // namespace tarn
