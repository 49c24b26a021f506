// Lights while the scene moves and is edited: the table is that of a world built anew, a light keeps its
// identity, and what did not change is not written.
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "shared/math/light.h"
#include "support/draws.h"
#include "support/movable_scene.h"

namespace tarn {
namespace {

using namespace test;

struct Revisions {
    explicit Revisions(const WorldLights& lights)
        : order(lights.order_revision),
          structure(lights.structure_revision),
          any(lights.changes.revision()) {}
    friend bool operator==(const Revisions&, const Revisions&) = default;
    std::uint64_t order, structure, any;
};

using Ranges = std::vector<IndexRange>;

// One who has seen the lights as they were, and looks again.
class Reader {
  public:
    explicit Reader(const WorldLights& lights) : lights_(lights) { look(); }
    Changes look() { return lights_.changes.read(cursor_); }

  private:
    const WorldLights& lights_;
    ChangeLog::Cursor cursor_;
};

// ---- Nothing, or only something, moves
// -------------------------------------------------------------------------------------------

TEST(LightUpdates, WhereNothingMovedNothingIsWrittenAndNoRevisionGrows) {
    MovableScene movable;
    World world = build_world(movable.scene());
    Reader reader(world.lights);
    const Revisions before(world.lights);
    const std::vector<glm::uvec4> rows = world.lights.rows;
    update_world(world, movable.scene(), -1.0);  // not even edited
    EXPECT_EQ(Revisions(world.lights), before);
    EXPECT_TRUE(reader.look().empty());
    movable.update(world);  // edited, but the same
    EXPECT_EQ(Revisions(world.lights), before);
    EXPECT_TRUE(reader.look().empty());
    EXPECT_EQ(world.lights.rows, rows);
}

TEST(LightUpdates, ARigidMotionWritesOnlyTheTrianglesOfItsInstance) {
    MovableScene movable;
    World world = build_world(movable.scene());
    const WorldLights before = world.lights;
    Reader reader(world.lights);
    for (const int lamp : {3, 4, 9}) {
        Transform& local = movable.node(movable.lamp_nodes[std::size_t(lamp)]).local;
        local.translation.y += 1.0;
        local.rotation = glm::angleAxis(0.7 + lamp, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)));
    }
    movable.update(world);
    const std::uint32_t first = before.punctual_count;
    const Ranges moved = {{first + 3 * LAMP_TRIANGLES, first + 5 * LAMP_TRIANGLES},
                          {first + 9 * LAMP_TRIANGLES, first + 10 * LAMP_TRIANGLES}};
    EXPECT_EQ(reader.look().ranges, moved);
    EXPECT_EQ(world.lights.structure_revision, before.structure_revision);
    EXPECT_EQ(world.lights.changes.revision(), before.changes.revision() + 1);
    EXPECT_EQ(world.lights.alias_rows, before.alias_rows);
    expect_as_built(world, movable.scene());
}

TEST(LightUpdates, APunctualLightMovesAlone) {
    MovableScene movable;
    World world = build_world(movable.scene());
    const Revisions before(world.lights);
    Reader reader(world.lights);
    movable.node(movable.scene().light_nodes[1]).local.translation.z += 2.0;
    movable.update(world);
    EXPECT_EQ(reader.look().ranges, (Ranges{{1, 2}}));
    EXPECT_EQ(world.lights.structure_revision, before.structure);
    expect_as_built(world, movable.scene());
}

TEST(LightUpdates, NotedMovesComeToTheSameAsAnEdit) {
    MovableScene movable;
    World noted = build_world(movable.scene()), edited = noted;
    Reader noted_reader(noted.lights), edited_reader(edited.lights);
    test::Draws draws(3);
    for (int step = 0; step < 5; ++step) {
        Scene& scene = movable.scene();
        for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
            if (draws.uniform() < 0.6) continue;
            if (scene.nodes[i].matrix) {
                (*scene.nodes[i].matrix)[3] += glm::dvec4(glm::dvec3(draws.unit_vector()), 0.0);
            } else {
                scene.nodes[i].local.translation += glm::dvec3(draws.unit_vector());
            }
            scene.moves.add(NodeIndex(i));
        }
        update_world(noted, scene, -1.0);
        Scene copy = scene;
        ++copy.revision;
        edited.scene_revision = copy.revision - 1;
        update_world(edited, copy, -1.0);
        EXPECT_EQ(noted.lights.rows, edited.lights.rows) << step;
        EXPECT_EQ(noted_reader.look().ranges, edited_reader.look().ranges) << step;
        EXPECT_EQ(noted.instance_rows, edited.instance_rows) << step;
        EXPECT_EQ(noted.lights.structure_revision, edited.lights.structure_revision) << step;
    }
}

