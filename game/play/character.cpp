#include "character.h"

#include <algorithm>

namespace game {
namespace {

constexpr btScalar CROUCHED_HEIGHT_M = 1.1f;
constexpr btScalar CROUCHED_STEP_HEIGHT_M = 0.18f;  // else it bumps against what it crawls under
constexpr btScalar SKIN_M = 0.1f;  // how deep a body may be in a floor or a ceiling for a moment
constexpr btScalar EYE_BELOW_TOP_M = 0.13f;
constexpr btScalar EYE_SPEED_M_S = 4.0f;  // up and down, when crouching
constexpr btScalar WALK_M_S = 3.0f;
constexpr btScalar RUN_M_S = 6.0f;
constexpr btScalar CROUCHED_M_S = 1.5f;
constexpr btScalar GROUND_ACCELERATION_M_S2 = 40.0f;
constexpr btScalar AIR_ACCELERATION_M_S2 = 12.0f;
constexpr btScalar JUMP_M_S = 4.4f;  // 0.99 m high
constexpr btScalar STEEPEST_SLOPE_RAD = 0.87f;

btCapsuleShape make_capsule(btScalar height_m, btScalar radius_m = Character::RADIUS_M) {
    return btCapsuleShape(radius_m, height_m - 2.0f * radius_m);
}

}  // namespace

Character::Character(Physics& physics, const btVector3& feet)
    : physics_(physics),
      tall_(make_capsule(HEIGHT_M)),
      low_(make_capsule(CROUCHED_HEIGHT_M)),
      slim_(make_capsule(HEIGHT_M - 0.1f, RADIUS_M - 0.03f)),
      controller_(&ghost_, &tall_, STEP_HEIGHT_M, btVector3(0.0f, 1.0f, 0.0f)),
      body_(btRigidBody::btRigidBodyConstructionInfo(0.0f, nullptr, &tall_)),
      eye_height_m_(HEIGHT_M - EYE_BELOW_TOP_M) {
    ghost_.setCollisionShape(&tall_);
    // Static, so that crates beside it may fall asleep; it moves itself.
    ghost_.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT | btCollisionObject::CF_STATIC_OBJECT);
    physics.world().addCollisionObject(&ghost_, GROUP_CHARACTER, GROUP_LEVEL | GROUP_CRATE);
    body_.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    body_.setActivationState(DISABLE_DEACTIVATION);
    physics.world().addRigidBody(&body_, GROUP_BODY, GROUP_BALL);
    controller_.setGravity(btVector3(0.0f, btScalar(-GRAVITY_M_S2), 0.0f));
    controller_.setJumpSpeed(JUMP_M_S);
    controller_.setMaxSlope(STEEPEST_SLOPE_RAD);
    // Else its sweeps see only what touched its box before the step.
    controller_.setUseGhostSweepTest(false);
    controller_.setMaxPenetrationDepth(0.01f);
    teleport(feet);
}

Character::~Character() {
    physics_.world().removeRigidBody(&body_);
    physics_.world().removeCollisionObject(&ghost_);
}

void Character::teleport(const btVector3& feet) {
    set_height(false);
    eye_height_m_ = HEIGHT_M - EYE_BELOW_TOP_M;
    velocity_.setZero();
    wish_m_s_.setZero();
    warp(feet + btVector3(0.0f, half_height_m(shape()), 0.0f));
}

void Character::warp(const btVector3& middle) {
    controller_.reset(&physics_.world());
    controller_.warp(middle);
    body_.setWorldTransform(ghost_.getWorldTransform());
    body_.setInterpolationWorldTransform(ghost_.getWorldTransform());
}

CharacterSnapshot Character::take() const {
    CharacterSnapshot snapshot;
    snapshot.middle = to_array(ghost_.getWorldTransform().getOrigin());
    snapshot.velocity = to_array(velocity_);
    snapshot.wish = to_array(wish_m_s_);
    snapshot.eye_height_m = eye_height_m_;
    snapshot.is_crouching = is_crouching_;
    controller_.take(snapshot);
    return snapshot;
}

