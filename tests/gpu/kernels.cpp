// Shared functions in a compute shader against the same text compiled as C++, over tables of random and odd
// inputs.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/shader_folder.h"
#include "gpu/shaders/kernels.h"
#include "platform/context.h"
#include "support/draws.h"

namespace tarn {
namespace {

using test::Draws;

constexpr int ITEM_COUNT = 16'384;
constexpr int GROUP_SIZE = 64;

struct Item {
    uvec4 rows[4];
};

using Make = std::function<Item(Draws&, int)>;

// Random numbers in [0, 1) and random words.
Item random_unit_square(Draws& draws, int) {
    Item item;
    for (uvec4& row : item.rows) row = pack_row(draws.uniform_vec3(), draws.bits());
    return item;
}

Item random_words(Draws& draws, int) {
    Item item;
    for (uvec4& row : item.rows) row = uvec4(draws.bits(), draws.bits(), draws.bits(), draws.bits());
    return item;
}

// Unit vectors and random words.
Item random_directions(Draws& draws, int) {
    Item item;
    for (uvec4& row : item.rows) row = pack_row(draws.unit_vector(), draws.bits());
    return item;
}

class Kernels : public testing::Test {
  protected:
    Kernels() {
        const std::filesystem::path source = TARN_SOURCE_DIR;
        std::filesystem::create_directory_symlink(source / "shaders" / "shared", folder_.root() / "shared");
        std::filesystem::create_directory_symlink(source / "tests" / "gpu", folder_.root() / "gpu");
        const ShaderStage stage{GL_COMPUTE_SHADER,
                                load_shader_source(folder_.root(), "gpu/shaders/kernels.comp", {})};
        program_ = std::make_unique<Program>("kernels", std::span(&stage, 1));
    }

