// Procedural pictures, all of them tileable. Base colours are sRGB, normal maps have +Y up as glTF asks.
#pragma once

#include <cstdint>

#include "content/gltf_writer.h"

namespace tarn::content {

// Pictures of one surface made from one height field.
struct SurfacePictures {
    Picture base_color;
    Picture normal;
    Picture roughness;  // green: roughness, blue: metallic, as glTF packs them
};

// Rounded cobble stones in mortar; one picture spans 8 x 8 stones.
SurfacePictures make_cobbles(int size, std::uint64_t seed);

// Courses of cut stone, 4 wide and 8 high, in running bond.
SurfacePictures make_ashlar(int size, std::uint64_t seed);

// Lime plaster with stains.
Picture make_plaster(int size, std::uint64_t seed);

// Six planks side by side, the grain along v.
Picture make_planks(int size, std::uint64_t seed);

// Fired clay, for roof tiles.
Picture make_clay(int size, std::uint64_t seed);

// White and grey stripes along v, to be tinted by a base colour.
Picture make_stripes(int size, std::uint64_t seed);

// A twig with leaves; alpha is 0 between them.
Picture make_leaves(int size, std::uint64_t seed);

// Leaded panes behind which a light flickers: emission.
Picture make_leaded_window(int size, std::uint64_t seed);

}  // namespace tarn::content
