// The light tree in GL memory.
#pragma once

#include <optional>

#include "gl/row_buffer.h"
#include "world/light_tree.h"

namespace tarn {

class GpuLightTree {
  public:
    // Uploads what changed since the last call.
    void update(const LightTree& tree);

    std::uint32_t node_count() const { return node_count_; }
    // Null until a tree was uploaded.
    const RowBuffer* rows() const { return rows_ ? &*rows_ : nullptr; }

  private:
    std::optional<RowBuffer> rows_;
    std::uint32_t node_count_ = 0;
    ChangeLog::Cursor seen_;
};

}  // namespace tarn