    std::vector<uvec4> run_on_gl(uint kernel, const std::vector<Item>& items) const {
        const Buffer inputs = Buffer::from("kernel inputs", items);
        const Buffer outputs("kernel outputs", items.size() * sizeof(uvec4), BufferUse::DEVICE);
        inputs.bind_storage(0);
        outputs.bind_storage(1);
        program_->set("kernel", kernel);
        program_->use();
        glDispatchCompute(GLuint(items.size()) / GROUP_SIZE, 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        return outputs.download<uvec4>();
    }

    // Calls check(item, GL's row, C++'s row) for each input.
    template <class Check>
    void compare(uint kernel, const Make& make, const Check& check) const {
        Draws draws(kernel + 1u);
        std::vector<Item> items;
        for (int i = 0; i < ITEM_COUNT; ++i) items.push_back(make(draws, i));
        const std::vector<uvec4> on_gl = run_on_gl(kernel, items);
        for (std::size_t i = 0; i < items.size() && !HasFailure(); ++i) {
            const uvec4* rows = items[i].rows;
            check(items[i], on_gl[i], run_kernel(kernel, rows[0], rows[1], rows[2], rows[3]));
        }
    }

    void expect_same_bits(uint kernel, const Make& make) const {
        compare(kernel, make, [](const Item&, const uvec4& gl, const uvec4& cpp) { ASSERT_EQ(gl, cpp); });
    }

    // |gl - cpp| <= absolute + relative |cpp|, in all four words.
    void expect_near(uint kernel, const Make& make, double absolute, double relative = 0.0) const {
        compare(kernel, make, [&](const Item&, const uvec4& gl, const uvec4& cpp) {
            for (int c = 0; c < 4; ++c) {
                const double expected = uintBitsToFloat(cpp[c]);
                ASSERT_NEAR(uintBitsToFloat(gl[c]), expected, absolute + relative * std::abs(expected)) << c;
            }
        });
    }

  private:
    std::unique_ptr<Context> context_ = create_context({});
    ShaderFolder folder_;
    std::unique_ptr<Program> program_;
};

// ---- The same bits
// ------------------------------------------------------------------------------------------------

TEST_F(Kernels, RandomNumbersAreTheSameBits) {
    expect_same_bits(KERNEL_HASH, random_words);
    expect_same_bits(KERNEL_RANDOM, random_words);
    expect_same_bits(KERNEL_INTEGERS, random_words);
    expect_same_bits(KERNEL_BLUE_NOISE, random_words);
}

TEST_F(Kernels, RecordsAndAliasDrawsAreTheSameBits) {
    expect_same_bits(KERNEL_LIGHT_RECORD, random_directions);
    expect_same_bits(KERNEL_ALIAS, random_unit_square);
}

// uv over several periods with odd values among them, all wrap modes, both filters.
Item texture_coordinates(Draws& draws, int i) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float odd[] = {nan, std::numeric_limits<float>::infinity(), -1e30f, 0.0f, -0.0f, 1.0f, -1.0f, 1e7f};
    const float u = i % 8 == 0 ? odd[draws.bits() % 8] : float(draws.uniform(-3.0, 3.0));
    const float v = i % 8 == 1 ? odd[draws.bits() % 8] : float(draws.uniform(-300.0, 300.0));
    Item item{};
    item.rows[0] = uvec4(floatBitsToUint(u), floatBitsToUint(v), draws.bits() % 2u, 0u);
    item.rows[1] =
        uvec4(1u + draws.bits() % 700u, 1u + draws.bits() % 300u, draws.bits() % 3u, draws.bits() % 3u);
    return item;
}

TEST_F(Kernels, TexelsAndTheirWeightsAreTheSameBitsNanIncluded) {
    expect_same_bits(KERNEL_FOOTPRINT_INDICES, texture_coordinates);
    expect_same_bits(KERNEL_FOOTPRINT_WEIGHTS, texture_coordinates);
}

// Weights of three candidates, some 0, negative, NaN or infinite.
Item candidate_weights(Draws& draws, int) {
    const float odd[] = {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::infinity()};
    Item item = random_unit_square(draws, 0);
    for (int c = 0; c < 3; ++c) {
        const uint choice = draws.bits() % 16u;
        if (choice < 4u) item.rows[0][c] = floatBitsToUint(odd[choice]);
    }
    return item;
}

TEST_F(Kernels, ReservoirsChooseTheSameAndAgreeOnTheirWeight) {
    compare(KERNEL_RESERVOIR, candidate_weights, [](const Item&, const uvec4& gl, const uvec4& cpp) {
        ASSERT_EQ(gl.x, cpp.x);
        ASSERT_EQ(gl.y, cpp.y);
        ASSERT_EQ(gl.z, cpp.z);
        // A driver's division may differ in the last bit.
        const float expected = uintBitsToFloat(cpp.w);
        ASSERT_NEAR(uintBitsToFloat(gl.w), expected, 2.5e-7f * expected);
    });
}

// ---- The same up to rounding: drivers differ in square roots, divisions and angles
// -----------------------------------

TEST_F(Kernels, OctahedralDirectionsAndFramesAgree) {
    expect_near(KERNEL_OCTAHEDRAL, random_directions, 5e-7);
    expect_near(KERNEL_FRAME, random_directions, 2e-6);
}

TEST_F(Kernels, LightsAgree) {
    // The cosine at a light seen nearly edge-on is a difference of products of order 1.
    expect_near(KERNEL_TRIANGLE_LIGHT, random_directions, 1e-5, 1e-4);
    expect_near(KERNEL_PUNCTUAL_LIGHT, random_directions, 1e-5, 1e-4);
}

TEST_F(Kernels, CameraRaysAgree) {
    // Forward, right and up are random here, so that their sum may nearly vanish before it is made unit.
    expect_near(KERNEL_CAMERA_RAY, random_directions, 1e-4);
}

// View and light above the surface, alpha from narrow to wide.
Item brdf_inputs(Draws& draws, int i) {
    Item item = random_unit_square(draws, i);
    const vec3 view = sample_cosine_hemisphere(draws.uniform_vec2());
    item.rows[0] = pack_row(view, 0u);
    item.rows[2].x = floatBitsToUint(float(std::pow(10.0, draws.uniform(-2.0, 0.0))));
    const vec3 light = i % 2 == 0 ? sample_cosine_hemisphere(draws.uniform_vec2())
                                  : sample_brdf(kernel_material(item.rows[2]), view, draws.uniform_vec3());
    item.rows[1] = pack_row(light, 0u);
    return item;
}

TEST_F(Kernels, BrdfAndItsPdfAgree) {
    // A half vector is rounded to 1e-7, which is 1e-5 of the width of the narrowest highlight here and counts
    // fourfold; grazing pairs lose two more digits.
    expect_near(KERNEL_BRDF, brdf_inputs, 1e-6, 2e-3);
}

TEST_F(Kernels, PartsOfTheBrdfAndAlbedosOfItsLayerAgree) {
    expect_near(KERNEL_BRDF_PARTS, brdf_inputs, 1e-6, 2e-3);
}

TEST_F(Kernels, BrdfSamplesAgree) {
    expect_near(KERNEL_BRDF_SAMPLE, brdf_inputs, 1e-4);
}

TEST_F(Kernels, DirectionsAndCoordinatesOfTheSkyAgree) {
    // llvmpipe's sine and arc tangent are good to about 1e-6.
    expect_near(KERNEL_SKY_DIRECTION, random_unit_square, 5e-6);
    expect_near(KERNEL_SKY_UV, random_directions, 5e-6);
}

}  // namespace
}  // namespace tarn
