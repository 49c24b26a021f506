#include "firefly_lamps.h"

#include "../vectors.h"

namespace game {
namespace {

constexpr double LAMP_RADIUS_M = 0.018;
// As for balls, not so bright that the hue is lost.
constexpr Vec3 LAMP_RADIANCE = {12.0, 24.0, 0.8};

Surface lamp_surface(double brightness) {
    Surface surface;
    surface.base_color = {0.05, 0.05, 0.03};
    surface.emission = LAMP_RADIANCE * brightness;
    return surface;
}

Transform place_lamp(const Vec3& position) {
    Transform place;
    place.translation = position;
    return place;
}

}  // namespace

FireflyLamps::FireflyLamps(Scene& scene, const std::vector<FireflyState>& fireflies, const Vec3& hidden)
    : scene_(scene), hidden_(hidden) {
    for (const FireflyState& state : fireflies) {
        Lamp lamp;
        lamp.shown = state.brightness;
        lamp.node = scene.add_sphere(LAMP_RADIUS_M, 0, lamp_surface(lamp.shown), place_lamp(state.position));
        lamp.material = scene.materials(lamp.node).at(0);
        lamps_.push_back(lamp);
    }
}

void FireflyLamps::show_lamp(Lamp& lamp, const FireflyState& state, bool is_lit) {
    const double brightness = is_lit ? state.brightness : 0.0;
    if (brightness == 0.0 && lamp.shown == 0.0) return;
    scene_.set_transform(lamp.node, place_lamp(is_lit ? state.position : hidden_));
    if (brightness != lamp.shown) scene_.set_surface(lamp.material, lamp_surface(brightness));
    lamp.shown = brightness;
}

void FireflyLamps::show(const std::vector<FireflyState>& fireflies, int lit) {
    for (std::size_t i = 0; i < lamps_.size(); ++i) show_lamp(lamps_[i], fireflies[i], int(i) < lit);
}

}  // namespace game
