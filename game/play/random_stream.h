// Random numbers that are the same with every compiler and library: SplitMix64 (Steele et al. 2014).
#pragma once

#include <cstdint>

namespace game {

class RandomStream {
  public:
    explicit RandomStream(std::uint64_t seed) : state_(seed) {}

    // 0 to below 1.
    double next() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    double next(double least, double most) { return least + (most - least) * next(); }

  private:
    std::uint64_t state_;
};

}  // namespace game
