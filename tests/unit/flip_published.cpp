// FLIP against the values that its authors publish for the image pair of their own repository (NVlabs/flip,
// src/tests/test.py, versions 1.2 on): images/reference and images/test, .png for LDR, .exr for HDR. The
// images are not ours to copy: the test reads them from TARN_FLIP_IMAGES, a checkout's `images` folder, and
// is skipped without it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "image_io/image_io.h"
#include "metrics/flip.h"

namespace tarn {
namespace {

constexpr double TOLERANCE = 1e-4;

class PublishedFlip : public testing::Test {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("TARN_FLIP_IMAGES");
        if (folder == nullptr) {
            GTEST_SKIP() << "TARN_FLIP_IMAGES names no folder with the images of github.com/NVlabs/flip";
        }
        folder_ = folder;
    }

    std::filesystem::path folder_;
};

TEST_F(PublishedFlip, ldr_mean) {
    const Image reference = read_png(folder_ / "reference.png"), image = read_png(folder_ / "test.png");
    EXPECT_NEAR(mean_error(compute_ldr_flip(reference, image)), 0.159691, TOLERANCE);
}

TEST_F(PublishedFlip, hdr_mean_and_exposures) {
    const HdrFlip flip =
        compute_hdr_flip(read_radiance(folder_ / "reference.exr"), read_radiance(folder_ / "test.exr"));
    EXPECT_NEAR(flip.start_exposure_ev, -12.5423, TOLERANCE);
    EXPECT_NEAR(flip.stop_exposure_ev, 0.9427, TOLERANCE);
    EXPECT_EQ(flip.exposure_count, 14);
    EXPECT_NEAR(mean_error(flip.map), 0.283478, TOLERANCE);
}

}  // namespace
}  // namespace tarn
