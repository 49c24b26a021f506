// Balls that are thrown: they bounce, roll and come to rest.
#pragma once

#include <memory>
#include <vector>

#include "physics.h"
#include "simulation.h"

namespace game {

class Balls {
  public:
    // Balls that fall below this height, relative to the level's origin, are gone.
    Balls(Physics& physics, btScalar lowest_m);
    ~Balls();
    Balls(const Balls&) = delete;
    Balls& operator=(const Balls&) = delete;

    // A new one; the oldest makes room where there are BALL_LIMIT.
    void add(const btVector3& position, const btVector3& velocity_m_s, int color);
    // Call after the world's step. A ball whose middle has passed a surface of the level, as when somebody
    // squeezes it against a wall, is put back; those that have fallen out of the level are gone.
    void hold();
    // Writes into as many entries as BALL_LIMIT; a ball keeps its entry.
    void describe(std::vector<BallState>& balls) const;
    void take(Snapshot& snapshot) const;
    // Into a world without balls.
    void restore(const Snapshot& snapshot);

  private:
    struct Ball {
        std::unique_ptr<btRigidBody> body;  // null: free
        btVector3 last;                     // its middle after the last step
        int color = 0;
    };
    void remove(Ball& ball);
    void make(Ball& ball, const btTransform& place, int color);

    Physics& physics_;
    btScalar lowest_m_;
    btSphereShape shape_;
    std::vector<Ball> balls_;
    std::size_t next_ = 0;  // a ring: the entry after the newest is the oldest
};

}  // namespace game
