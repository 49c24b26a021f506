#include "physics.h"

#include <utility>

namespace game {
namespace {

struct ContactFound final : btCollisionWorld::ContactResultCallback {
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        found = found || point.getDistance() < 0.0f;
        return 0.0f;
    }
    bool found = false;
};

}  // namespace

LevelShape::LevelShape(const Level& level) : origin(level.origin) {
    mesh.preallocateVertices(int(3 * level.triangles.size()));
    mesh.preallocateIndices(int(3 * level.triangles.size()));
    for (const std::array<float, 9>& t : level.triangles) {
        mesh.addTriangle(btVector3(t[0], t[1], t[2]), btVector3(t[3], t[4], t[5]),
                         btVector3(t[6], t[7], t[8]));
    }
    if (!level.triangles.empty()) triangles = std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
}

Physics::Physics(std::shared_ptr<LevelShape> shape)
    : shape_(std::move(shape)),
      dispatcher_(&configuration_),
      world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    broadphase_.getOverlappingPairCache()->setInternalGhostPairCallback(&ghost_pairs_);
    world_.setGravity(btVector3(0.0f, btScalar(-GRAVITY_M_S2), 0.0f));
    // Else the order of contacts, and with it the last bits, depends on what was there before.
    world_.getDispatchInfo().m_deterministicOverlappingPairs = true;
    // Else pushing out of a surface also speeds up: balls would bounce too high.
    world_.getSolverInfo().m_splitImpulsePenetrationThreshold = 0.0f;
    // How far a sweep may end inside of what it hits: by default four centimetres.
    world_.getDispatchInfo().m_allowedCcdPenetration = 0.02f;
    if (shape_->triangles) body_ = add_still(*shape_->triangles);
    if (shape_->ground) ground_ = add_still(*shape_->ground);
}

Physics::~Physics() {
    if (body_) world_.removeRigidBody(body_.get());
    if (ground_) world_.removeRigidBody(ground_.get());
}

std::unique_ptr<btRigidBody> Physics::add_still(btCollisionShape& shape) {
    btRigidBody::btRigidBodyConstructionInfo info(0.0f, nullptr, &shape);
    info.m_friction = 0.7f;
    info.m_restitution = 1.0f;  // a contact has the product of both sides: the ball's own
    auto body = std::make_unique<btRigidBody>(info);
    world_.addRigidBody(body.get(), GROUP_LEVEL, GROUP_BALL | GROUP_CHARACTER | GROUP_CRATE);
    return body;
}

void Physics::add_ground(btScalar height_m) {
    shape_->ground = std::make_unique<btStaticPlaneShape>(btVector3(0.0f, 1.0f, 0.0f), height_m);
    ground_ = add_still(*shape_->ground);
}

btVector3 Physics::to_local(const Vec3& p) const {
    const Vec3& o = shape_->origin;
    return {btScalar(p.x - o.x), btScalar(p.y - o.y), btScalar(p.z - o.z)};
}

Vec3 Physics::to_world(const btVector3& p) const {
    const Vec3& o = shape_->origin;
    return {double(p.x()) + o.x, double(p.y()) + o.y, double(p.z()) + o.z};
}

bool Physics::is_surface_between(const btVector3& from, const btVector3& to) const {
    if (from == to) return false;
    btCollisionWorld::ClosestRayResultCallback way(from, to);
    way.m_collisionFilterGroup = GROUP_BALL;
    way.m_collisionFilterMask = GROUP_LEVEL;
    world_.rayTest(from, to, way);
    return way.hasHit();
}

btScalar Physics::sweep(const btConvexShape& shape, const btVector3& from, const btVector3& to,
                        int mask) const {
    btCollisionWorld::ClosestConvexResultCallback hit(from, to);
    hit.m_collisionFilterGroup = GROUP_BALL;
    hit.m_collisionFilterMask = mask;
    btTransform start = btTransform::getIdentity(), end = btTransform::getIdentity();
    start.setOrigin(from);
    end.setOrigin(to);
    world_.convexSweepTest(&shape, start, end, hit);
    return hit.m_closestHitFraction;
}

bool Physics::touches(const btConvexShape& shape, const btTransform& place, int mask) {
    btCollisionObject object;
    object.setCollisionShape(const_cast<btConvexShape*>(&shape));
    object.setWorldTransform(place);
    ContactFound contact;
    contact.m_collisionFilterGroup = -1;
    contact.m_collisionFilterMask = mask;
    world_.contactTest(&object, contact);
    return contact.found;
}

BodySnapshot take_snapshot(const btRigidBody& body) {
    BodySnapshot snapshot;
    const btTransform& place = body.getWorldTransform();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            snapshot.turn[std::size_t(3 * row + column)] = place.getBasis()[row][column];
    }
    snapshot.middle = to_array(place.getOrigin());
    snapshot.velocity = to_array(body.getLinearVelocity());
    snapshot.spin = to_array(body.getAngularVelocity());
    snapshot.activation = body.getActivationState();
    snapshot.still_s = body.getDeactivationTime();
    return snapshot;
}

btTransform place_of(const BodySnapshot& snapshot) {
    const std::array<float, 9>& t = snapshot.turn;
    return btTransform{btMatrix3x3(t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8]),
                       to_vector(snapshot.middle)};
}

void restore_motion(btRigidBody& body, const BodySnapshot& snapshot) {
    body.setLinearVelocity(to_vector(snapshot.velocity));
    body.setAngularVelocity(to_vector(snapshot.spin));
    body.forceActivationState(snapshot.activation);
    body.setDeactivationTime(snapshot.still_s);
}

}  // namespace game
