#include "world/light_tree.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "shared/math/light_tree.h"
#include "world/light_tree_builder.h"

namespace tarn {
namespace {

constexpr std::size_t TASK_LIGHTS = 1024;  // worth a task of their own
constexpr std::uint32_t TASK_DEPTH = 8;    // down to which fitting makes tasks
constexpr std::uint32_t FIRST_PAIR = 2;    // node 0 is the root, the place of node 1 is the header's
constexpr std::uint32_t JOINED_NODES =
    32;  // gaps between changed nodes that are not worth a range of their own

Light read_light(const WorldLights& lights, std::uint32_t index) {
    const glm::uvec4* rows = &lights.rows[std::size_t(index) * LIGHT_ROWS];
    return unpack_light(rows[0], rows[1], rows[2], rows[3]);
}

bool is_directional(const Light& light) {
    return (light.flags & LIGHT_KIND_MASK) == LIGHT_DIRECTIONAL;
}

bool belongs_in_tree(const WorldLights& lights, std::uint32_t index) {
    return lights.powers[index] > 0.0 && !is_directional(read_light(lights, index));
}

// Packs the bounds of a node: a sphere around the box, which allows for the rounding of places on the lights,
// and a cone that allows for that of its axis.
void write_node(LightTree& tree, std::uint32_t node, std::uint32_t link) {
    const LightBounds& bounds = tree.bounds[node];
    LightTreeNode packed;
    packed.centre = bounds.centre();
    const glm::vec3 farthest = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    packed.radius = glm::length(glm::max(bounds.upper - packed.centre, packed.centre - bounds.lower)) +
                    4.0f * FLT_EPSILON * max_component(farthest);
    packed.axis = bounds.axis;
    const glm::vec3 rounded = unpack_axis(pack_axis(bounds.axis));
    const float turned_rad =
        std::atan2(glm::length(glm::cross(rounded, bounds.axis)), glm::dot(rounded, bounds.axis));
    packed.cos_normals = std::cos(std::min(bounds.normals_rad + turned_rad, PI));
    packed.cos_emission = std::cos(bounds.emission_rad);
    packed.intensity = bounds.intensity;
    packed.link = link | (bounds.two_sided ? LIGHT_TREE_TWO_SIDED : 0u);
    glm::uvec4* rows = &tree.rows[std::size_t(node) * LIGHT_TREE_NODE_ROWS];
    pack_light_tree_node(packed, rows[0], rows[1]);
}

std::uint32_t link_of(const LightTree& tree, std::uint32_t node) {
    return tree.rows[std::size_t(node) * LIGHT_TREE_NODE_ROWS + 1].w & ~LIGHT_TREE_TWO_SIDED;
}

void write_inner_node(LightTree& tree, std::uint32_t node, std::uint32_t first_child) {
    tree.bounds[node] = unite(tree.bounds[first_child], tree.bounds[first_child + 1]);
    write_node(tree, node, first_child);
}

// ---- Building
// ---------------------------------------------------------------------------------------------------

// Lights [first, first + count), which become what is below `node`. Their pairs are numbered from `pair` on.
struct Branch {
    std::size_t first = 0;
    std::size_t count = 0;
    std::uint32_t node = 0;
    std::uint32_t pair = 0;
    std::uint32_t depth = 0;
    std::uint32_t trail = 0;
};

class Builder {
  public:
    Builder(LightTree& tree, const WorldLights& lights) : tree_(tree), trails_(lights.count) {
        for (std::uint32_t i = 0; i < lights.count; ++i) {
            if (is_directional(read_light(lights, i))) directional_.push_back(i);
            if (belongs_in_tree(lights, i)) lights_.push_back({{}, i});
        }
        tbb::parallel_for(std::size_t(0), lights_.size(), [&](std::size_t i) {
            const std::uint32_t light = lights_[i].light;
            lights_[i].bounds = bound_light(read_light(lights, light), lights.powers[light]);
        });
    }

    void build() {
        if (lights_.empty() && directional_.empty()) return;
        const std::uint32_t count = std::uint32_t(lights_.size());
        tree_.node_count = std::max(2 * count, FIRST_PAIR);
        tree_.rows.resize(std::size_t(tree_.node_count) * LIGHT_TREE_NODE_ROWS);
        tree_.bounds.resize(tree_.node_count);
        tree_.parents.resize(count > 0 ? count - 1 : 0);
        tree_.leaves.assign(trails_.size(), INVALID_INDEX);
        if (count > 0) build_branch({0, count, 0, 0, 0, 0});
        append_lists();
    }

  private:
    void build_branch(const Branch& branch) {
        if (branch.count == 1) {
            const BoundedLight& leaf = lights_[branch.first];
            tree_.bounds[branch.node] = leaf.bounds;
            tree_.leaves[leaf.light] = branch.node;
            trails_[leaf.light] = branch.trail;
            write_node(tree_, branch.node, leaf.light | LIGHT_TREE_LEAF);
            return;
        }
        const std::size_t left_count =
            divide_lights(&lights_[branch.first], branch.count, LIGHT_TREE_MAX_DEPTH - branch.depth);
        const std::uint32_t first_child = FIRST_PAIR + 2 * branch.pair;
        tree_.parents[branch.pair] = branch.node;
        const Branch left = {branch.first,    left_count,       first_child,
                             branch.pair + 1, branch.depth + 1, branch.trail};
        const Branch right = {branch.first + left_count, branch.count - left_count,
                              first_child + 1,           branch.pair + std::uint32_t(left_count),
                              branch.depth + 1,          branch.trail | (1u << branch.depth)};
        if (branch.count > TASK_LIGHTS) {
            tbb::parallel_invoke([&] { build_branch(left); }, [&] { build_branch(right); });
        } else {
            build_branch(left);
            build_branch(right);
        }
        write_inner_node(tree_, branch.node, first_child);
    }

