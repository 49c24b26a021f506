// What the rays of tests of antialiasing meet: a wall with an edge, waves, even light.
#pragma once

#include <cmath>

#include "gpu/antialias_stage.h"

namespace tarn::test {

constexpr glm::ivec2 OUTPUT_PX(62, 43);  // no multiple of a group
constexpr double SCALES[] = {1.0, 0.75, 0.5, 0.33};

constexpr glm::vec3 WALK(0.031f, 0.017f, 0.0f);  // a frame: parts of a pixel of the wall, 0.12 m wide

inline glm::vec3 meet_plane(const glm::vec3& origin, const glm::vec3& direction, float z) {
    return origin + direction * ((z - origin.z) / direction.z);
}

// A wall at 5 m with a slanted edge: 1 on one side, 0.1 on the other.
inline Sight see_edge(const glm::vec3& origin, const glm::vec3& direction) {
    Sight sight;
    sight.position = sight.previous = meet_plane(origin, direction, -5.0f);
    sight.radiance = glm::vec3(sight.position.x + 0.37f * sight.position.y > 0.2f ? 1.0f : 0.1f);
    return sight;
}

// The same wall in waves of some pixels.
inline Sight see_waves(const glm::vec3& origin, const glm::vec3& direction) {
    Sight sight = see_edge(origin, direction);
    sight.radiance = glm::vec3(0.5f) + 0.4f * glm::vec3(std::sin(11.0f * sight.position.x),
                                                        std::sin(9.0f * sight.position.y), 0.0f);
    return sight;
}

inline SightOf see_even(const glm::vec3& radiance) {
    return [radiance](const glm::vec3& origin, const glm::vec3& direction) {
        Sight sight = see_edge(origin, direction);
        sight.is_sky = sight.position.y > 0.5f;
        sight.radiance = radiance;
        return sight;
    };
}

}  // namespace tarn::test
