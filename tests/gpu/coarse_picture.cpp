// Indirect light on a coarse picture: which pixels it takes, the rays through them, and how its light reaches
// the pixels around them.
#include "passes/indirect/coarse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "gpu/pass_context.h"
#include "shared/math/packing.h"
#include "support/draws.h"

namespace tarn {
namespace {

using namespace test;

// One that divides, primes, and the least.
constexpr glm::ivec2 SIZES_PX[] = {{16, 8}, {13, 7}, {31, 2}, {1, 1}, {1, 5}};

// What a pixel shows: enough of a surface for the weights.
struct Shown {
    glm::vec3 position;
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    float albedo = 0.5f;
    float alpha = 0.5f;
    float f0 = 0.04f;
    bool lit = true;
};

using Scene = std::function<Shown(const glm::ivec2& pixel)>;
using LightOf = std::function<float(const glm::ivec2& pixel)>;

// A wall before the camera, which looks along -z: a pixel is a centimetre.
Shown show_wall(const glm::ivec2& pixel, float distance_m = 5.0f) {
    return {{0.01f * float(pixel.x), -0.01f * float(pixel.y), -distance_m}};
}

glm::ivec2 taken_pixel(const glm::ivec2& coarse, int step_px, const glm::uvec2& offset,
                       const glm::ivec2& size_px) {
    return glm::min(coarse * step_px + glm::ivec2(offset), size_px - 1);
}

struct Case {
    glm::ivec2 size_px;
    int step_px;
    std::uint32_t frame;
};

void for_each_case(const std::function<void(const Case&)>& check) {
    for (const glm::ivec2& size_px : SIZES_PX) {
        for (const int step_px : {2, 4}) {
            for (std::uint32_t frame = 0; frame < std::uint32_t(step_px * step_px); ++frame) {
                SCOPED_TRACE(testing::Message() << size_px.x << " x " << size_px.y << ", step " << step_px
                                                << ", frame " << frame);
                check({size_px, step_px, frame});
            }
        }
    }
}

class CoarsePicture : public testing::Test {
  protected:
    // Light of the picture, base and layer in x and y, out of light that only the taken pixels know.
    std::vector<glm::vec2> upsample_light(const Case& c, const Scene& scene, const LightOf& light,
                                          const Defines& planted = {}) {
        context_.plant(planted);
        context_.recorder().begin();
        const GBuffer gbuffer = write_surfaces(c.size_px, scene);
        bind_block(c);
        const glm::ivec2 coarse_px = coarse_size_px(c.size_px, c.step_px);
        const FrameContext coarse = context_.frame(coarse_px, c.size_px);
        coarse_ = std::make_shared<SurfaceTable>(coarse_px, BufferUse::DYNAMIC);
        thin_surfaces(coarse, gbuffer, *coarse_);
        std::vector<glm::vec4> diffuse, specular;
        for (int y = 0; y < coarse_px.y; ++y) {
            for (int x = 0; x < coarse_px.x; ++x) {
                const float value =
                    light(taken_pixel({x, y}, c.step_px, pick_offset(c.frame, c.step_px), c.size_px));
                diffuse.emplace_back(value);
                specular.emplace_back(2.0f * value);
            }
        }
        const ReflectedLight given{context_.write_picture("test/diffuse", coarse_px, GL_RGBA32F, diffuse),
                                   context_.write_picture("test/specular", coarse_px, GL_RGBA32F, specular)};
        const FrameContext full = context_.frame(c.size_px, c.size_px);
        const ReflectedLight found = upsample(full, gbuffer, *coarse_, given);
        context_.recorder().end();
        return join(found);
    }

    std::uint32_t gaps() const { return context_.counters().download<std::uint32_t>()[COUNTER_COARSE_GAP]; }

    PassContext context_;
    Surfaces coarse_;  // of the latest run

