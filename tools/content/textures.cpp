// Procedural pictures from periodic value noise and jittered cells.
#include "content/textures.h"

#include <algorithm>
#include <cmath>

#include "content/noise.h"

namespace tarn::content {
namespace {

unsigned char to_byte(float value) {
    return static_cast<unsigned char>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

template <class Shader>  // Shader: glm::vec3 or glm::vec4 of (u, v) in [0, 1)
Picture paint(int size, int channels, const Shader& shader) {
    Picture picture{size, size, channels, {}};
    picture.bytes.reserve(static_cast<std::size_t>(size) * size * channels);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec4 color(shader((x + 0.5f) / size, (y + 0.5f) / size));
            for (int c = 0; c < channels; ++c) picture.bytes.push_back(to_byte(color[c]));
        }
    }
    return picture;
}

// Normal map of a periodic height(u, v) given in texture widths.
template <class Height>
Picture paint_normals(int size, const Height& height) {
    const float step = 1.0f / static_cast<float>(size);
    return paint(size, 3, [&](float u, float v) {
        const float slope_u = (height(u + step, v) - height(u - step, v)) / (2.0f * step);
        const float slope_v = (height(u, v + step) - height(u, v - step)) / (2.0f * step);
        const glm::vec3 normal = glm::normalize(glm::vec3(-slope_u, slope_v, 1.0f));
        return glm::vec4(0.5f * normal + 0.5f, 1.0f);
    });
}

float smooth(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

glm::vec4 gray_tint(const glm::vec3& color, float factor) {
    return glm::vec4(color * factor, 1.0f);
}

}  // namespace

SurfacePictures make_cobbles(int size, std::uint64_t seed) {
    const Cells cells(8, seed);
    const Noise noise(seed + 1);
    const auto crown = [&](const Cell& cell) { return smooth(0.02f, 0.22f, cell.border); };
    const auto height = [&](float u, float v) {
        const Cell cell = cells.at(u, v);
        return 0.022f * crown(cell) * (0.8f + 0.4f * cell.value) + 0.003f * noise.fractal(u, v, 16, 3);
    };
    SurfacePictures pictures;
    pictures.base_color = paint(size, 3, [&](float u, float v) {
        const Cell cell = cells.at(u, v);
        const float grain = 0.8f + 0.4f * noise.fractal(u, v, 32, 4);
        const glm::vec3 stone =
            glm::mix(glm::vec3(0.44f, 0.42f, 0.42f), glm::vec3(0.62f, 0.55f, 0.48f), cell.value);
        return gray_tint(glm::mix(glm::vec3(0.25f, 0.23f, 0.21f), stone, crown(cell)), grain);
    });
    pictures.normal = paint_normals(size, height);
    pictures.roughness = paint(size, 3, [&](float u, float v) {
        const float worn = crown(cells.at(u, v)) * (0.35f + 0.65f * noise.fractal(u, v, 6, 3));
        return glm::vec4(1.0f, 0.95f - 0.6f * worn, 0.0f, 1.0f);
    });
    return pictures;
}

SurfacePictures make_ashlar(int size, std::uint64_t seed) {
    const Noise noise(seed);
    const Random random(seed + 1);
    struct Block {
        float value, joint;  // joint: 0 in the mortar, 1 on the stone
    };
    const auto block_at = [&](float u, float v) {
        const float row = std::floor(v * 8.0f);
        const float along = u * 4.0f + (static_cast<int>(row) & 1 ? 0.5f : 0.0f) + 4.0f;
        const float x = along - std::floor(along), y = v * 8.0f - row;
        const float gap = std::min(std::min(x, 1.0f - x) * 2.0f, std::min(y, 1.0f - y));
        const auto index = static_cast<std::uint64_t>(static_cast<int>(std::floor(along)) % 4 +
                                                      4 * (static_cast<int>(row) & 7));
        return Block{random.unit(index, 0), smooth(0.02f, 0.09f, gap)};
    };
    SurfacePictures pictures;
    pictures.base_color = paint(size, 3, [&](float u, float v) {
        const Block block = block_at(u, v);
        const float grain = 0.85f + 0.3f * noise.fractal(u, v, 12, 5);
        const glm::vec3 stone =
            glm::mix(glm::vec3(0.72f, 0.65f, 0.55f), glm::vec3(0.82f, 0.76f, 0.67f), block.value);
        return gray_tint(glm::mix(glm::vec3(0.52f, 0.47f, 0.41f), stone, block.joint), grain);
    });
    pictures.normal = paint_normals(size, [&](float u, float v) {
        return 0.006f * block_at(u, v + 1.0f).joint + 0.006f * noise.fractal(u, v, 16, 4);
    });
    return pictures;
}

Picture make_plaster(int size, std::uint64_t seed) {
    const Noise noise(seed);
    return paint(size, 3, [&](float u, float v) {
        const float stain = smooth(0.35f, 0.75f, noise.fractal(u, v, 3, 5));
        const float grain = 0.93f + 0.14f * noise.fractal(u, v, 40, 2);
        return gray_tint(glm::mix(glm::vec3(0.80f, 0.68f, 0.54f), glm::vec3(0.68f, 0.55f, 0.43f), stain),
                         grain);
    });
}

Picture make_planks(int size, std::uint64_t seed) {
    const Noise noise(seed);
    const Random random(seed + 1);
    return paint(size, 3, [&](float u, float v) {
        const float plank = std::floor(u * 6.0f), across = u * 6.0f - plank;
        const float value = random.unit(static_cast<std::uint64_t>(plank), 0);
        const float grain = noise.stretched(u, v, 48, 3) * 0.6f + noise.stretched(u, v, 96, 5) * 0.4f;
        const float gap = smooth(0.0f, 0.05f, std::min(across, 1.0f - across));
        const glm::vec3 wood =
            glm::mix(glm::vec3(0.40f, 0.26f, 0.16f), glm::vec3(0.56f, 0.40f, 0.26f), value);
        return gray_tint(wood, (0.75f + 0.5f * grain) * (0.35f + 0.65f * gap));
    });
}

Picture make_clay(int size, std::uint64_t seed) {
    const Noise noise(seed);
    return paint(size, 3, [&](float u, float v) {
        const float moss = smooth(0.55f, 0.8f, noise.fractal(u, v, 4, 4));
        const float row = v * 4.0f - std::floor(v * 4.0f);
        const float edge = 0.6f + 0.4f * smooth(0.0f, 0.12f, row);
        const glm::vec3 clay = glm::mix(glm::vec3(0.62f, 0.33f, 0.22f), glm::vec3(0.40f, 0.38f, 0.26f), moss);
        return gray_tint(clay, edge * (0.8f + 0.4f * noise.fractal(u, v, 16, 3)));
    });
}

Picture make_stripes(int size, std::uint64_t seed) {
    const Noise noise(seed);
    return paint(size, 3, [&](float u, float v) {
        const float stripe = u * 4.0f - std::floor(u * 4.0f);
        const float weave = 0.92f + 0.16f * noise.fractal(u, v, 64, 1);
        const glm::vec3 color = stripe < 0.5f ? glm::vec3(0.95f) : glm::vec3(0.62f, 0.60f, 0.58f);
        return gray_tint(color, weave);
    });
}

Picture make_leaves(int size, std::uint64_t seed) {
    const Random random(seed);
    constexpr int LEAVES = 26;
    return paint(size, 4, [&](float u, float v) {
        glm::vec4 color(0.16f, 0.2f, 0.07f, 0.0f);
        if (std::abs(u - 0.5f) < 0.012f && v > 0.1f) color = {0.3f, 0.22f, 0.12f, 1.0f};
        for (std::uint64_t i = 0; i < LEAVES; ++i) {
            const float side = i % 2 == 0 ? -1.0f : 1.0f;
            const glm::vec2 root(0.5f + side * random.between(0.0f, 0.2f, i, 0),
                                 random.between(0.16f, 0.95f, i, 1));
            const double angle = random.between(0.5f, 1.2f, i, 2);
            const glm::vec2 along(side * sine(angle), -cosine(angle)), across(along.y, -along.x);
            const float length = random.between(0.13f, 0.2f, i, 3);
            const glm::vec2 from_root = glm::vec2(u, v) - root;
            const float t = glm::dot(from_root, along) / length, s = glm::dot(from_root, across) / length;
            if (t < 0.0f || t > 1.0f || std::abs(s) > 0.9f * t * (1.0f - t) + 0.01f) continue;
            const float rib = std::abs(s) < 0.025f ? 0.75f : 1.0f;
            const float value = random.between(0.7f, 1.2f, i, 4);
            color = glm::vec4(glm::vec3(0.36f, 0.50f, 0.18f) * (value * rib), 1.0f);
        }
        return color;
    });
}

Picture make_leaded_window(int size, std::uint64_t seed) {
    const Noise noise(seed);
    const Random random(seed + 1);
    return paint(size, 3, [&](float u, float v) {
        const float x = u * 4.0f, y = v * 6.0f;
        const float across = x - std::floor(x), down = y - std::floor(y);
        const float lead = std::min(std::min(across, 1.0f - across), std::min(down, 1.0f - down));
        const auto pane = static_cast<std::uint64_t>(std::floor(x) + 4.0f * std::floor(y));
        const float glow = (0.75f + 0.25f * random.unit(pane, 0)) * (0.7f + 0.5f * noise.fractal(u, v, 3, 3));
        return gray_tint(glm::vec3(1.0f, 0.8f, 0.52f), lead < 0.06f ? 0.0f : glow);
    });
}

}  // namespace tarn::content
