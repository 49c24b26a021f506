// Periodic noise: hashed lattice values with smooth interpolation, and nearest jittered centres.
#include "content/noise.h"

#include <cmath>

namespace tarn::content {
namespace {

int wrap(int i, int period) {
    return (i % period + period) % period;
}

float fade(float t) {
    return t * t * (3.0f - 2.0f * t);
}

}  // namespace

float Noise::stretched(float u, float v, int frequency_u, int frequency_v) const {
    const float x = u * static_cast<float>(frequency_u), y = v * static_cast<float>(frequency_v);
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const auto value = [&](int ix, int iy) {
        const int column = wrap(ix, frequency_u), row = wrap(iy, frequency_v);
        return random_.unit(static_cast<std::uint64_t>(column + frequency_u * row), frequency_u);
    };
    const float tx = fade(x - static_cast<float>(x0)), ty = fade(y - static_cast<float>(y0));
    const float low = glm::mix(value(x0, y0), value(x0 + 1, y0), tx);
    const float high = glm::mix(value(x0, y0 + 1), value(x0 + 1, y0 + 1), tx);
    return glm::mix(low, high, ty);
}

float Noise::fractal(float u, float v, int frequency, int octaves) const {
    float sum = 0.0f, weight = 0.5f, total = 0.0f;
    for (int octave = 0; octave < octaves; ++octave, frequency *= 2, weight *= 0.5f) {
        sum += weight * stretched(u, v, frequency, frequency);
        total += weight;
    }
    return sum / total;
}

Cell Cells::at(float u, float v) const {
    const float x = u * static_cast<float>(count_), y = v * static_cast<float>(count_);
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    float nearest = 1e9f, second = 1e9f, value = 0.0f;
    for (int iy = y0 - 1; iy <= y0 + 1; ++iy) {
        for (int ix = x0 - 1; ix <= x0 + 1; ++ix) {
            const auto index = static_cast<std::uint64_t>(wrap(ix, count_) + count_ * wrap(iy, count_));
            const glm::vec2 centre(static_cast<float>(ix) + random_.between(0.2f, 0.8f, index, 0),
                                   static_cast<float>(iy) + random_.between(0.2f, 0.8f, index, 1));
            const float distance = glm::length(glm::vec2(x, y) - centre);
            if (distance < nearest) {
                second = nearest;
                nearest = distance;
                value = random_.unit(index, 2);
            } else if (distance < second) {
                second = distance;
            }
        }
    }
    return {value, second - nearest};
}

}  // namespace tarn::content
