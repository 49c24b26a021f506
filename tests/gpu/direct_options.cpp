// What single settings of direct light do: several samples a pixel, the boiling filter; and that each does
// something.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "gl/program_library.h"
#include "gl/row_buffer.h"
#include "platform/context.h"
#include "renderer/renderer.h"
#include "shared/interface/bindings.h"
#include "shared/interface/constants/boiling_filter.h"
#include "shared/interface/frame_block.h"
#include "shared/math/reservoir.h"
#include "support/draws.h"
#include "support/test_scenes.h"

namespace tarn {
namespace {

constexpr int WIDTH_PX = 48;
constexpr int HEIGHT_PX = 27;

// Mean and variance of one picture, each averaged over all values.
struct Noise {
    double mean = 0.0;
    double variance = 0.0;
    double error = 0.0;  // standard error of the mean
};

Noise measure_noise(const RenderSettings& settings, std::vector<std::string> planted = {}) {
    constexpr int FRAMES = 128;
    const auto context = create_context({});
    const auto scene = test::load_test_scene(test::content_file("cornell"));
    Renderer renderer(scene->world, *scene->tracer, WIDTH_PX, HEIGHT_PX, std::move(planted));
    FrameInput input;
    input.camera = test::first_camera(*scene, double(WIDTH_PX) / HEIGHT_PX);
    input.settings = settings;
    std::vector<RunningMoments> values(3 * std::size_t(WIDTH_PX * HEIGHT_PX));
    RunningMoments means;
    for (input.frame = 0; input.frame < FRAMES; ++input.frame) {
        const Image image = renderer.read_radiance(renderer.render(input).radiance);
        RunningMoments picture;
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i].add(image.values[i]);
            picture.add(image.values[i]);
        }
        means.add(picture.mean());
    }
    RunningMoments variances;
    for (const RunningMoments& value : values) variances.add(value.variance());
    return {means.mean(), variances.mean(), std::sqrt(means.variance_of_mean())};
}

// Four samples a pixel have the mean of one and a quarter of its variance: they are independent.
void expect_quarter(RenderSettings settings) {
    const Noise one = measure_noise(settings);
    settings.direct.samples = 4;
    const Noise four = measure_noise(settings);
    EXPECT_NEAR(four.mean, one.mean, 4.0 * std::hypot(one.error, four.error));
    EXPECT_NEAR(four.variance / one.variance, 0.25, 0.02);
}

TEST(SamplesAPixel, OfOneLightAtRandomAreIndependent) {
    RenderSettings settings;
    settings.direct.mode = DirectMode::UNIFORM;
    expect_quarter(settings);
}

TEST(SamplesAPixel, OfSeveralCandidatesAreIndependent) {
    RenderSettings settings;
    settings.direct.candidates = 4;
    settings.direct.brdf_candidate = true;
    expect_quarter(settings);
}

TEST(SamplesAPixel, ForEachChannelAreIndependent) {
    RenderSettings settings;
    settings.direct.candidates = 4;
    settings.direct.per_channel = true;
    expect_quarter(settings);
}

TEST(SamplesAPixel, NegativeControlTheSameNumbersForEachAreFound) {
    RenderSettings settings;
    settings.direct.mode = DirectMode::UNIFORM;
    const Noise one = measure_noise(settings);
    settings.direct.samples = 4;
    const Noise four = measure_noise(settings, {"TARN_PLANT_SAME_SAMPLES"});
    EXPECT_GT(four.variance / one.variance, 0.9);
}

// ---- The boiling filter against a loop

struct Reservoirs {
    int width_px, height_px;
    std::vector<Reservoir> values;
};

// Weights over some decades, one in five empty.
Reservoirs draw_reservoirs(int width_px, int height_px) {
    test::Draws draws(5);
    Reservoirs reservoirs{width_px, height_px, {}};
    for (int i = 0; i < width_px * height_px; ++i) {
        Reservoir r = empty_reservoir();
        r.confidence = 8.0f;
        if (draws.uniform() < 0.8) {
            r.target = float(std::pow(10.0, draws.uniform(-3.0, 1.0)));
            r.contribution_weight = float(std::pow(10.0, draws.uniform(-1.0, 2.0)));
        }
        reservoirs.values.push_back(r);
    }
    return reservoirs;
}

