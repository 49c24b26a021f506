// Fireflies as the scene has them: each is where the simulation says and as bright; those that are not lit
// are dark and out of sight.
#include <gtest/gtest.h>

#include "game/sandbox/firefly_lamps.h"

namespace {

using game::FireflyState;
using game::Scene;

constexpr game::Vec3 HIDDEN = {0.0, -9.0, 0.0};

class FireflyLamps : public testing::Test {
  protected:
    game::Vec3 place(std::size_t lamp) const {
        return scene_.transform({std::uint32_t(first_node_ + lamp)}).translation;
    }
    double green(std::size_t lamp) const { return scene_.surface(first_material_ + lamp).emission.y; }

    Scene scene_ = Scene::load(TARN_BUILD_DIR "/content/corner.glb");
    std::size_t first_node_ = scene_.node_count();
    std::size_t first_material_ = scene_.material_count();
    std::vector<FireflyState> states_ = {{{1, 1, 1}, 1.0}, {{2, 1, 1}, 0.5}, {{3, 1, 1}, 0.25}};
    game::FireflyLamps lamps_{scene_, states_, HIDDEN};
};

TEST_F(FireflyLamps, FollowTheirState) {
    EXPECT_EQ(scene_.node_count(), first_node_ + 3);
    EXPECT_EQ(place(1).x, 2.0);
    EXPECT_DOUBLE_EQ(green(1), 2.0 * green(2));
    const double before = green(2);
    states_[2] = {{3, 2, 1}, 0.75};
    lamps_.show(states_, 3);
    EXPECT_EQ(place(2).y, 2.0);
    EXPECT_DOUBLE_EQ(green(2), 3.0 * before);
    EXPECT_GT(green(2), scene_.surface(first_material_ + 2).emission.x);  // warm green
    EXPECT_GT(scene_.surface(first_material_ + 2).emission.x, scene_.surface(first_material_ + 2).emission.z);
}

TEST_F(FireflyLamps, ThoseThatAreNotLitAreDarkAndOutOfSight) {
    lamps_.show(states_, 1);
    EXPECT_EQ(place(0).x, 1.0);
    EXPECT_GT(green(0), 0.0);
    for (const std::size_t lamp : {1u, 2u}) {
        EXPECT_EQ(place(lamp).y, HIDDEN.y);
        EXPECT_EQ(green(lamp), 0.0);
    }
    lamps_.show(states_, 2);
    EXPECT_EQ(place(1).x, 2.0);
    EXPECT_GT(green(1), 0.0);
    EXPECT_EQ(green(2), 0.0);
}

}  // namespace
