#include "passes/gpu_light_tree.h"

namespace tarn {

void GpuLightTree::update(const LightTree& tree) {
    if (tree.revision == revision_) return;
    const std::size_t size_bytes = tree.rows.size() * sizeof(glm::uvec4);
    const bool only_ranges = tree.structure_revision == structure_revision_ && tree.revision == revision_ + 1;
    if (!rows_ || rows_->buffer().size_bytes() < size_bytes) {
        rows_.emplace("scene/light_tree", size_bytes, BufferUse::DYNAMIC, GL_RGBA32UI);
        rows_->buffer().upload(0, tree.rows);
    } else if (only_ranges) {
        for (const IndexRange& range : tree.changed) {
            rows_->buffer().upload(range.first * sizeof(glm::uvec4),
                                   std::span(tree.rows).subspan(range.first, range.last - range.first));
        }
    } else {
        rows_->buffer().upload(0, tree.rows);
    }
    node_count_ = tree.node_count;
    revision_ = tree.revision;
    structure_revision_ = tree.structure_revision;
}

}  // namespace tarn
