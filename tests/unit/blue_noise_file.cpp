// The loader of the blue noise mask: what is wrong with a file is said in one line that names it.
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "noise/blue_noise.h"
#include "noise/mask_format.h"
#include "support/process.h"

namespace tarn::test {
namespace {

std::string built_file() {
    return std::string(TARN_BUILD_DIR) + "/noise/" + BLUE_NOISE_FILE;
}

class BlueNoiseFile : public testing::Test {
  protected:
    void TearDown() override { unsetenv("TARN_NOISE_DIR"); }

    // Writes `bytes`; the loader must refuse them with one line that names the file and says `text`.
    void expect_refusal(const std::string& bytes, const std::string& text) {
        std::ofstream(file_, std::ios::binary) << bytes;
        try {
            load_blue_noise(file_);
            ADD_FAILURE() << "loaded; expected: " << text;
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.find(file_), 0u) << message;
            EXPECT_NE(message.find(text), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }

    // The good file with one byte replaced.
    std::string with_byte(std::size_t place, char byte) const {
        std::string changed = good_;
        changed[place] = byte;
        return changed;
    }

    TemporaryFolder folder_;
    std::string file_ = folder_.file("mask.bin");
    const std::string good_ = read_text(built_file());
};

TEST_F(BlueNoiseFile, TheFirstTexelsAreTheFilesFirstBytes) {
    const BlueNoiseMask mask = load_blue_noise(built_file());
    ASSERT_EQ(mask.texels.size(), BLUE_NOISE_TEXEL_COUNT);
    for (std::size_t texel : {0u, 1u, BLUE_NOISE_TEXEL_COUNT - 1u}) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(good_.data()) + 32 + 4 * texel;
        EXPECT_EQ(mask.texels[texel], bytes[0] + 256u * bytes[1] + 65536u * bytes[2] + 16777216u * bytes[3]);
    }
}

TEST_F(BlueNoiseFile, IsFoundWhereTheVariableSays) {
    EXPECT_EQ(load_blue_noise().texels, load_blue_noise(built_file()).texels);
    setenv("TARN_NOISE_DIR", folder_.path().c_str(), 1);
    try {
        load_blue_noise();
        FAIL() << "found";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(folder_.path()), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("TARN_NOISE_DIR"), std::string::npos) << error.what();
    }
    std::filesystem::copy_file(built_file(), folder_.path() / BLUE_NOISE_FILE);
    EXPECT_EQ(load_blue_noise().texels.size(), BLUE_NOISE_TEXEL_COUNT);
}

TEST_F(BlueNoiseFile, OfAnotherLengthIsRefused) {
    expect_refusal("", "0 bytes, the header of a blue noise mask has 32");
    expect_refusal(good_.substr(0, 31), "31 bytes");
    expect_refusal(good_.substr(0, good_.size() - 1), "524319 bytes, a mask of this size has 524320");
    expect_refusal(good_ + "x", "524321 bytes");
}

TEST_F(BlueNoiseFile, OfAnotherKindVersionOrSizeIsRefused) {
    expect_refusal(with_byte(0, 'X'), "TARNMASK");
    expect_refusal(with_byte(7, 'X'), "TARNMASK");
    expect_refusal(with_byte(8, 2), "version is 2, this program reads 1");
    expect_refusal(with_byte(12, 32), "32 x 64 x 32 with 2 channels, 64 x 64 x 32 with 2 are needed");
    expect_refusal(with_byte(16, 32), "64 x 32 x 32");
    expect_refusal(with_byte(20, 64), "64 x 64 x 64");
    expect_refusal(with_byte(24, 1), "with 1 channels");
}

TEST_F(BlueNoiseFile, ThatIsDamagedIsRefused) {
    for (const std::size_t place : {std::size_t(32), std::size_t(100'001), good_.size() - 1})
        expect_refusal(with_byte(place, char(good_[place] ^ 0x10)), "damaged");
    expect_refusal(with_byte(28, char(good_[28] ^ 1)), "checksum");
}

TEST_F(BlueNoiseFile, ThatIsMissingOrAFolderIsRefused) {
    EXPECT_THROW(load_blue_noise(folder_.file("none.bin")), Error);
    EXPECT_THROW(load_blue_noise(folder_.path()), Error);
}

}  // namespace
}  // namespace tarn::test
