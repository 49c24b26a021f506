// A pose that follows its scene: only nodes that animate or were moved, and what hangs below them, are
// computed anew.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/pose.h"

namespace tarn {

class LivePose {
  public:
    // As evaluate_pose, all anew; to be called after any edit but those that follow() is told of.
    void reset(const Scene& scene, double time_s);

    // Comes to the same bits as reset() where, since the latest call, nothing was edited but the transforms
    // of `moved` (in any order, with repeats).
    void follow(const Scene& scene, double time_s, std::span<const NodeIndex> moved);

    const Pose& pose() const { return pose_; }
    // Nodes whose transform the latest follow() computed; each once.
    const std::vector<NodeIndex>& touched() const { return touched_; }

  private:
    void list_children(const Scene& scene);
    void list_animated(const Scene& scene);
    void evaluate_animations(const Scene& scene, double time_s);
    void touch_below(const Scene& scene, NodeIndex root);

    Pose pose_;
    std::vector<NodeIndex> touched_;
    std::vector<std::uint32_t> first_child_;  // into children_, one a node and one more
    std::vector<NodeIndex> children_;
    std::vector<NodeIndex> animated_;              // nodes with a channel, each once
    std::vector<Transform> animated_locals_;       // theirs
    std::vector<std::uint32_t> animated_of_node_;  // index into the two above; none: UINT32_MAX
    std::vector<bool> is_root_;                    // scratch of follow()
    std::vector<NodeIndex> stack_;                 // scratch of touch_below()
};

}  // namespace tarn
