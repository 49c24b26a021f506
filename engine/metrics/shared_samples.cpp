#include "metrics/shared_samples.h"

#include <algorithm>

namespace tarn {
namespace {

bool is_shared(const Image& samples, int x, int y) {
    const float* own = samples.pixel(x, y);
    for (int v = std::max(0, y - 1); v <= std::min(samples.height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(samples.width - 1, x + 1); ++u) {
            const bool is_self = u == x && v == y;
            if (!is_self && std::equal(own, own + samples.channels, samples.pixel(u, v))) return true;
        }
    }
    return false;
}

}  // namespace

double find_shared_sample_share(const Image& samples) {
    std::size_t shared = 0, lit = 0;
    for (int y = 0; y < samples.height; ++y) {
        for (int x = 0; x < samples.width; ++x) {
            const float* own = samples.pixel(x, y);
            if (std::all_of(own, own + samples.channels, [](float v) { return v == 0.0f; })) continue;
            shared += is_shared(samples, x, y);
            ++lit;
        }
    }
    return lit == 0 ? 0.0 : double(shared) / double(lit);
}

}  // namespace tarn
