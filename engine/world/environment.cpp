// The sky: radiance per texel and the table that samples it.
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "shared/math/colour.h"
#include "shared/math/environment.h"
#include "world/alias_builder.h"
#include "world/build_steps.h"

namespace tarn {
namespace {

// Mean luminance of the bilinear lookup within a texel, whose rims reach into the neighbours. Sampling
// by it leaves no lit direction without a chance.
double mean_luminance(const Image& image, int column, int row) {
    double sum = 0.0;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const int x = (column + dx + image.width) % image.width;
            const int y = std::clamp(row + dy, 0, image.height - 1);
            const float* p = image.pixel(x, y);
            // Integral of the bilinear weights over the texel.
            const double weight = (dx == 0 ? 0.75 : 0.125) * (dy == 0 ? 0.75 : 0.125);
            sum += weight * luminance(glm::vec3(p[0], p[1], p[2]));
        }
    }
    return sum;
}

}  // namespace

WorldEnvironment make_environment(const Image& radiance) {
    if (radiance.channels != 3 || radiance.width < 1 || radiance.height < 1) {
        throw Error(
            "the environment has {} channels and {} x {} pixels, it needs 3 channels and at least one pixel",
            radiance.channels, radiance.width, radiance.height);
    }
    for (const float value : radiance.values) {
        if (!std::isfinite(value) || value < 0.0f) {
            throw Error("the environment holds the radiance {}, which is not a finite number >= 0", value);
        }
    }
    WorldEnvironment environment;
    environment.width = std::uint32_t(radiance.width);
    environment.height = std::uint32_t(radiance.height);
    std::vector<double> weights;
    weights.reserve(radiance.pixel_count());
    for (int y = 0; y < radiance.height; ++y) {
        const double solid_angle =
            environment_texel_solid_angle(std::uint32_t(y), environment.width, environment.height);
        for (int x = 0; x < radiance.width; ++x)
            weights.push_back(mean_luminance(radiance, x, y) * solid_angle);
    }
    AliasTable table = build_alias_table(weights);
    environment.alias_rows = std::move(table.rows);
    environment.texels.reserve(radiance.pixel_count());
    for (std::size_t i = 0; i < radiance.pixel_count(); ++i) {
        const float* p = &radiance.values[3 * i];
        environment.texels.emplace_back(p[0], p[1], p[2], table.pmf[i]);
    }
    return environment;
}

Image make_even_sky(float radiance) {
    Image image(2, 2, 3);
    std::fill(image.values.begin(), image.values.end(), radiance);
    return image;
}

}  // namespace tarn