  private:
    GBuffer write_surfaces(const glm::ivec2& size_px, const Scene& scene) {
        std::vector<glm::vec4> layers[4];
        for (int y = 0; y < size_px.y; ++y) {
            for (int x = 0; x < size_px.x; ++x) {
                const Shown s = scene({x, y});
                const glm::vec2 normal = encode_octahedral(s.normal);
                layers[0].emplace_back(s.position, s.lit ? 1e-6f : -1.0f);
                layers[1].emplace_back(normal, normal);
                layers[2].emplace_back(glm::vec3(s.albedo), s.alpha);
                layers[3].emplace_back(glm::vec3(s.f0), s.f0 > 0.0f ? 1.0f : 0.0f);
            }
        }
        const Surfaces surfaces = std::make_shared<SurfaceTable>(size_px, BufferUse::DYNAMIC);
        for (std::size_t layer = 0; layer < 4; ++layer) surfaces->upload(int(layer), layers[layer]);
        context_.recorder().pass("test/write").write_image(0, surfaces->texels());
        return {nullptr, surfaces, std::nullopt};
    }

    void bind_block(const Case& c) {
        FrameBlock full{};
        full.frame_camera_forward = glm::vec4(0.0f, 0.0f, -1.0f, 0.0f);
        full.frame_size = glm::uvec4(c.size_px, c.frame, 0u);
        full.frame_full = glm::uvec4(c.size_px, 1u, 0u);
        const FrameBlock block = make_coarse_block(full, c.step_px);
        block_.upload(0, std::span<const FrameBlock>(&block, 1));
        context_.recorder().bind_frame_block(block_);
    }

    static std::vector<glm::vec2> join(const ReflectedLight& light) {
        const auto diffuse = light.diffuse->download<glm::vec4>();
        const auto specular = light.specular->download<glm::vec4>();
        std::vector<glm::vec2> result;
        for (std::size_t i = 0; i < diffuse.size(); ++i) result.emplace_back(diffuse[i].x, specular[i].x);
        return result;
    }

