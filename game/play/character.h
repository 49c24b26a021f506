// A person's body that walks: a capsule, moved by Bullet's kinematic character controller.
#pragma once

#include <BulletDynamics/Character/btKinematicCharacterController.h>

#include "physics.h"

namespace game {

struct WalkInput {
    btVector3 direction{0.0f, 0.0f, 0.0f};  // in the plane of the floor, at most 1 long
    bool run = false;
    bool crouch = false;
    bool jump = false;
};

class Character {
  public:
    // Stands with its feet here.
    Character(Physics& physics, const btVector3& feet);
    ~Character();
    Character(const Character&) = delete;
    Character& operator=(const Character&) = delete;

    // Goes on by `dt_s` seconds; call before the world's own step.
    void step(const WalkInput& input, btScalar dt_s);
    void teleport(const btVector3& feet);
    CharacterSnapshot take() const;
    void restore(const CharacterSnapshot& snapshot);

    btVector3 feet() const;
    btScalar eye_height_m() const { return eye_height_m_; }
    bool is_on_ground() const { return controller_.onGround(); }
    bool is_crouching() const { return is_crouching_; }
    // Where its middle is, and its shape.
    const btTransform& place() const { return ghost_.getWorldTransform(); }
    const btCapsuleShape& shape() const { return is_crouching_ ? low_ : tall_; }
    // Where it wants to, in the plane of the floor, whatever is in its way.
    const btVector3& wish_m_s() const { return wish_m_s_; }

    static constexpr btScalar RADIUS_M = 0.3f;
    static constexpr btScalar HEIGHT_M = 1.75f;
    static constexpr btScalar STEP_HEIGHT_M = 0.35f;

  private:
    // Bullet's controller holds its shape for good; a crouching one is lower.
    class Controller : public btKinematicCharacterController {
      public:
        using btKinematicCharacterController::btKinematicCharacterController;
        void set_shape(btConvexShape* shape) {
            m_convexShape = shape;
            m_ghostObject->setCollisionShape(shape);
        }
        void take(CharacterSnapshot& snapshot) const {
            snapshot.rise_m_s = m_verticalVelocity;
            snapshot.rise_m = m_verticalOffset;
            snapshot.was_on_ground = m_wasOnGround;
            snapshot.was_jumping = m_wasJumping;
        }
        void restore(const CharacterSnapshot& snapshot) {
            m_verticalVelocity = snapshot.rise_m_s;
            m_verticalOffset = snapshot.rise_m;
            m_wasOnGround = snapshot.was_on_ground;
            m_wasJumping = snapshot.was_jumping;
            m_jumpAxis = m_up;  // else only jump() sets it, and who is in the air would be led aside
        }
    };

    static btScalar half_height_m(const btCapsuleShape& shape) {
        return shape.getHalfHeight() + shape.getRadius();
    }
    void set_height(bool crouch);
    void warp(const btVector3& middle);
    void change_height(bool crouch);
    bool has_room_to_stand() const;
    bool is_pierced(btScalar height_m) const;
    void hold(const btVector3& before);
    void accelerate(const WalkInput& input, btScalar dt_s);

    Physics& physics_;
    btCapsuleShape tall_;
    btCapsuleShape low_;
    btCapsuleShape slim_;  // for looking whether there is room to stand
    btPairCachingGhostObject ghost_;
    Controller controller_;
    btRigidBody body_;  // follows, and pushes balls
    btVector3 velocity_{0.0f, 0.0f, 0.0f};
    btVector3 wish_m_s_{0.0f, 0.0f, 0.0f};
    btScalar eye_height_m_;
    bool is_crouching_ = false;
};

}  // namespace game
