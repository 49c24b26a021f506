// Wooden crates that stand about: a person pushes them, balls bounce off them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "character.h"
#include "physics.h"
#include "simulation.h"

namespace game {

class Crates {
  public:
    // None yet. Crates that fall below `lowest_m` start again.
    Crates(Physics& physics, btScalar lowest_m);
    ~Crates();
    Crates(const Crates&) = delete;
    Crates& operator=(const Crates&) = delete;

    // Those of the level's places that have room and a floor, each dropped onto what is below it.
    void place(const Level& level);
    // Those of other crates of the same level, with their starts.
    void restore(const Crates& others, const std::vector<BodySnapshot>& snapshots);
    std::vector<BodySnapshot> take() const;
    // Pushes what stands in the way of who walks. Call before the world's step of `dt_s` seconds.
    void push(const Character& character, btScalar dt_s);
    // Call after the world's step. A crate whose middle has passed a surface of the level is put back.
    void hold();
    void describe(std::vector<CrateState>& crates) const;

  private:
    struct Crate {
        btTransform start = btTransform::getIdentity();
        std::unique_ptr<btRigidBody> body;
        btVector3 last{0.0f, 0.0f, 0.0f};  // its middle after the last step
    };

    std::optional<btTransform> find_place(const CratePlace& place, btScalar depth_m) const;
    void add(Crate& crate, const btTransform& place);
    void remove(Crate& crate);

    Physics& physics_;
    btScalar lowest_m_;
    btBoxShape shape_;
    std::vector<Crate> crates_;
};

}  // namespace game