    Buffer block_{"test/block", sizeof(FrameBlock), BufferUse::DYNAMIC};
};

TEST(CoarseOffsets, EveryPixelOfABlockHasItsTurn) {
    for (const int step_px : {1, 2, 4}) {
        const std::uint32_t cycle = std::uint32_t(step_px * step_px);
        for (const std::uint32_t first : {0u, 3u, 1000u}) {
            std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
            for (std::uint32_t frame = first; frame < first + cycle; ++frame) {
                const glm::uvec2 offset = pick_offset(frame, step_px);
                EXPECT_LT(std::max(offset.x, offset.y), std::uint32_t(step_px));
                seen.emplace(offset.x, offset.y);
            }
            EXPECT_EQ(seen.size(), cycle) << "step " << step_px << " from frame " << first;
        }
    }
}

TEST_F(CoarsePicture, EachOfItsSurfacesIsThatOfOnePixel) {
    for_each_case([&](const Case& c) {
        upsample_light(
            c, [](const glm::ivec2& p) { return show_wall(p); }, [](const glm::ivec2&) { return 1.0f; });
        const auto positions = coarse_->download(LAYER_POSITION);
        const glm::ivec2 coarse_px = coarse_size_px(c.size_px, c.step_px);
        ASSERT_EQ(positions.size(), std::size_t(coarse_px.x * coarse_px.y));
        for (int i = 0; i < int(positions.size()); ++i) {
            const glm::ivec2 coarse(i % coarse_px.x, i / coarse_px.x);
            const glm::ivec2 pixel =
                taken_pixel(coarse, c.step_px, pick_offset(c.frame, c.step_px), c.size_px);
            EXPECT_EQ(glm::vec3(positions[std::size_t(i)]), show_wall(pixel).position) << i;
        }
    });
}

// A wall that is not quite even: the weights are no bilinear ones.
Shown show_rough_wall(const glm::ivec2& pixel) {
    Draws draws(std::uint32_t(1000 * pixel.y + pixel.x));
    Shown shown = show_wall(pixel);
    const glm::vec2 tilt(draws.uniform(-0.3, 0.3), draws.uniform(-0.3, 0.3));
    shown.normal = glm::normalize(glm::vec3(tilt, 1.0f));
    shown.position.z += float(draws.uniform(-0.02, 0.02));
    return shown;
}

float greatest_error(const std::vector<glm::vec2>& light, float expected) {
    float error = 0.0f;
    for (const glm::vec2& value : light) {
        error = std::max({error, std::abs(value.x - expected), std::abs(value.y - 2.0f * expected)});
    }
    return error;
}

TEST_F(CoarsePicture, EvenLightStaysWhatItIs) {
    const LightOf even = [](const glm::ivec2&) { return 3.0f; };
    for_each_case([&](const Case& c) {
        EXPECT_LT(greatest_error(upsample_light(c, show_rough_wall, even), 3.0f), 1e-5f);
    });
    EXPECT_EQ(gaps(), 0u);
}

TEST_F(CoarsePicture, WeightsThatAreNotDividedByTheirSumAreFound) {
    const LightOf even = [](const glm::ivec2&) { return 3.0f; };
    const auto light =
        upsample_light({{13, 7}, 2, 0}, show_rough_wall, even, {"TARN_PLANT_DROP_UPSAMPLE_NORMALIZATION"});
    EXPECT_GT(greatest_error(light, 3.0f), 0.1f);
}

// Between the outermost of the taken pixels; beyond them nothing is known.
TEST_F(CoarsePicture, LightThatGrowsEvenlyIsFoundAtTheTruePlaces) {
    const LightOf ramp = [](const glm::ivec2& p) { return 1.0f + float(p.x) + 0.5f * float(p.y); };
    for_each_case([&](const Case& c) {
        const auto light = upsample_light(
            c, [](const glm::ivec2& p) { return show_wall(p); }, ramp);
        const glm::ivec2 first = glm::min(glm::ivec2(pick_offset(c.frame, c.step_px)), c.size_px - 1);
        const glm::ivec2 last = taken_pixel(coarse_size_px(c.size_px, c.step_px) - 1, c.step_px,
                                            pick_offset(c.frame, c.step_px), c.size_px);
        for (int y = 0; y < c.size_px.y; ++y) {
            for (int x = 0; x < c.size_px.x; ++x) {
                const glm::ivec2 known = glm::clamp(glm::ivec2(x, y), first, last);
                EXPECT_NEAR(light[std::size_t(y * c.size_px.x + x)].x, ramp(known), 1e-4f) << x << ", " << y;
            }
        }
    });
}

// ---- Silhouettes

// A ragged edge: the column moves from row to row.
bool is_beyond(const glm::ivec2& pixel) {
    return pixel.x + pixel.y / 2 > 8;
}

// Each pixel has the light of its own side alone.
void expect_no_leak(const std::vector<glm::vec2>& light, int width_px) {
    for (int i = 0; i < int(light.size()); ++i) {
        const float expected = is_beyond({i % width_px, i / width_px}) ? 0.0f : 1.0f;
        EXPECT_NEAR(light[std::size_t(i)].x, expected, 1e-6f) << i % width_px << ", " << i / width_px;
        EXPECT_NEAR(light[std::size_t(i)].y, 2.0f * expected, 1e-6f) << i % width_px << ", " << i / width_px;
    }
}

TEST_F(CoarsePicture, NoLightCrossesASilhouette) {
    const LightOf one_side = [](const glm::ivec2& p) { return is_beyond(p) ? 0.0f : 1.0f; };
    const Scene corner = [](const glm::ivec2& p) {
        Shown shown = show_wall(p);
        if (is_beyond(p)) shown.normal = glm::vec3(-1.0f, 0.0f, 0.0f);
        return shown;
    };
    const Scene step = [](const glm::ivec2& p) { return show_wall(p, is_beyond(p) ? 6.0f : 5.0f); };
    for (const int step_px : {2, 4}) {
        for (std::uint32_t frame = 0; frame < std::uint32_t(step_px * step_px); ++frame) {
            SCOPED_TRACE(testing::Message() << "step " << step_px << ", frame " << frame);
            const Case c{{23, 13}, step_px, frame};
            expect_no_leak(upsample_light(c, corner, one_side), c.size_px.x);
            expect_no_leak(upsample_light(c, step, one_side), c.size_px.x);
        }
    }
    EXPECT_EQ(gaps(), 0u);
}

// Where a base reflects nothing, its light says nothing: the pixels of a chequered floor must not mix.
TEST_F(CoarsePicture, BlackBasesDoNotLendTheirLight) {
    const auto is_black = [](const glm::ivec2& p) { return (p.x + p.y) % 3 == 0; };
    const Scene chequered = [&](const glm::ivec2& p) {
        Shown shown = show_wall(p);
        if (is_black(p)) shown.albedo = 0.0f;
        return shown;
    };
    const LightOf light = [&](const glm::ivec2& p) { return is_black(p) ? 100.0f : 1.0f; };
    const Case c{{23, 13}, 2, 1};
    const auto found = upsample_light(c, chequered, light);
    for (int i = 0; i < int(found.size()); ++i) {
        if (!is_black({i % c.size_px.x, i / c.size_px.x})) {
            EXPECT_NEAR(found[std::size_t(i)].x, 1.0f, 1e-5f) << i;
        }
    }
}

TEST_F(CoarsePicture, APixelThatNoneIsLikeTakesTheNearestsLightAndIsCounted) {
    const glm::ivec2 alone(5, 3);
    const Scene post = [&](const glm::ivec2& p) { return show_wall(p, p == alone ? 2.0f : 5.0f); };
    const LightOf by_column = [](const glm::ivec2& p) { return float(p.x); };
    const Case c{{16, 8}, 4, 0};  // takes every fourth pixel
    const auto light = upsample_light(c, post, by_column);
    EXPECT_EQ(light[std::size_t(alone.y * c.size_px.x + alone.x)].x, 4.0f);
    EXPECT_EQ(gaps(), 1u);
}

// Whatever is not lit is nearest nowhere.
TEST_F(CoarsePicture, WithoutAnyLitPixelAroundAPixelStaysBlack) {
    const glm::ivec2 alone(5, 3);
    const Scene star = [&](const glm::ivec2& p) {
        Shown shown = show_wall(p);
        shown.lit = p == alone;
        return shown;
    };
    const LightOf even = [](const glm::ivec2&) { return 1.0f; };
    EXPECT_EQ(greatest_error(upsample_light({{16, 8}, 2, 0}, star, even), 0.0f), 0.0f);
    EXPECT_EQ(gaps(), 1u);
}

TEST_F(CoarsePicture, WhatIsNotLitGivesAndTakesNothing) {
    const auto is_sky = [](const glm::ivec2& p) { return p.y < 4; };
    const Scene horizon = [&](const glm::ivec2& p) {
        Shown shown = show_wall(p);
        shown.lit = !is_sky(p);
        return shown;
    };
    const LightOf light = [&](const glm::ivec2& p) { return is_sky(p) ? 100.0f : 1.0f; };
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        const Case c{{13, 11}, 2, frame};
        const auto found = upsample_light(c, horizon, light);
        for (int i = 0; i < int(found.size()); ++i) {
            EXPECT_NEAR(found[std::size_t(i)].x, is_sky({0, i / c.size_px.x}) ? 0.0f : 1.0f, 1e-6f) << i;
        }
    }
    EXPECT_EQ(gaps(), 0u);
}

}  // namespace
}  // namespace tarn