TEST(LightUpdates, AMoveThatIsNotNotedIsNotSeenAndOneThatIsForgottenIs) {
    MovableScene movable;
    World world = build_world(movable.scene());
    const std::vector<glm::uvec4> before = world.lights.rows;
    movable.node(movable.lamp_nodes[3]).local.translation.y += 1.0;
    update_world(world, movable.scene(), -1.0);
    EXPECT_EQ(world.lights.rows, before);
    movable.scene().moves.add(movable.lamp_nodes[3]);
    movable.scene().moves.clear();
    update_world(world, movable.scene(), -1.0);
    EXPECT_NE(world.lights.rows, before);
    expect_as_built(world, movable.scene());
}

TEST(LightUpdates, AReaderThatLetsUpdatesPassIsToldOfAllOfThem) {
    MovableScene movable;
    World world = build_world(movable.scene());
    Reader reader(world.lights);
    for (const std::size_t lamp : {7u, 0u}) {
        movable.node(movable.lamp_nodes[lamp]).local.translation.y += 1.0;
        movable.update(world);
    }
    update_world(world, movable.scene(), -1.0);
    const std::uint32_t first = world.lights.punctual_count, seventh = first + 7 * LAMP_TRIANGLES;
    EXPECT_EQ(reader.look().ranges,
              (Ranges{{first, first + LAMP_TRIANGLES}, {seventh, seventh + LAMP_TRIANGLES}}));
    movable.scene().light_nodes.pop_back();
    movable.update(world);
    movable.node(movable.lamp_nodes[3]).local.translation.y += 1.0;
    movable.update(world);
    EXPECT_TRUE(reader.look().everything) << "a light went";
}

// ---- Powers
// ---------------------------------------------------------------------------------------------------------

TEST(LightUpdates, AScaledInstanceChangesItsPower) {
    MovableScene movable;
    World world = build_world(movable.scene());
    const WorldLights before = world.lights;
    movable.node(movable.lamp_nodes[5]).local.scale = glm::dvec3(2.0);
    movable.update(world);
    const std::uint32_t light = before.punctual_count + 5 * LAMP_TRIANGLES;
    EXPECT_NEAR(world.lights.powers[light], 4.0 * before.powers[light], 1e-4 * before.powers[light]);
    EXPECT_EQ(world.lights.structure_revision, before.structure_revision + 1);
    EXPECT_EQ(world.lights.order_revision, before.order_revision);
    EXPECT_EQ(world.lights.identities, before.identities);
    expect_as_built(world, movable.scene());
}

// Each step lies within the tolerance, all of them together far outside.
TEST(LightUpdates, APowerThatCreepsIsNotLost) {
    MovableScene movable;
    World world = build_world(movable.scene());
    for (int step = 0; step < 200; ++step) {
        movable.node(movable.lamp_nodes[5]).local.scale *= 1.0002;
        movable.update(world);
    }
    expect_as_built(world, movable.scene());
}

TEST(LightUpdates, AnInstanceThatShrinksToNothingLosesItsLightsAndGetsThemBack) {
    MovableScene movable;
    World world = build_world(movable.scene());
    const WorldLights before = world.lights;
    Transform& local = movable.node(movable.lamp_nodes[2]).local;
    local.scale = glm::dvec3(0.0);
    movable.update(world);
    EXPECT_EQ(world.lights.count, before.count - LAMP_TRIANGLES);
    EXPECT_EQ(world.lights.order_revision, before.order_revision + 1);
    expect_as_built(world, movable.scene());
    local.scale = glm::dvec3(1.0);
    movable.update(world);
    EXPECT_EQ(world.lights.identities, before.identities);
    expect_as_built(world, movable.scene());
}

