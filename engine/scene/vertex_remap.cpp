// Gathers every vertex attribute of a mesh into a new order.
#include "scene/vertex_remap.h"

namespace tarn {
namespace {

// Attributes that hold several sets one after the other have `set_size` entries in each.
template <class Value>
void gather(std::vector<Value>& values, const std::vector<std::uint32_t>& sources, std::size_t set_size) {
    if (values.empty()) return;
    const std::size_t sets = values.size() / set_size;
    std::vector<Value> gathered;
    gathered.reserve(sets * sources.size());
    for (std::size_t set = 0; set < sets; ++set) {
        for (const std::uint32_t source : sources) gathered.push_back(values[set * set_size + source]);
    }
    values = std::move(gathered);
}

}  // namespace

void remap_vertices(Mesh& mesh, const std::vector<std::uint32_t>& sources) {
    const std::size_t count = mesh.positions_os.size();
    gather(mesh.positions_os, sources, count);
    gather(mesh.normals_os, sources, count);
    gather(mesh.tangents_os, sources, count);
    gather(mesh.uv0, sources, count);
    gather(mesh.uv1, sources, count);
    gather(mesh.colors, sources, count);
    gather(mesh.joints, sources, count);
    gather(mesh.weights, sources, count);
    for (MorphTarget& target : mesh.morph_targets) {
        gather(target.positions_os, sources, count);
        gather(target.normals_os, sources, count);
        gather(target.tangents_os, sources, count);
    }
}

}  // namespace tarn
