#include "balls.h"

namespace game {
namespace {

constexpr btScalar BALL_KG = 0.4f;

}  // namespace

Balls::Balls(Physics& physics, btScalar lowest_m)
    : physics_(physics),
      lowest_m_(lowest_m),
      shape_(btScalar(BALL_RADIUS_M)),
      balls_(std::size_t(BALL_LIMIT)) {}

Balls::~Balls() {
    clear();
}

void Balls::remove(Ball& ball) {
    if (!ball.body) return;
    physics_.world().removeRigidBody(ball.body.get());
    ball.body.reset();
}

void Balls::clear() {
    for (Ball& ball : balls_) {
        remove(ball);
        ball.color = 0;
    }
    next_ = 0;
}

void Balls::add(const btVector3& position, const btVector3& velocity_m_s, int color) {
    Ball& ball = balls_[next_];
    next_ = (next_ + 1) % balls_.size();
    remove(ball);
    btVector3 inertia;
    shape_.calculateLocalInertia(BALL_KG, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(BALL_KG, nullptr, &shape_, inertia);
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin(position);
    info.m_friction = 0.7f;
    info.m_restitution = 0.62f;
    info.m_rollingFriction = 0.012f;
    info.m_spinningFriction = 0.012f;
    info.m_linearDamping = 0.03f;
    info.m_angularDamping = 0.25f;
    ball.body = std::make_unique<btRigidBody>(info);
    ball.last = position;
    ball.color = color;
    ball.body->setLinearVelocity(velocity_m_s);
    // A fast ball moves by more than its radius in a step.
    ball.body->setCcdMotionThreshold(btScalar(0.5 * BALL_RADIUS_M));
    ball.body->setCcdSweptSphereRadius(btScalar(0.5 * BALL_RADIUS_M));
    physics_.world().addRigidBody(ball.body.get(), GROUP_BALL,
                                  GROUP_LEVEL | GROUP_BALL | GROUP_BODY | GROUP_CRATE);
}

void Balls::hold() {
    for (Ball& ball : balls_) {
        if (!ball.body) continue;
        if (physics_.is_surface_between(ball.last, ball.body->getWorldTransform().getOrigin())) {
            ball.body->getWorldTransform().setOrigin(ball.last);
            ball.body->setInterpolationWorldTransform(ball.body->getWorldTransform());
            ball.body->setLinearVelocity(btVector3(0.0f, 0.0f, 0.0f));
        }
        ball.last = ball.body->getWorldTransform().getOrigin();
        if (!(ball.last.y() >= lowest_m_)) remove(ball);
    }
}

void Balls::describe(std::vector<BallState>& balls) const {
    balls.resize(balls_.size());
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        balls[i] = {};
        balls[i].color = balls_[i].color;
        if (!balls_[i].body) continue;
        const btTransform& place = balls_[i].body->getWorldTransform();
        const btQuaternion turn = place.getRotation();
        const btVector3& velocity = balls_[i].body->getLinearVelocity();
        balls[i].is_alive = true;
        balls[i].position = physics_.to_world(place.getOrigin());
        balls[i].rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
        balls[i].velocity = {velocity.x(), velocity.y(), velocity.z()};
    }
}

}  // namespace game