// ---- Edits
// ----------------------------------------------------------------------------------------------------------

TEST(LightUpdates, ADimmedLightChangesItsRowAndTheTable) {
    MovableScene movable;
    World world = build_world(movable.scene());
    const WorldLights before = world.lights;
    Reader reader(world.lights);
    movable.scene().lights[1].intensity = glm::vec3(0.5f);
    movable.update(world);
    EXPECT_EQ(reader.look().ranges, (Ranges{{1, 2}}));
    EXPECT_EQ(world.lights.structure_revision, before.structure_revision + 1);
    EXPECT_EQ(world.lights.order_revision, before.order_revision);
    expect_as_built(world, movable.scene());
}

TEST(LightUpdates, AnEditedEmissionReachesTheLightsOfItsMaterialAlone) {
    MovableScene movable;
    World world = build_world(movable.scene());
    const WorldLights before = world.lights;
    Reader reader(world.lights);
    const std::uint64_t material_revision = world.material_revision;
    Material& material = at(movable.scene().materials, movable.lamp_material);
    material.emission = glm::vec3(100.0f, 1.0f, 1.0f);
    movable.update(world);
    EXPECT_EQ(reader.look().ranges, (Ranges{{before.count - LAMP_TRIANGLES, before.count}}));
    EXPECT_EQ(world.material_revision, material_revision + 1);
    expect_as_built(world, movable.scene());
    material.emission = glm::vec3(0.0f);
    movable.update(world);
    EXPECT_EQ(world.lights.count, before.count - LAMP_TRIANGLES);
    expect_as_built(world, movable.scene());
}

TEST(LightUpdates, TheLastLightMayGo) {
    MovableScene movable;
    World world = build_world(movable.scene());
    movable.scene().light_nodes.clear();
    for (Material& material : movable.scene().materials) material.emission = glm::vec3(0.0f);
    movable.update(world);
    EXPECT_EQ(world.lights.count, 0u);
    EXPECT_EQ(world.environment.width, 0u) << "a scene that went dark gets no sky";
}

// ---- Identities
// -----------------------------------------------------------------------------------------------------

// What a light shows of who it is: the intensities here are all different.
using Faces = std::map<std::uint64_t, std::pair<float, std::uint32_t>>;

std::vector<glm::uvec4> rows_of(const WorldLights& lights, std::uint32_t light) {
    const auto first = lights.rows.begin() + std::ptrdiff_t(light * LIGHT_ROWS);
    return {first, first + LIGHT_ROWS};
}

Faces list_faces(const WorldLights& lights, const std::vector<std::uint64_t>& identities) {
    Faces faces;
    for (std::uint32_t i = 0; i < lights.count; ++i) {
        const std::vector<glm::uvec4> rows = rows_of(lights, i);
        const Light light = unpack_light(rows[0], rows[1], rows[2], rows[3]);
        faces[identities[i]] = {light.radiance.x, light.primitive};
    }
    return faces;
}

// Lights known by both, with different faces.
int count_mistaken(const Faces& before, const Faces& after) {
    int mistaken = 0;
    for (const auto& [identity, face] : before) {
        const auto found = after.find(identity);
        mistaken += found != after.end() && found->second != face;
    }
    return mistaken;
}

// Adds, removes, reorders and moves lights at random, and calls check(lights) after each step.
void shuffle_lights(const std::function<void(const WorldLights&)>& check) {
    MovableScene movable;
    World world = build_world(movable.scene());
    check(world.lights);
    Draws draws(1);
    for (int step = 0; step < 60; ++step) {
        std::vector<NodeIndex>& nodes = movable.scene().light_nodes;
        const std::size_t any = nodes.empty() ? 0 : draws.bits() % nodes.size();
        const std::uint32_t choice = draws.bits() % 5u;
        if (choice == 0u || nodes.empty()) {
            movable.add_point(20.0f + float(step));
        } else if (choice == 1u) {
            nodes.erase(nodes.begin() + std::ptrdiff_t(any));
        } else if (choice == 2u) {
            std::swap(nodes[any], nodes.front());
        } else if (choice == 3u) {
            Transform& local = movable.node(movable.lamp_nodes[draws.bits() % LAMP_COUNT]).local;
            local.scale = local.scale.x == 0.0 ? glm::dvec3(1.0) : glm::dvec3(0.0);
        } else {
            movable.node(nodes[any]).local.translation.x += 0.5;
        }
        movable.update(world);
        check(world.lights);
        expect_as_built(world, movable.scene());
    }
}

