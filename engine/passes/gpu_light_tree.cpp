#include "passes/gpu_light_tree.h"

namespace tarn {

void GpuLightTree::update(const LightTree& tree) {
    const Changes changes = tree.changes.read(seen_);
    if (changes.empty()) return;
    node_count_ = tree.node_count;
    const std::size_t size_bytes = tree.rows.size() * sizeof(glm::uvec4);
    const bool fits = rows_ && rows_->buffer().size_bytes() >= size_bytes;
    if (!fits) rows_.emplace("scene/light_tree", size_bytes, BufferUse::DYNAMIC, GL_RGBA32UI);
    if (!fits || changes.everything) {
        rows_->buffer().upload(0, tree.rows);
        return;
    }
    for (const IndexRange& range : changes.ranges) {
        rows_->buffer().upload(range.first * sizeof(glm::uvec4),
                               std::span(tree.rows).subspan(range.first, range.last - range.first));
    }
}

}  // namespace tarn
