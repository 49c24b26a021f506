// Fireflies as the scene has them: tiny balls that shine.
#pragma once

#include <vector>

#include "../play/simulation.h"

namespace game {

class FireflyLamps {
  public:
    // Adds a ball for each, where they are now: before the first frame. `hidden`: where nobody sees them. The
    // scene must outlive this.
    FireflyLamps(Scene& scene, const std::vector<FireflyState>& fireflies, const Vec3& hidden);

    // Moves and dims the first `lit` of them; the others are dark and out of sight.
    void show(const std::vector<FireflyState>& fireflies, int lit);

  private:
    struct Lamp {
        Node node;
        std::size_t material = 0;
        double shown = 0.0;  // its brightness; 0: out of sight
    };

    void show_lamp(Lamp& lamp, const FireflyState& state, bool is_lit);

    Scene& scene_;
    Vec3 hidden_;
    std::vector<Lamp> lamps_;
};

}  // namespace game
