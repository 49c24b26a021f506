// Bullet's world with a level in it. For this folder alone: no other header shows Bullet.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include <memory>

#include "level.h"
#include "snapshot.h"

namespace game {

// What collides with what.
enum CollisionGroup : int {
    GROUP_LEVEL = 1,
    GROUP_BALL = 2,
    GROUP_CHARACTER = 4,  // a person, who is stopped
    GROUP_BODY = 8,       // the same person, as balls feel it
    GROUP_CRATE = 16
};

inline constexpr double GRAVITY_M_S2 = 9.81;

// The shapes that stand still: costly to make, and shared by all worlds of a level.
struct LevelShape {
    explicit LevelShape(const Level& level);

    Vec3 origin;
    btTriangleMesh mesh;
    std::unique_ptr<btBvhTriangleMeshShape> triangles;  // null: there are none
    std::unique_ptr<btStaticPlaneShape> ground;         // null: none is needed
};

// Positions are relative to the level's origin, metres.
class Physics {
  public:
    explicit Physics(std::shared_ptr<LevelShape> shape);
    ~Physics();
    Physics(const Physics&) = delete;
    Physics& operator=(const Physics&) = delete;

    btDiscreteDynamicsWorld& world() { return world_; }

    // An endless floor at this height, relative to the origin; also for worlds that are made of the shape
    // later.
    void add_ground(btScalar height_m);

    btVector3 to_local(const Vec3& point_ws) const;
    Vec3 to_world(const btVector3& point) const;

    // Whether a surface of the level lies between two points.
    bool is_surface_between(const btVector3& from, const btVector3& to) const;

    // How much of the way a shape gets from `from` towards `to` before it is stopped by what is in one of the
    // groups of `mask`; 1: all of it.
    btScalar sweep(const btConvexShape& shape, const btVector3& from, const btVector3& to, int mask) const;

    // Whether a shape would be inside of what is in one of the groups of `mask`.
    bool touches(const btConvexShape& shape, const btTransform& place, int mask);

  private:
    // A person's ghost finds what it touches and moves itself out; it pushes nothing, and nothing rests on
    // it.
    class Dispatcher final : public btCollisionDispatcher {
      public:
        using btCollisionDispatcher::btCollisionDispatcher;
        bool needsResponse(const btCollisionObject* a, const btCollisionObject* b) override {
            const bool has_ghost = btGhostObject::upcast(a) != nullptr || btGhostObject::upcast(b) != nullptr;
            return !has_ghost && btCollisionDispatcher::needsResponse(a, b);
        }
    };

    std::unique_ptr<btRigidBody> add_still(btCollisionShape& shape);

    std::shared_ptr<LevelShape> shape_;
    btDefaultCollisionConfiguration configuration_;
    Dispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btGhostPairCallback ghost_pairs_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    std::unique_ptr<btRigidBody> body_;
    std::unique_ptr<btRigidBody> ground_;
};

BodySnapshot take_snapshot(const btRigidBody& body);
btTransform place_of(const BodySnapshot& snapshot);
// All but the place, of a body that stands there already.
void restore_motion(btRigidBody& body, const BodySnapshot& snapshot);

inline std::array<float, 3> to_array(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}
inline btVector3 to_vector(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

}  // namespace game
