#include "bench/resize.h"

#include <algorithm>
#include <cmath>

namespace tarn {
namespace {

// Where a pixel centre of the new size falls between two old ones.
struct Tap {
    int first;
    int second;
    float share;  // of the second
};

Tap find_tap(int pixel, int size, int old_size) {
    const double place = (pixel + 0.5) * old_size / size - 0.5;
    const double inside = std::clamp(place, 0.0, double(old_size - 1));
    const int first = int(inside);
    return {first, std::min(first + 1, old_size - 1), float(inside - first)};
}

}  // namespace

Image resize_bilinear(const Image& image, int width_px, int height_px) {
    Image result(width_px, height_px, image.channels);
    for (int y = 0; y < height_px; ++y) {
        const Tap row = find_tap(y, height_px, image.height);
        for (int x = 0; x < width_px; ++x) {
            const Tap column = find_tap(x, width_px, image.width);
            for (int c = 0; c < image.channels; ++c) {
                const float above = std::lerp(image.pixel(column.first, row.first)[c],
                                              image.pixel(column.second, row.first)[c], column.share);
                const float below = std::lerp(image.pixel(column.first, row.second)[c],
                                              image.pixel(column.second, row.second)[c], column.share);
                result.pixel(x, y)[c] = std::lerp(above, below, row.share);
            }
        }
    }
    return result;
}

}  // namespace tarn