std::vector<Reservoir> filter_on_gl(const Reservoirs& in, float limit) {
    std::vector<glm::uvec4> rows;
    for (const Reservoir& r : in.values) {
        glm::uvec4 row0, row1;
        pack_reservoir(r, glm::uvec3(INVALID_INDEX, 0u, 0u), row0, row1);
        rows.push_back(row0);
        rows.push_back(row1);
    }
    RowBuffer buffer("reservoirs", rows.size() * sizeof(glm::uvec4), BufferUse::DYNAMIC, GL_RGBA32UI);
    buffer.buffer().upload(0, std::span<const glm::uvec4>(rows));
    FrameBlock block{};
    block.frame_size = glm::uvec4(in.width_px, in.height_px, 0, 0);
    Buffer frame("frame", sizeof(FrameBlock), BufferUse::DYNAMIC);
    frame.upload(0, std::span<const FrameBlock>(&block, 1));
    frame.bind_uniform(BLOCK_FRAME);
    ProgramLibrary programs;
    const Program& program = programs.compute("direct/boiling_filter");
    const BoilingFilterConstants constants{limit};
    Buffer constants_buffer("constants", sizeof(glm::vec4), BufferUse::DYNAMIC);
    constants_buffer.upload(0, std::span<const BoilingFilterConstants>(&constants, 1));
    constants_buffer.bind_uniform(BLOCK_PASS);
    program.use();
    buffer.texture().bind(UNIT_PASS_A);
    buffer.buffer().bind_storage(0);
    glDispatchCompute(GLuint(in.width_px + 7) / 8, GLuint(in.height_px + 7) / 8, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    rows = buffer.buffer().download<glm::uvec4>();
    std::vector<Reservoir> out;
    for (std::size_t i = 0; i < in.values.size(); ++i)
        out.push_back(unpack_reservoir(rows[2 * i], rows[2 * i + 1]));
    return out;
}

// Mean weight of the block of 8 x 8 that holds (x, y), over reservoirs that hold a sample.
float block_mean(const Reservoirs& in, int x, int y) {
    float sum = 0.0f, count = 0.0f;
    for (int by = y / 8 * 8; by < std::min(y / 8 * 8 + 8, in.height_px); ++by) {
        for (int bx = x / 8 * 8; bx < std::min(x / 8 * 8 + 8, in.width_px); ++bx) {
            const Reservoir& r = in.values[std::size_t(by * in.width_px + bx)];
            sum += r.target * r.contribution_weight;
            count += r.contribution_weight > 0.0f ? 1.0f : 0.0f;
        }
    }
    return count > 0.0f ? sum / count : 0.0f;
}

TEST(BoilingFilter, DropsThoseThatOutweighTheirBlockAndNoOthers) {
    const auto context = create_context({});
    const Reservoirs in = draw_reservoirs(37, 21);  // blocks that the picture's edge cuts
    constexpr float LIMIT = 4.0f;
    const std::vector<Reservoir> out = filter_on_gl(in, LIMIT);
    int dropped = 0, wrong = 0;
    for (int y = 0; y < in.height_px; ++y) {
        for (int x = 0; x < in.width_px; ++x) {
            const std::size_t i = std::size_t(y * in.width_px + x);
            const Reservoir& r = in.values[i];
            const bool drops = r.target * r.contribution_weight > LIMIT * block_mean(in, x, y);
            dropped += drops;
            wrong += out[i].contribution_weight != (drops ? 0.0f : r.contribution_weight);
            wrong += out[i].confidence != r.confidence || out[i].target != r.target;
        }
    }
    EXPECT_GT(dropped, 10);
    EXPECT_EQ(wrong, 0);
}

// ---- Every setting
// ---------------------------------------------------------------------------------------------------

// Puts the last thing of the scene where it was, or to the side.
void shift_last(test::TestScene& scene, double by_m) {
    Node& node = at(scene.scene.nodes, scene.scene.instances.back().node);
    if (node.matrix) {
        (*node.matrix)[3].x += by_m;
    } else {
        node.local.translation.x += by_m;
    }
    ++scene.scene.revision;
    update_world(scene.world, scene.scene, 0.0);
    scene.tracer->update(scene.world);
}

// The last of some frames: camera and scene stand still, then the camera walks and a thing has moved.
Image render_walk(test::TestScene& scene, const RenderSettings& settings) {
    constexpr double SHIFT_M = 0.05;
    Renderer renderer(scene.world, *scene.tracer, WIDTH_PX, HEIGHT_PX);
    FrameInput input;
    input.camera = test::first_camera(scene, double(WIDTH_PX) / HEIGHT_PX);
    input.settings = settings;
    Image last;
    for (input.frame = 0; input.frame < 6; ++input.frame) {
        if (input.frame >= 3) input.camera.position += 0.03f * input.camera.right;
        if (input.frame == 3) {
            shift_last(scene, SHIFT_M);
            renderer.update();
        }
        last = renderer.read_radiance(renderer.render(input).radiance);
    }
    shift_last(scene, -SHIFT_M);
    return last;
}

// Some values of a number, all choices of a choice.
std::vector<double> list_values(const Setting& setting) {
    // 0 often means "never": the next number is the least that does something.
    if (setting.choices.empty()) {
        return {setting.minimum, setting.minimum + 1.0, std::min(setting.maximum, 40.0)};
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < setting.choices.size(); ++i) values.push_back(double(i));
    return values;
}

// A setting that is lost on its way from the table to the shader is one that no value of it shows.
TEST(Settings, EachOneChangesThePictureWhereItApplies) {
    const auto context = create_context({});
    const auto scene = test::load_test_scene(test::content_file("cornell"));
    std::vector<RenderSettings> bases(1);
    for (const char* preset : {"balanced", "unbiased"}) bases.push_back(find_preset(preset).settings);
    for (const bool traces_in_weights : {false, true}) {
        IndirectSettings& indirect = bases.emplace_back().indirect;
        indirect.mode = IndirectMode::RESTIR;
        indirect.reuse.mis_visibility = traces_in_weights;
    }
    bases.emplace_back().denoise.mode = DenoiseMode::SVGF;
    bases.emplace_back().antialias.mode = AntialiasMode::TAA;
    std::vector<Image> pictures;
    for (const RenderSettings& base : bases) pictures.push_back(render_walk(*scene, base));
    for (const Setting& setting : setting_table()) {
        // Whoever finds what pixels see finds the same: tests/gpu/raster_against_rays.cpp.
        if (setting.name == "primary") continue;
        bool shows = false;
        for (std::size_t b = 0; b < bases.size() && !shows; ++b) {
            if (setting.applies && !setting.applies(bases[b])) continue;
            for (const double value : list_values(setting)) {
                RenderSettings changed = bases[b];
                setting.set(changed, value);
                if (render_walk(*scene, changed).values != pictures[b].values) {
                    shows = true;
                    break;
                }
            }
        }
        EXPECT_TRUE(shows) << "--" << setting.name << " changes nothing";
    }
}

}  // namespace
}  // namespace tarn
