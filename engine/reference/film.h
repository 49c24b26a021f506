// Sums of samples per pixel, in double precision and in the order of the samples.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "shared/dialect.h"

namespace tarn {

// Mean and variance per pixel (Welford). Pixels are independent: different threads may add to different ones.
class Film {
  public:
    Film(int width, int height);

    // A sample that is not finite is left out and counted.
    void add(std::size_t pixel, const glm::vec3& radiance);

    Image mean() const;
    Image variance_of_mean() const;  // 0 where there are fewer than two samples
    std::uint64_t non_finite() const;

    // See ReferenceResult::relative_error.
    double relative_error() const;

  private:
    struct Pixel {
        glm::dvec3 mean{0.0};
        glm::dvec3 squared_deviations{0.0};
        std::uint32_t count = 0;
        std::uint32_t non_finite = 0;

        glm::dvec3 variance_of_mean() const;
    };

    int width_;
    int height_;
    std::vector<Pixel> pixels_;
};

}  // namespace tarn
