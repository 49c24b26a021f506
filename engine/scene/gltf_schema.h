// The JSON of a glTF file against the part of its schema that Tarn reads: types, required properties,
// references.
#pragma once

#include <nlohmann/json.hpp>

namespace tarn {

// Throws Error naming the path ("meshes[0].primitives[2].indices"), the value and the limit for the first
// property that is missing, of a wrong type, not finite in single precision, or that refers to an entry that
// is not there. Unknown properties pass.
void check_gltf_json(const nlohmann::json& root);

}  // namespace tarn
