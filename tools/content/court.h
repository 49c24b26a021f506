// What the builders of the lantern court share: measures, materials and colours, and one function for each
// group.
#pragma once

#include <array>

#include "content/gltf_writer.h"
#include "content/portable_math.h"

namespace tarn::content {

// The open court spans x = +-HALF_X_M, z = +-HALF_Z_M between the centre lines of the arcades.
inline constexpr float HALF_X_M = 15.0f;
inline constexpr float HALF_Z_M = 12.0f;
inline constexpr float BAY_M = 3.0f;
inline constexpr float GALLERY_DEPTH_M = 3.75f;  // from the arcade's centre line to the back wall
inline constexpr float TERRACE_M = 0.15f;        // ground gallery floor
inline constexpr float UPPER_FLOOR_M = 4.05f;
inline constexpr float CORNICE_M = 6.9f;
inline constexpr float PARAPET_M = 0.95f;

// Indices of lantern colours and kinds.
inline constexpr int COLORS = 8;

struct CourtMaterials {
    int cobbles, ashlar, dressed_stone, plaster, planks, dark_wood, clay, bark, leaves, soil;
    int brass, iron, water, puddle, window, lamp, bright_lamp, terracotta, paint_blue;
    std::array<int, 4> cloth;
    std::array<int, 4> fruit;
    std::array<int, COLORS> glow;
};

CourtMaterials make_court_materials(GltfWriter& writer, std::uint64_t seed);

// One side of the court: its bays run along local +x, local +z points into the court.
struct Side {
    const char* name;
    int bays;
    double turn_rad;   // about +Y
    glm::vec3 middle;  // of the arcade's centre line, on the ground
    // The frame of one bay: its origin on the ground in the middle of the bay.
    Placement bay(int index) const;
    // The frame of bays 2 * index and 2 * index + 1 together.
    Placement bay_pair(int index) const;
    glm::vec3 to_world(const glm::vec3& local) const;
};
std::array<Side, 4> court_sides();

void add_architecture(GltfWriter& writer, const CourtMaterials& materials);
void add_stairs(GltfWriter& writer, const CourtMaterials& materials);
void add_fountain(GltfWriter& writer, const CourtMaterials& materials);
void add_furnishings(GltfWriter& writer, const CourtMaterials& materials, const Random& random);
void add_stalls(GltfWriter& writer, const CourtMaterials& materials, const Random& random);
void add_plants(GltfWriter& writer, const CourtMaterials& materials, const Random& random);
void add_lanterns(GltfWriter& writer, const CourtMaterials& materials, const Random& random);

// Where the trees stand, on the ground.
std::array<glm::vec3, 4> tree_places();

}  // namespace tarn::content
