// Where everything is at one moment: animation evaluated, transforms multiplied out, vertices deformed.
#pragma once

#include <functional>
#include <vector>

#include "scene/scene.h"

namespace tarn {

struct Pose {
    std::vector<glm::dmat4> world_from_node;        // per node
    std::vector<std::vector<float>> morph_weights;  // per node; empty where the node has none
};

// The pose at `time_s`: every animation of the scene plays at once, each looping over its own duration.
// `time_s` < 0 gives the rest pose.
Pose evaluate_pose(const Scene& scene, double time_s);

// What animations write of a node.
struct AnimatedNode {
    Transform& local;
    std::vector<float>& morph_weights;
};

// Lets every animation write into the nodes that `find_node` gives for their channels. Nothing for
// `time_s` < 0, the rest pose.
void apply_animations(const Scene& scene, double time_s,
                      const std::function<AnimatedNode(NodeIndex)>& find_node);

// Where `local` places a node in its parent; a matrix that the file gave goes first.
glm::dmat4 local_matrix(const Node& node, const Transform& local);

// Vertices of one instance after morph targets and skin.
struct DeformedMesh {
    std::vector<glm::vec3> positions_os;
    std::vector<glm::vec3> normals_os;
    std::vector<glm::vec4> tangents_os;
};

// Deforms `instance` on the CPU. For a skinned instance the result is in the space of
// `world_from_instance()`: ws shifted by -origin_ws, so that single precision suffices far from the world's
// origin.
DeformedMesh deform_mesh(const Scene& scene, const Instance& instance, const Pose& pose,
                         const glm::dvec3& origin_ws);

// The transform that places an instance's (deformed) vertices in ws - origin_ws. Skinned: the identity.
glm::dmat4 origin_from_object(const Scene& scene, const Instance& instance, const Pose& pose,
                              const glm::dvec3& origin_ws);

// World bounds of everything that has triangles, in this pose. Empty for a scene without triangles.
Bounds compute_bounds(const Scene& scene, const Pose& pose);

}  // namespace tarn
