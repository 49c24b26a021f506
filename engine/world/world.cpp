#include "world/world.h"

#include "world/build_steps.h"

namespace tarn {
namespace {

// Whole metres, so that subtracting the origin loses nothing.
glm::dvec3 choose_origin(const Bounds& bounds_ws) {
    if (bounds_ws.empty()) return glm::dvec3(0.0);
    return glm::floor(bounds_ws.centre() + 0.5);
}

Bounds relative_to(const Bounds& bounds_ws, const glm::dvec3& origin_ws) {
    Bounds result;
    if (bounds_ws.empty()) return result;
    result.add(bounds_ws.lower - origin_ws);
    result.add(bounds_ws.upper - origin_ws);
    return result;
}

}  // namespace

World build_world(const Scene& scene, const WorldOptions& options) {
    World world;
    world.pose.reset(scene, options.time_s);
    const Pose& pose = world.pose.pose();
    world.is_animated = !scene.animations.empty();
    const Bounds bounds_ws = compute_bounds(scene, pose);
    world.origin_ws = choose_origin(bounds_ws);
    world.bounds = relative_to(bounds_ws, world.origin_ws);
    add_materials(world, scene);
    add_meshes(world, scene);
    place_instances(world, scene, pose);
    rebuild_lights(world, scene, pose);
    world.scene_revision = scene.revision;
    world.moves_followed = scene.moves.count();
    if (options.environment) {
        world.environment = make_environment(*options.environment);
    } else if (world.lights.count == 0) {
        world.environment = make_environment(make_even_sky(1.0f));
    }
    return world;
}

void update_world(World& world, const Scene& scene, double time_s) {
    const auto moved = scene.moves.since(world.moves_followed);
    const bool edited = scene.revision != world.scene_revision || !moved;
    if (scene.animations.empty() && !edited && moved->empty()) return;
    if (edited) {
        world.pose.reset(scene, time_s);
        update_materials(world, scene);
    } else {
        world.pose.follow(scene, time_s, *moved);
    }
    place_instances(world, scene, world.pose.pose());
    if (edited) {
        update_lights(world, scene, world.pose.pose());
    } else {
        move_lights(world, scene, world.pose);
    }
    world.scene_revision = scene.revision;
    world.moves_followed = scene.moves.count();
}

}  // namespace tarn
