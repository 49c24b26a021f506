// What building and updating the table of lights share. Private to this folder.
#pragma once

#include "shared/math/light.h"
#include "world/light_sources.h"
#include "world/world.h"

namespace tarn {

// Writes the rows of light `index`, which must exist. The place of an emission map is kept.
inline void write_light(WorldLights& lights, std::uint32_t index, Light light) {
    glm::uvec4* rows = &lights.rows[std::size_t(index) * LIGHT_ROWS];
    if ((light.flags & LIGHT_TEXTURED) != 0u) light.range = uintBitsToFloat(rows[3].w);
    pack_light(light, rows[0], rows[1], rows[2], rows[3]);
}

// `emitter` as it is now, with its lights.
EmissiveInstance record_emissive_instance(const World& world, const Emitter& emitter,
                                          const IndexRange& lights);

// Products of the transform's axes: what a rigid motion leaves alone.
glm::mat3 measure_scale(const glm::mat4& world_from_object);

void rebuild_alias_table(WorldLights& lights);

}  // namespace tarn
