// Flythroughs: files that say what is wrong with them, curves through the keys, and nodes that go their own
// ways.
#include "scene/camera_path.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "scene/node_tracks.h"
#include "scene/pose.h"
#include "support/process.h"

namespace tarn {
namespace {

const char* const KEYS = R"("keys": [
    {"time_s": 0, "position": [0, 1, 0], "target": [0, 0, -5], "fov_deg": 50},
    {"time_s": 1, "position": [1, 1, 0], "target": [1, 0, -5], "fov_deg": 60},
    {"time_s": 3, "position": [3, 1, 0], "target": [3, 0, -5], "fov_deg": 60}])";

class CameraPathFile : public testing::Test {
  protected:
    CameraPath load(const std::string& text) const {
        std::ofstream(folder_.file("path.json")) << text;
        return load_camera_path(folder_.file("path.json"));
    }
    std::string error_of(const std::string& text) const {
        try {
            load(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    test::TemporaryFolder folder_;
};

TEST_F(CameraPathFile, TheCurveGoesThroughItsKeysAndStopsAtItsEnds) {
    const CameraPath path = load(fmt::format("{{{}}}", KEYS));
    EXPECT_EQ(path.duration_s, 3.0);
    for (const CameraKey& key : path.keys) {
        EXPECT_EQ(evaluate_camera_path(path, key.time_s).position_ws, key.position_ws);
    }
    EXPECT_EQ(evaluate_camera_path(path, 9.0).position_ws, path.keys.back().position_ws);
    // Even speed between keys of even speed, however long they take.
    EXPECT_NEAR(evaluate_camera_path(path, 2.0).position_ws.x, 2.0, 1e-12);
    EXPECT_NEAR(evaluate_camera_path(path, 0.5).position_ws.x, 0.5, 1e-12);
}

TEST_F(CameraPathFile, ErrorsNameTheFileAndTheThing) {
    const auto with_tracks = [](const char* tracks) {
        return fmt::format("{{{}, \"tracks\": {}}}", KEYS, tracks);
    };
    const std::pair<std::string, const char*> wrong[] = {
        {"[]", "is not a JSON object"},
        {"{}", "'keys' is not a list of camera keys"},
        {R"({"keys": [{"time_s": 0}]})", "key 0: 'position' is not three numbers"},
        {with_tracks("1"), "'tracks' is not a list"},
        {with_tracks("[{}]"), "track 0: 'node' is not the name of a node"},
        {with_tracks(R"([{"node": "a"}])"), "track 0: 'keys' is not a list of node keys"},
        {with_tracks(R"([{"node": "a", "keys": [{"time_s": 1}]}])"),
         "track 0: key 0: has neither 'position' nor 'rotation_deg'"},
        {with_tracks(R"([{"node": "a", "keys": [{"time_s": 1, "position": [0, 1]}]}])"),
         "track 0: key 0: 'position' is not three numbers"},
        {with_tracks(R"([{"node": "a", "keys": [{"time_s": 1, "position": [0, 1, 2]},
                                               {"time_s": 1, "position": [0, 1, 2]}]}])"),
         "track 0: key 1: its time 1 s is not after the key before"},
    };
    for (const auto& [text, message] : wrong) {
        const std::string error = error_of(text);
        EXPECT_NE(error.find(message), std::string::npos) << text << " gives: " << error;
        EXPECT_NE(error.find("path.json"), std::string::npos) << error;
    }
}

// A lamp on a cart, and something that stands still.
Scene make_cart() {
    Scene scene;
    scene.nodes.resize(3);
    scene.nodes[0].name = "cart";
    scene.nodes[1].name = "lamp";
    scene.nodes[1].parent = NodeIndex(0);
    scene.nodes[1].local.translation = {0.0, 2.0, 0.0};
    scene.nodes[2].name = "wall";
    return scene;
}

NodeTrack make_cart_track() {
    return {"cart",
            {{1.0, glm::dvec3(0.0), glm::dvec3(0.0)},
             {2.0, glm::dvec3(1.0, 0.0, 0.0), {}},
             {4.0, glm::dvec3(3.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 90.0)}}};
}

glm::dvec3 place_of(const Scene& scene, std::size_t node, double time_s) {
    return glm::dvec3(evaluate_pose(scene, time_s).world_from_node[node][3]);
}

TEST(NodeTracks, MoveANodeAndWhatHangsOnIt) {
    Scene scene = make_cart();
    const NodeTrack track = make_cart_track();
    add_tracks(scene, std::span(&track, 1));
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-5; };
    EXPECT_TRUE(near(place_of(scene, 1, 0.0), {0.0, 2.0, 0.0}));  // before the first key
    EXPECT_TRUE(near(place_of(scene, 0, 1.5), {0.5, 0.0, 0.0}));
    EXPECT_TRUE(near(place_of(scene, 0, 3.0), {2.0, 0.0, 0.0}));
    // Half of the turn about z: the lamp leans over to -x.
    const double lean = 2.0 * std::sqrt(0.5);
    EXPECT_TRUE(near(place_of(scene, 1, 2.5), place_of(scene, 0, 2.5) + glm::dvec3(-lean, lean, 0.0)));
    EXPECT_TRUE(near(place_of(scene, 1, 4.0), {1.0, 0.0, 0.0}));
    EXPECT_TRUE(near(place_of(scene, 1, 100.0), {1.0, 0.0, 0.0}));  // it does not start again
    EXPECT_EQ(place_of(scene, 2, 3.0), glm::dvec3(0.0));
}

TEST(NodeTracks, WhatCannotBeMovedIsNamed) {
    const auto error_of = [](Scene scene, const std::string& node) {
        NodeTrack track = make_cart_track();
        track.node = node;
        try {
            add_tracks(scene, std::span(&track, 1));
        } catch (const Error& error) {
            EXPECT_TRUE(scene.animations.empty());
            return std::string(error.what());
        }
        return std::string();
    };
    Scene scene = make_cart();
    EXPECT_NE(error_of(scene, "carts").find("'carts': the scene has no node of that name"),
              std::string::npos);
    scene.nodes[2].matrix = glm::dmat4(1.0);
    EXPECT_NE(error_of(scene, "wall").find("placed by a matrix"), std::string::npos);
    scene.nodes[2].name = "cart";
    EXPECT_NE(error_of(scene, "cart").find("several nodes"), std::string::npos);
}

}  // namespace
}  // namespace tarn
