// A rectangle of floats: linear radiance, row 0 on top, channels interleaved.
#pragma once

#include <cstddef>
#include <vector>

namespace tarn {

struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<float> values;  // [height][width][channels]

    Image() = default;
    Image(int width_px, int height_px, int channel_count)
        : width(width_px),
          height(height_px),
          channels(channel_count),
          values(std::size_t(width_px) * std::size_t(height_px) * std::size_t(channel_count), 0.0f) {}

    bool empty() const { return values.empty(); }
    std::size_t pixel_count() const { return std::size_t(width) * std::size_t(height); }
    float* pixel(int x, int y) { return &values[(std::size_t(y) * width + x) * channels]; }
    const float* pixel(int x, int y) const { return &values[(std::size_t(y) * width + x) * channels]; }
};

}  // namespace tarn
