// Holds the time of a frame: renders less where frames take too long, and more again where there is time to
// spare. Pure functions of settings and times.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "../tarn_names.h"

namespace game {

// A ladder of settings, each rung cheaper than the one before. Rung 0 is what the user chose.
class Ladder {
  public:
    explicit Ladder(const Settings& chosen);

    int size() const { return int(rungs_.size()); }
    const Settings& settings(int rung) const { return rungs_[std::size_t(rung)].settings; }
    // What it changes of the rung above: "scale 0.5", or "as chosen".
    const std::string& sentence(int rung) const { return rungs_[std::size_t(rung)].sentence; }

  private:
    struct Rung {
        Settings settings;
        std::string sentence;
    };
    std::vector<Rung> rungs_;
};

// Which rung to stand on.
class Governor {
  public:
    // Time of the next frame, from the last one to this; `target_ms`: what to hold, 0: rung 0 always.
    // `rungs`: how many there are. The answer changes seldom: each change costs some frames of noise.
    int follow(double frame_ms, double target_ms, int rungs);

    int rung() const { return rung_; }

  private:
    void move(int rung);

    std::deque<double> recent_ms_;  // since the last change
    int rung_ = 0;
    int frames_on_rung_ = 0;
    int patience_ = 32;         // frames with time to spare before it climbs
    bool has_climbed_ = false;  // and it is not known yet whether it can stay
};

}  // namespace game