TEST(LightUpdates, ALightKeepsItsIdentityWhateverIsAddedRemovedReorderedOrMoved) {
    Faces before;
    std::size_t known = 0;
    shuffle_lights([&](const WorldLights& lights) {
        const Faces faces = list_faces(lights, lights.identities);
        EXPECT_EQ(faces.size(), lights.count) << "two lights share an identity";
        EXPECT_EQ(count_mistaken(before, faces), 0);
        for (const auto& face : before) known += faces.count(face.first);
        before = faces;
    });
    EXPECT_GT(known, 60u * 12u) << "most lights were there before";
}

TEST(LightUpdates, NegativeControlIndicesAreNoIdentities) {
    Faces before;
    int mistaken = 0;
    shuffle_lights([&](const WorldLights& lights) {
        std::vector<std::uint64_t> indices(lights.count);
        for (std::uint32_t i = 0; i < lights.count; ++i) indices[i] = i;
        const Faces faces = list_faces(lights, indices);
        mistaken += count_mistaken(before, faces);
        before = faces;
    });
    EXPECT_GT(mistaken, 0);
}

// ---- Animations
// -----------------------------------------------------------------------------------------------------

void add_animation(Scene& scene, NodeIndex node, AnimatedProperty property, std::vector<float> values,
                   int components) {
    AnimationChannel channel;
    channel.node = node;
    channel.property = property;
    channel.times_s = {0.0f, 1.0f};
    channel.values = std::move(values);
    channel.components = components;
    if (scene.animations.empty()) scene.animations.emplace_back().duration_s = 1.0;
    scene.animations[0].channels.push_back(channel);
}

TEST(LightUpdates, AnimatedLightsAreWhereANewWorldHasThem) {
    MovableScene movable;
    Scene& scene = movable.scene();
    add_animation(scene, movable.lamp_nodes[1], AnimatedProperty::TRANSLATION, {0, 2, 0, 5, 9, 1}, 3);
    add_animation(scene, movable.lamp_nodes[7], AnimatedProperty::ROTATION, {0, 0, 0, 1, 0, 1, 0, 0}, 4);
    add_animation(scene, movable.lamp_nodes[8], AnimatedProperty::SCALE, {1, 1, 1, 2, -3, 4}, 3);
    World world = build_world(scene);
    for (const double time_s : {0.0, 0.3, 0.31, 0.9, 0.1}) {
        update_world(world, scene, time_s);
        expect_as_built(world, scene, time_s);
    }
    const Revisions before(world.lights);
    update_world(world, scene, 0.1);
    EXPECT_EQ(Revisions(world.lights), before) << "the same moment again";
}

TEST(LightUpdates, ADeformingEmitterIsFollowedTriangleByTriangle) {
    MovableScene movable;
    Scene& scene = movable.scene();
    const NodeIndex node = movable.lamp_nodes[6];
    for (const Instance& instance : scene.instances) {
        if (instance.node != node) continue;
        MorphTarget target;
        target.positions_os.assign(6, glm::vec3(0.0f));
        target.positions_os[4] = {3.0f, 0.0f, 0.0f};  // of the second triangle alone
        at(scene.meshes, instance.mesh).morph_targets.push_back(target);
    }
    movable.node(node).morph_weights = {0.0f};
    add_animation(scene, node, AnimatedProperty::WEIGHTS, {0, 1}, 1);
    World world = build_world(scene);
    const std::uint32_t second = world.lights.punctual_count + 6 * LAMP_TRIANGLES + 1;
    Reader reader(world.lights);
    update_world(world, scene, 0.5);
    EXPECT_EQ(reader.look().ranges, (Ranges{{second, second + 1}}));
    expect_as_built(world, scene, 0.5);
    const Revisions before(world.lights);
    update_world(world, scene, 0.5);
    EXPECT_EQ(Revisions(world.lights), before) << "the same moment again";
}

}  // namespace
}  // namespace tarn