    void append_lists() {
        LightTreeHeader header;
        header.directional_count = std::uint32_t(directional_.size());
        header.directional_row = directional_.empty() ? 0u : append_words(directional_);
        header.trail_row = append_words(trails_);
        header.light_count = std::uint32_t(lights_.size());
        tree_.rows[LIGHT_TREE_HEADER_ROW] = pack_light_tree_header(header);
    }

    std::uint32_t append_words(const std::vector<std::uint32_t>& words) {
        const std::size_t first = tree_.rows.size();
        tree_.rows.resize(first + (words.size() + 3) / 4);
        for (std::size_t i = 0; i < words.size(); ++i) tree_.rows[first + i / 4][int(i % 4)] = words[i];
        return std::uint32_t(first);
    }

    LightTree& tree_;
    std::vector<BoundedLight> lights_;
    std::vector<std::uint32_t> directional_;
    std::vector<std::uint32_t> trails_;  // by light of the whole table
};

void build_tree(LightTree& tree, const WorldLights& lights) {
    LightTree built;
    Builder(built, lights).build();
    built.changes = std::move(tree.changes);
    built.changes.append_everything();
    built.structure_revision = tree.structure_revision + 1;
    built.lights_seen = tree.lights_seen;
    tree = std::move(built);
}

// ---- Fitting
// ----------------------------------------------------------------------------------------------------

// Fits the bounds of leaves and of all that is above them.
class Fitter {
  public:
    explicit Fitter(LightTree& tree) : tree_(tree), is_stale_(tree.node_count) {}

    void add(std::uint32_t node, const Light& light, double power) {
        tree_.bounds[node] = bound_light(light, power);
        write_node(tree_, node, link_of(tree_, node));
        is_stale_[node] = 1;
        while (node != 0) {
            node = tree_.parents[(node - FIRST_PAIR) / 2];
            if (is_stale_[node]) break;
            is_stale_[node] = 1;
        }
    }

    void fit() {
        fit_node(0, 0);
        std::vector<IndexRange> rows = list_changed_rows();
        if (!rows.empty()) tree_.changes.append(std::move(rows));
    }

  private:
    void fit_node(std::uint32_t node, std::uint32_t depth) {
        const std::uint32_t link = link_of(tree_, node);
        if (!is_stale_[node] || (link & LIGHT_TREE_LEAF) != 0u) return;
        if (depth < TASK_DEPTH) {
            tbb::parallel_invoke([&] { fit_node(link, depth + 1); }, [&] { fit_node(link + 1, depth + 1); });
        } else {
            fit_node(link, depth + 1);
            fit_node(link + 1, depth + 1);
        }
        write_inner_node(tree_, node, link);
    }

    std::vector<IndexRange> list_changed_rows() const {
        std::vector<IndexRange> ranges;
        for (std::uint32_t node = 0; node < is_stale_.size(); ++node) {
            if (!is_stale_[node]) continue;
            const std::uint32_t first = node * LIGHT_TREE_NODE_ROWS, last = first + LIGHT_TREE_NODE_ROWS;
            if (!ranges.empty() && first <= ranges.back().last + JOINED_NODES * LIGHT_TREE_NODE_ROWS) {
                ranges.back().last = last;
            } else {
                ranges.push_back({first, last});
            }
        }
        return ranges;
    }

    LightTree& tree_;
    std::vector<std::uint8_t> is_stale_;  // by node
};

// Fits what moved; false where the tree must be built instead.
bool fit_tree(LightTree& tree, const WorldLights& lights, const Changes& changes) {
    if (tree.order_revision != lights.order_revision) return false;
    const std::vector<IndexRange> all = {{0u, lights.count}};
    Fitter fitter(tree);
    for (const IndexRange& range : changes.everything ? all : changes.ranges) {
        for (std::uint32_t light = range.first; light < range.last; ++light) {
            const bool is_in_tree = light < tree.leaves.size() && tree.leaves[light] != INVALID_INDEX;
            if (belongs_in_tree(lights, light) != is_in_tree) return false;
            if (is_in_tree) fitter.add(tree.leaves[light], read_light(lights, light), lights.powers[light]);
        }
    }
    fitter.fit();
    return true;
}

}  // namespace

void update_light_tree(LightTree& tree, const WorldLights& lights) {
    if (!lights.changes.has_news(tree.lights_seen)) return;
    const Changes changes = lights.changes.read(tree.lights_seen);
    if (tree.structure_revision == 0 || !fit_tree(tree, lights, changes)) build_tree(tree, lights);
    tree.order_revision = lights.order_revision;
}

}  // namespace tarn
