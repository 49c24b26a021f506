// The lantern court, played as it is meant: across the court, up the stair, a dead lantern lit.
#include <gtest/gtest.h>
#include <tarn/scene.h>

#include "support/play_guide.h"

namespace {

using tarn::test::Guide;

TEST(LanternCourt, ItsStairLeadsToADeadLanternThatCanBeLit) {
    const game::Level level =
        game::make_level(game::Scene::load(TARN_BUILD_DIR "/content/lantern_court.glb"));
    game::Simulation simulation(level);
    Guide guide(simulation);
    ASSERT_TRUE(climb_to_the_gallery(guide))
        << simulation.state().player.feet.x << ", " << simulation.state().player.feet.y << ", "
        << simulation.state().player.feet.z;
    EXPECT_NEAR(simulation.state().player.feet.y, 4.05, 0.1);
    EXPECT_TRUE(simulation.state().player.is_on_ground);
    guide.look_at({-17.0, 6.372, -1.5});
    const int aimed = simulation.state().aimed_lantern;
    ASSERT_GE(aimed, 0);
    EXPECT_TRUE(level.lanterns[std::size_t(aimed)].is_dead);
    ASSERT_EQ(simulation.state().relit_count, 0);
    game::StepInput use;
    use.use = true;
    guide.step(use);
    EXPECT_EQ(simulation.state().relit_count, 1);
    EXPECT_TRUE(simulation.state().lanterns[std::size_t(aimed)].is_lit);
}

}  // namespace
