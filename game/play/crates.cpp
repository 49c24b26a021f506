#include "crates.h"

#include <algorithm>

namespace game {
namespace {

constexpr btScalar CRATE_KG = 20.0f;
constexpr btScalar PUSH_N = 320.0f;  // a stack of three slides slowly
constexpr btScalar PUSH_M_S = 1.8f;
constexpr btScalar GRAZING = 0.4f;
constexpr btScalar STEADY = 0.8f;
constexpr btScalar REACH_M = 0.06f;  // more than the gap that the character's controller keeps
constexpr btScalar GAP_M = 0.002f;   // above what it is dropped on
constexpr btScalar FLOOR_NORMAL_Y = 0.95f;
constexpr int OBSTACLES = GROUP_LEVEL | GROUP_CRATE;

// The nearest crate beside a body. What is under its feet is not in its way.
class BesideBody final : public btCollisionWorld::ClosestConvexResultCallback {
  public:
    BesideBody(const btVector3& from, const btVector3& to) : ClosestConvexResultCallback(from, to) {
        m_collisionFilterGroup = GROUP_CHARACTER;
        m_collisionFilterMask = GROUP_CRATE;
    }
    btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool is_normal_in_world) override {
        constexpr btScalar STEEP = 0.6f;
        if (!is_normal_in_world || btFabs(result.m_hitNormalLocal.y()) > STEEP) return m_closestHitFraction;
        return ClosestConvexResultCallback::addSingleResult(result, is_normal_in_world);
    }
};

}  // namespace

Crates::Crates(Physics& physics, btScalar lowest_m)
    : physics_(physics), lowest_m_(lowest_m), shape_(btVector3(1.0f, 1.0f, 1.0f) * btScalar(CRATE_HALF_M)) {}

void Crates::place(const Level& level) {
    for (const CratePlace& place : level.crates) {
        const double height_m = level.triangles.empty() ? 0.0 : place.above.y - level.bounds.lower.y;
        const auto start = find_place(place, btScalar(std::max(height_m, double(Character::HEIGHT_M)) + 1.0));
        if (!start) continue;
        crates_.push_back({*start, nullptr, start->getOrigin()});
        add(crates_.back(), *start);  // the next one may come to stand on it
    }
}

Crates::~Crates() {
    for (Crate& crate : crates_) remove(crate);
}

std::optional<btTransform> Crates::find_place(const CratePlace& place, btScalar depth_m) const {
    btTransform from(btQuaternion(btVector3(0.0f, 1.0f, 0.0f), btScalar(place.yaw_rad)),
                     physics_.to_local(place.above));
    btTransform to = from;
    to.getOrigin() -= btVector3(0.0f, depth_m, 0.0f);
    btCollisionWorld::ClosestConvexResultCallback floor(from.getOrigin(), to.getOrigin());
    floor.m_collisionFilterGroup = GROUP_CRATE;
    floor.m_collisionFilterMask = OBSTACLES;
    physics_.world().convexSweepTest(&shape_, from, to, floor);
    if (!floor.hasHit() || floor.m_hitNormalWorld.y() < FLOOR_NORMAL_Y) return std::nullopt;
    from.getOrigin().setY(from.getOrigin().y() - depth_m * floor.m_closestHitFraction + GAP_M);
    if (physics_.touches(shape_, from, OBSTACLES)) return std::nullopt;
    return from;
}

void Crates::add(Crate& crate, const btTransform& place) {
    btVector3 inertia;
    shape_.calculateLocalInertia(CRATE_KG, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(CRATE_KG, nullptr, &shape_, inertia);
    info.m_startWorldTransform = place;
    info.m_friction = 0.6f;
    info.m_restitution = 0.35f;  // of a ball that hits it a fifth: a contact has the product of both sides
    info.m_linearDamping = 0.05f;
    info.m_angularDamping = 0.2f;
    crate.body = std::make_unique<btRigidBody>(info);
    crate.last = place.getOrigin();
    physics_.world().addRigidBody(crate.body.get(), GROUP_CRATE,
                                  GROUP_LEVEL | GROUP_BALL | GROUP_CRATE | GROUP_CHARACTER);
}

void Crates::remove(Crate& crate) {
    if (crate.body) physics_.world().removeRigidBody(crate.body.get());
    crate.body.reset();
}

void Crates::restore(const Crates& others, const std::vector<BodySnapshot>& snapshots) {
    for (std::size_t i = 0; i < snapshots.size(); ++i) {
        crates_.emplace_back().start = others.crates_[i].start;
        add(crates_.back(), place_of(snapshots[i]));
        restore_motion(*crates_.back().body, snapshots[i]);
    }
}

std::vector<BodySnapshot> Crates::take() const {
    std::vector<BodySnapshot> snapshots;
    for (const Crate& crate : crates_) snapshots.push_back(take_snapshot(*crate.body));
    return snapshots;
}

void Crates::push(const Character& character, btScalar dt_s) {
    const btVector3 wish = character.wish_m_s();
    // Who jumps wants onto it.
    if (wish.fuzzyZero() || !character.is_on_ground()) return;
    const btTransform& from = character.place();
    btTransform to = from;
    to.getOrigin() += wish.normalized() * REACH_M;
    BesideBody hit(from.getOrigin(), to.getOrigin());
    physics_.world().convexSweepTest(&character.shape(), from, to, hit);
    if (!hit.hasHit()) return;
    const auto crate = std::find_if(crates_.begin(), crates_.end(), [&](const Crate& each) {
        return each.body.get() == hit.m_hitCollisionObject;
    });
    if (crate == crates_.end()) return;
    btRigidBody& body = *crate->body;
    const btVector3 way = wish.normalized();
    const btScalar facing = -way.dot(hit.m_hitNormalWorld);  // 0: along its side
    const btScalar missing = std::min(wish.length(), PUSH_M_S) - body.getLinearVelocity().dot(way);
    if (missing <= 0.0f || facing < GRAZING) return;
    body.activate(true);
    body.applyCentralImpulse(way * facing * std::min(missing * CRATE_KG, PUSH_N * dt_s));
    // With both hands: it turns little.
    body.setAngularVelocity(body.getAngularVelocity() * STEADY);
}

void Crates::hold() {
    for (Crate& crate : crates_) {
        btRigidBody& body = *crate.body;
        if (physics_.is_surface_between(crate.last, body.getWorldTransform().getOrigin())) {
            body.getWorldTransform().setOrigin(crate.last);
            body.setInterpolationWorldTransform(body.getWorldTransform());
            body.setLinearVelocity(btVector3(0.0f, 0.0f, 0.0f));
        }
        crate.last = body.getWorldTransform().getOrigin();
        if (crate.last.y() >= lowest_m_) continue;
        remove(crate);
        add(crate, crate.start);
    }
}

void Crates::describe(std::vector<CrateState>& crates) const {
    crates.resize(crates_.size());
    for (std::size_t i = 0; i < crates_.size(); ++i) {
        const btTransform& place = crates_[i].body->getWorldTransform();
        const btQuaternion turn = place.getRotation();
        const btVector3& velocity = crates_[i].body->getLinearVelocity();
        crates[i].position = physics_.to_world(place.getOrigin());
        crates[i].rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
        crates[i].velocity = {velocity.x(), velocity.y(), velocity.z()};
    }
}

}  // namespace game
