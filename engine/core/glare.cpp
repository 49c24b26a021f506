#include "core/glare.h"

#include <utility>
#include <vector>

#include "core/error.h"
#include "shared/math/glare.h"

namespace tarn {
namespace {

vec3 load_light(const Image& image, int x, int y) {
    const float* values = image.pixel(x, y);
    return vec3(values[0], values[1], values[2]);
}

// Four channels: RGB and area.
Image take_excess(const Image& exposed) {
    Image excess(exposed.width, exposed.height, 4);
    for (int y = 0; y < exposed.height; ++y) {
        for (int x = 0; x < exposed.width; ++x) {
            const vec3 light = find_excess(load_light(exposed, x, y));
            float* values = excess.pixel(x, y);
            for (int c = 0; c < 3; ++c) values[c] = light[c];
            values[3] = 1.0f;
        }
    }
    return excess;
}

vec4 find_cell(const Image& large, int cell_x, int cell_y) {
    vec3 light(0.0f);
    float area = 0.0f;
    for (int row = 0; row < 4; ++row) {
        const int y = glare_pixel(cell_y, row, large.height);
        for (int column = 0; column < 4; ++column) {
            const int x = glare_pixel(cell_x, column, large.width);
            if (x < 0 || y < 0) continue;
            const float weight = glare_weight(row) * glare_weight(column) * large.pixel(x, y)[3];
            light += weight * load_light(large, x, y);
            area += weight;
        }
    }
    return vec4(light / area, area);
}

Image make_smaller(const Image& large) {
    Image small(halve_size(large.width), halve_size(large.height), 4);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            const vec4 cell = find_cell(large, x, y);
            for (int c = 0; c < 4; ++c) small.pixel(x, y)[c] = cell[c];
        }
    }
    return small;
}

vec3 load_enlarged(const Image& cells, int x, int y) {
    const int far_x = glare_neighbour(x, cells.width);
    const int far_y = glare_neighbour(y, cells.height);
    const vec3 near_row = mix(load_light(cells, x / 2, y / 2), load_light(cells, far_x, y / 2), 0.25f);
    const vec3 far_row = mix(load_light(cells, x / 2, far_y), load_light(cells, far_x, far_y), 0.25f);
    return mix(near_row, far_row, 0.25f);
}

}  // namespace

void add_glare_to(Image& exposed, float strength) {
    TARN_ASSERT(exposed.channels == 3, "{} channels, 3 are needed", exposed.channels);
    const int count = count_glare_levels(exposed.width, exposed.height);
    std::vector<Image> levels = {take_excess(exposed)};
    for (int level = 0; level < count; ++level) levels.push_back(make_smaller(levels.back()));
    for (int level = count - 1; level > 0; --level) {
        Image& own = levels[std::size_t(level)];
        for (int y = 0; y < own.height; ++y) {
            for (int x = 0; x < own.width; ++x) {
                const vec3 wider = load_enlarged(levels[std::size_t(level) + 1], x, y);
                for (int c = 0; c < 3; ++c) own.pixel(x, y)[c] += wider[c];
            }
        }
    }
    for (int y = 0; y < exposed.height; ++y) {
        for (int x = 0; x < exposed.width; ++x) {
            const vec3 light =
                add_glare(load_light(exposed, x, y), load_enlarged(levels[1], x, y), count, strength);
            for (int c = 0; c < 3; ++c) exposed.pixel(x, y)[c] = light[c];
        }
    }
}

}  // namespace tarn
