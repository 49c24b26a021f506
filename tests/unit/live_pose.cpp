// A pose that is computed anew in part only, against one that is computed whole: the same bits.
#include "scene/live_pose.h"

#include <gtest/gtest.h>

#include <set>

#include "support/draws.h"

namespace tarn {
namespace {

// A forest whose parents may come after their children; a third of its nodes animated, a third given by
// matrices.
Scene make_forest(std::uint64_t seed, std::size_t count) {
    test::Draws draws(seed);
    Scene scene;
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = i;
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[draws.bits() % i]);
    scene.nodes.resize(count);
    Animation animation;
    animation.duration_s = 2.0;
    for (std::size_t rank = 0; rank < count; ++rank) {
        Node& node = scene.nodes[order[rank]];
        if (rank > 0 && draws.uniform() < 0.8) node.parent = NodeIndex(order[draws.bits() % rank]);
        node.local.translation = glm::dvec3(draws.unit_vector());
        node.local.rotation = glm::angleAxis(draws.uniform(0.0, 6.0), glm::dvec3(draws.unit_vector()));
        if (rank % 3 == 0) node.matrix = glm::dmat4(1.0) * draws.uniform(0.5, 2.0);
        if (rank % 3 != 1) continue;
        AnimationChannel channel;
        channel.node = NodeIndex(order[rank]);
        channel.property = AnimatedProperty::TRANSLATION;
        channel.interpolation = Interpolation::LINEAR;
        channel.components = 3;
        channel.times_s = {0.0f, 2.0f};
        channel.values = {0.0f, 0.0f, 0.0f, 1.0f, float(draws.uniform()), 2.0f};
        animation.channels.push_back(channel);
    }
    scene.animations.push_back(animation);
    return scene;
}

TEST(LivePose, FollowsTimeAndMovesToTheSameBits) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        Scene scene = make_forest(seed, 200);
        LivePose live;
        live.reset(scene, -1.0);
        test::Draws draws(seed);
        for (int step = 0; step < 20; ++step) {
            std::vector<NodeIndex> moved;
            for (int i = 0; i < 10; ++i) {
                const NodeIndex node(draws.bits() % scene.nodes.size());
                at(scene.nodes, node).local.translation += glm::dvec3(draws.unit_vector());
                if (at(scene.nodes, node).matrix) (*at(scene.nodes, node).matrix)[3].x += 1.0;
                moved.push_back(node);
                if (i == 0) moved.push_back(node);  // named twice
            }
            const double time_s = step % 5 == 4 ? -1.0 : 0.3 * step;
            live.follow(scene, time_s, moved);
            const Pose whole = evaluate_pose(scene, time_s);
            ASSERT_EQ(live.pose().world_from_node, whole.world_from_node) << seed << ", " << step;
            EXPECT_EQ(live.pose().morph_weights, whole.morph_weights);
        }
    }
}

TEST(LivePose, TouchesWhatHangsBelowAMovedNodeOnceAndNothingElse) {
    Scene scene;
    scene.nodes.resize(6);
    const auto hang = [&](std::size_t child, std::size_t parent) {
        scene.nodes[child].parent = NodeIndex(parent);
    };
    hang(1, 0);
    hang(2, 1);
    hang(3, 1);
    hang(5, 4);
    LivePose live;
    live.reset(scene, -1.0);
    const std::vector<NodeIndex> moved = {NodeIndex(3), NodeIndex(1), NodeIndex(1)};
    live.follow(scene, -1.0, moved);
    std::multiset<std::uint32_t> touched;
    for (const NodeIndex node : live.touched()) touched.insert(node.value);
    EXPECT_EQ(touched, (std::multiset<std::uint32_t>{1, 2, 3}));
    live.follow(scene, -1.0, {});
    EXPECT_TRUE(live.touched().empty());
}

}  // namespace
}  // namespace tarn