void Character::restore(const CharacterSnapshot& snapshot) {
    set_height(snapshot.is_crouching);
    eye_height_m_ = snapshot.eye_height_m;
    velocity_ = to_vector(snapshot.velocity);
    wish_m_s_ = to_vector(snapshot.wish);
    warp(to_vector(snapshot.middle));
    controller_.restore(snapshot);
}

btVector3 Character::feet() const {
    return ghost_.getWorldTransform().getOrigin() - btVector3(0.0f, half_height_m(shape()), 0.0f);
}

bool Character::has_room_to_stand() const {
    btTransform place = btTransform::getIdentity();
    place.setOrigin(feet() + btVector3(0.0f, HEIGHT_M - half_height_m(slim_), 0.0f));
    return !physics_.touches(slim_, place, GROUP_LEVEL | GROUP_CRATE) && !is_pierced(HEIGHT_M);
}

void Character::set_height(bool crouch) {
    is_crouching_ = crouch;
    btCapsuleShape* shape = crouch ? &low_ : &tall_;
    controller_.set_shape(shape);
    controller_.setStepHeight(crouch ? CROUCHED_STEP_HEIGHT_M : STEP_HEIGHT_M);
    body_.setCollisionShape(shape);
}

void Character::change_height(bool crouch) {
    if (crouch == is_crouching_ || (!crouch && !has_room_to_stand())) return;
    const btVector3 at = feet();
    set_height(crouch);
    controller_.warp(at + btVector3(0.0f, half_height_m(shape()), 0.0f));
}

void Character::accelerate(const WalkInput& input, btScalar dt_s) {
    const btScalar speed = is_crouching_ ? CROUCHED_M_S : input.run ? RUN_M_S : WALK_M_S;
    wish_m_s_ = input.direction * speed;
    const btVector3 missing = wish_m_s_ - velocity_;
    const btScalar most = dt_s * (controller_.onGround() ? GROUND_ACCELERATION_M_S2 : AIR_ACCELERATION_M_S2);
    const btScalar length = missing.length();
    velocity_ += length > most ? missing * (most / length) : missing;
}

// Whether a surface cuts through the middle of a body that stands here.
bool Character::is_pierced(btScalar height_m) const {
    const btVector3 low = feet() + btVector3(0.0f, SKIN_M, 0.0f);
    return physics_.is_surface_between(low, low + btVector3(0.0f, height_m - 2.0f * SKIN_M, 0.0f));
}

// The controller pushes itself out of what it is wedged into, at times to the wrong side. Where its middle
// would pass a surface, or a surface pass through it, it stays where it was.
void Character::hold(const btVector3& before) {
    const btVector3& now = ghost_.getWorldTransform().getOrigin();
    if (!physics_.is_surface_between(before, now) && !is_pierced(2.0f * half_height_m(shape()))) return;
    controller_.reset(&physics_.world());
    controller_.warp(before);
}

void Character::step(const WalkInput& input, btScalar dt_s) {
    change_height(input.crouch);
    accelerate(input, dt_s);
    if (input.jump && controller_.canJump()) controller_.jump();
    const btVector3 before = ghost_.getWorldTransform().getOrigin();
    controller_.setWalkDirection(velocity_ * dt_s);
    controller_.updateAction(&physics_.world(), dt_s);
    hold(before);
    // What a wall took away is gone: who turns from it does not have to brake first.
    btVector3 moved = (ghost_.getWorldTransform().getOrigin() - before) / dt_s;
    moved.setY(0.0f);
    if (moved.length2() < velocity_.length2()) velocity_ = moved;
    body_.setWorldTransform(ghost_.getWorldTransform());
    const btScalar eye = 2.0f * half_height_m(shape()) - EYE_BELOW_TOP_M - eye_height_m_;
    eye_height_m_ += std::clamp(eye, -EYE_SPEED_M_S * dt_s, EYE_SPEED_M_S * dt_s);
}

}  // namespace game
