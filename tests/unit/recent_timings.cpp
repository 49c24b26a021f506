// Medians of the last frames, by hand.
#include "game/recent_timings.h"

#include <gtest/gtest.h>

namespace game {
namespace {

FrameReport frame_of(double frame_ms, std::vector<PassTime> passes) {
    FrameReport report;
    report.frame_ms = frame_ms;
    report.passes = std::move(passes);
    return report;
}

TEST(RecentTimings, AreNothingWithoutFrames) {
    EXPECT_EQ(RecentTimings().compute_medians().frame_ms, 0.0);
    EXPECT_TRUE(RecentTimings().compute_medians().passes.empty());
}

TEST(RecentTimings, AreMediansAndNoMeans) {
    RecentTimings timings;
    for (const double ms : {5.0, 1000.0, 1.0}) timings.add(frame_of(ms, {{"raster", 2.0 * ms}}));
    EXPECT_EQ(timings.compute_medians().frame_ms, 5.0);
    EXPECT_EQ(timings.compute_medians().passes.at(0).ms, 10.0);
    timings.add(frame_of(7.0, {{"raster", 14.0}}));
    EXPECT_EQ(timings.compute_medians().frame_ms, 6.0);  // between the two in the middle
    EXPECT_EQ(timings.compute_medians().passes.at(0).ms, 12.0);
}

TEST(RecentTimings, ForgetWhatIsOld) {
    RecentTimings timings(2);
    for (const double ms : {100.0, 100.0, 100.0, 3.0, 3.0}) timings.add(frame_of(ms, {}));
    EXPECT_EQ(timings.compute_medians().frame_ms, 3.0);
    timings.clear();
    EXPECT_EQ(timings.compute_medians().frame_ms, 0.0);
}

TEST(RecentTimings, APassCountsInTheFramesInWhichItRan) {
    RecentTimings timings;
    timings.add(frame_of(1.0, {{"raster", 1.0}, {"shade", 4.0}}));
    timings.add(frame_of(1.0, {{"raster", 1.0}, {"rays", 8.0, true}, {"shade", 6.0}}));
    timings.add(frame_of(1.0, {{"raster", 1.0}, {"rays", 2.0, true}, {"shade", 5.0}}));
    const FrameCost medians = timings.compute_medians();
    ASSERT_EQ(medians.passes.size(), 3u);
    EXPECT_EQ(medians.passes[0].name, "raster");
    EXPECT_EQ(medians.passes[1].name, "shade");
    EXPECT_EQ(medians.passes[1].ms, 5.0);
    EXPECT_EQ(medians.passes[2].name, "rays");  // it ran last for the first time
    EXPECT_EQ(medians.passes[2].ms, 5.0);
    EXPECT_EQ(medians.compute_tracing_ms(), 5.0);
}

}  // namespace
}  // namespace game
