// Periodic value noise and periodic jittered cells over the unit square.
#pragma once

#include <cstdint>

#include "content/portable_math.h"

namespace tarn::content {

class Noise {
  public:
    explicit Noise(std::uint64_t seed) : random_(seed) {}

    // Sum of `octaves` octaves that starts with `frequency` lattice cells across the square; in [0, 1],
    // period 1.
    float fractal(float u, float v, int frequency, int octaves) const;

    // One octave with `frequency_u` x `frequency_v` lattice cells.
    float stretched(float u, float v, int frequency_u, int frequency_v) const;

  private:
    Random random_;
};

struct Cell {
    float value;   // a random number of the nearest cell, in [0, 1)
    float border;  // distance to the second nearest centre minus that to the nearest, in cell widths
};

// A Worley pattern of `count` x `count` jittered centres, period 1.
class Cells {
  public:
    Cells(int count, std::uint64_t seed) : count_(count), random_(seed) {}
    Cell at(float u, float v) const;

  private:
    int count_;
    Random random_;
};

}  // namespace tarn::content
