// The blue noise mask in memory: loaded from the file that the build makes, uploaded as it is, read by the
// CPU.
#pragma once

#include <filesystem>
#include <vector>

#include "shared/math/blue_noise.h"

namespace tarn {

struct BlueNoiseMask {
    // BLUE_NOISE_TEXEL_COUNT of them, in the order of blue_noise_texel: the first coordinate in the lower 16
    // bits, the second in the upper ones, both in units of 2^-16.
    std::vector<uint> texels;
};

// Reads the mask from where Tarn's data files are: the folder "noise" (core/data_files.h, TARN_NOISE_DIR).
// Throws Error that lists the places where it is missing, and as the next function.
BlueNoiseMask load_blue_noise();

// Reads `file`. Throws Error naming the file and what is wrong: missing, too short or too long, no mask,
// another version or size, damaged.
BlueNoiseMask load_blue_noise(const std::filesystem::path& file);

// Blue noise on the CPU: blue_noise2 and blue_noise1. A view: the mask must outlive it. Safe to use from many
// threads.
class BlueNoiseAccess {
  public:
    explicit BlueNoiseAccess(const BlueNoiseMask& mask) : mask_(mask) {}

    uint fetch_blue_noise(uint index) const { return mask_.texels[index]; }

#include "shared/scene/blue_noise.h"

  private:
    const BlueNoiseMask& mask_;
};

}  // namespace tarn
