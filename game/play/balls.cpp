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
    for (Ball& ball : balls_) remove(ball);
}

void Balls::remove(Ball& ball) {
    if (!ball.body) return;
    physics_.world().removeRigidBody(ball.body.get());
    ball.body.reset();
}

void Balls::add(const btVector3& position, const btVector3& velocity_m_s, int color) {
    Ball& ball = balls_[next_];
    next_ = (next_ + 1) % balls_.size();
    remove(ball);
    make(ball, btTransform(btMatrix3x3::getIdentity(), position), color);
    ball.body->setLinearVelocity(velocity_m_s);
}

void Balls::make(Ball& ball, const btTransform& place, int color) {
    btVector3 inertia;
    shape_.calculateLocalInertia(BALL_KG, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(BALL_KG, nullptr, &shape_, inertia);
    info.m_startWorldTransform = place;
    info.m_friction = 0.7f;
    info.m_restitution = 0.62f;
    info.m_rollingFriction = 0.012f;
    info.m_spinningFriction = 0.012f;
    info.m_linearDamping = 0.03f;
    info.m_angularDamping = 0.25f;
    ball.body = std::make_unique<btRigidBody>(info);
    ball.last = place.getOrigin();
    ball.color = color;
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

void Balls::take(Snapshot& snapshot) const {
    snapshot.balls.assign(balls_.size(), {});
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        BallSnapshot& ball = snapshot.balls[i];
        ball.is_alive = balls_[i].body != nullptr;
        ball.color = balls_[i].color;
        if (ball.is_alive) ball.body = take_snapshot(*balls_[i].body);
    }
    snapshot.next_ball = int(next_);
}

void Balls::restore(const Snapshot& snapshot) {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        const BallSnapshot& ball = snapshot.balls[i];
        balls_[i].color = ball.color;
        if (!ball.is_alive) continue;
        make(balls_[i], place_of(ball.body), ball.color);
        restore_motion(*balls_[i].body, ball.body);
    }
    next_ = std::size_t(snapshot.next_ball);
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
