// Frames at rest through the public surface: they converge, what moves starts over, and the error is what is
// left.
#include <gtest/gtest.h>

#include <cmath>

#include "gpu/library_floor.h"

namespace {

using tarn::test::TemporaryFolder;

constexpr int SIZE_PX = 24;

class LibraryRest : public testing::Test {
  protected:
    // A floor under an even sky and a lamp: what a frame takes from the sky is noise.
    LibraryRest() : scene_(load()), view_(engine_, scene_, SIZE_PX, SIZE_PX) {}

    tarn::Scene load() const {
        tarn::SceneOptions options;
        options.sky = 0.2f;
        return tarn::Scene::load(write_floor(folder_), options);
    }

    tarn::Picture draw(bool average, const tarn::Camera& camera = FROM_ABOVE) {
        tarn::Frame frame = frame_of(camera, number_++);
        frame.settings = tarn::Settings::preset("clean").fresh();
        frame.average = average;
        return view_.render(frame);
    }

    static double difference(const tarn::Picture& a, const tarn::Picture& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.rgb.size(); ++i)
            sum += std::pow(double(a.rgb[i]) - double(b.rgb[i]), 2);
        return std::sqrt(sum / double(a.rgb.size())) / mean(b);
    }

    TemporaryFolder folder_;
    tarn::Engine engine_;
    tarn::Scene scene_;
    tarn::View view_;
    std::uint32_t number_ = 0;
};

TEST_F(LibraryRest, ConvergesAndSaysWhatErrorIsLeft) {
    tarn::Picture few, many;
    for (int i = 0; i < 64; ++i) {
        many = draw(true);
        if (i == 15) few = many;
    }
    EXPECT_EQ(few.report.averaged_frames, 16u);
    EXPECT_EQ(many.report.averaged_frames, 64u);
    EXPECT_NEAR(few.report.relative_error / many.report.relative_error, 2.0, 0.4);
    tarn::Picture truth;
    for (int i = 0; i < 300; ++i) truth = draw(true);
    // Luminance and RGB, and the truth's own noise: not the same to the digit.
    EXPECT_NEAR(difference(many, truth) / many.report.relative_error, 1.0, 0.35);
}

TEST_F(LibraryRest, WhatMovesStartsOver) {
    for (int i = 0; i < 5; ++i) draw(true);
    EXPECT_EQ(draw(true).report.averaged_frames, 6u);
    const tarn::Camera aside = tarn::Camera::look_at({0.2, 1.5, 0.0}, {0.0, 0.0, 0.0}, 40.0);
    EXPECT_EQ(draw(true, aside).report.averaged_frames, 1u);
    EXPECT_EQ(draw(true, aside).report.averaged_frames, 2u);
    const tarn::Node lamp = scene_.lights().at(0);
    tarn::Light light = scene_.light(lamp);
    light.intensity.x *= 2.0;
    scene_.set_light(lamp, light);
    EXPECT_EQ(draw(true, aside).report.averaged_frames, 1u);
    EXPECT_EQ(draw(false, aside).report.averaged_frames, 1u);
    EXPECT_EQ(draw(true, aside).report.averaged_frames, 1u);
    ++number_;  // a frame is missing
    EXPECT_EQ(draw(true, aside).report.averaged_frames, 1u);
}

}  // namespace
