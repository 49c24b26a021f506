// Generates normals and tangents.
#include "scene/normals_tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "scene/vertex_remap.h"

namespace tarn {
namespace {

const glm::vec3 FALLBACK_NORMAL(0.0f, 0.0f, 1.0f);

// In double: the product of two edges may leave the range of float.
glm::dvec3 area_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

glm::vec3 normalized_or(const glm::dvec3& vector, const glm::vec3& otherwise) {
    const double length = glm::length(vector);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(vector / length) : otherwise;
}

std::vector<glm::vec3> compute_flat_normals(const Mesh& mesh, const std::vector<glm::vec3>& positions) {
    std::vector<glm::vec3> normals(positions.size(), FALLBACK_NORMAL);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 normal = area_normal(positions[t.x], positions[t.y], positions[t.z]);
        for (int c = 0; c < 3; ++c) normals[t[c]] = normalized_or(normal, FALLBACK_NORMAL);
    }
    return normals;
}

// Union-find over triangle corners.
class Groups {
  public:
    explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }

    // The smaller root wins, so that the result does not depend on the order of the unions.
    void join(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t root_a = root(a);
        const std::uint32_t root_b = root(b);
        parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

struct VertexKey {
    std::array<float, 8> values;  // position, normal, uv
    bool operator==(const VertexKey&) const = default;
};

struct VertexKeyHash {
    std::size_t operator()(const VertexKey& key) const {
        std::uint64_t hash = 1469598103934665603ull;
        for (const float value : key.values) {
            std::uint32_t bits = 0;
            std::memcpy(&bits, &value, sizeof(bits));
            hash = (hash ^ bits) * 1099511628211ull;
        }
        return std::size_t(hash ^ (hash >> 29));
    }
};

// Vertices that look the same get the same number: glTF files often do not share them.
std::vector<std::uint32_t> weld_vertices(const Mesh& mesh, const std::vector<glm::vec2>& uv) {
    std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> numbers;
    numbers.reserve(mesh.positions_os.size());
    std::vector<std::uint32_t> welded(mesh.positions_os.size());
    for (std::size_t v = 0; v < welded.size(); ++v) {
        const glm::vec3& p = mesh.positions_os[v];
        const glm::vec3& n = mesh.normals_os[v];
        VertexKey key{{p.x, p.y, p.z, n.x, n.y, n.z, uv[v].x, uv[v].y}};
        for (float& value : key.values) value += 0.0f;  // -0 becomes +0
        welded[v] = numbers.try_emplace(key, std::uint32_t(v)).first->second;
    }
    return welded;
}

// Direction of growing u over one triangle. Handedness 0: the uv have no area.
struct TriangleFrame {
    glm::dvec3 tangent{0.0};
    int handedness = 0;
};

TriangleFrame frame_of(const Mesh& mesh, const std::vector<glm::vec2>& uv, const glm::uvec3& t) {
    const glm::dvec2 uv1 = glm::dvec2(uv[t.y]) - glm::dvec2(uv[t.x]);
    const glm::dvec2 uv2 = glm::dvec2(uv[t.z]) - glm::dvec2(uv[t.x]);
    const glm::dvec3 edge1 = glm::dvec3(mesh.positions_os[t.y]) - glm::dvec3(mesh.positions_os[t.x]);
    const glm::dvec3 edge2 = glm::dvec3(mesh.positions_os[t.z]) - glm::dvec3(mesh.positions_os[t.x]);
    const double uv_area = uv1.x * uv2.y - uv1.y * uv2.x;
    TriangleFrame frame;
    if (std::abs(uv_area) <= 1e-30) return frame;
    const glm::dvec3 tangent = (uv2.y * edge1 - uv1.y * edge2) / uv_area;
    const double length = glm::length(tangent);
    if (!(length > 0.0) || !std::isfinite(length)) return frame;
    frame.tangent = tangent / length;
    // v points down in glTF textures, so a picture seen the right way round has negative area in uv.
    frame.handedness = uv_area < 0.0 ? 1 : -1;
    return frame;
}

struct Edge {
    std::uint64_t key;         // its two welded vertices, the smaller one high
    std::uint32_t corner_low;  // the corner at the smaller one
    std::uint32_t corner_high;
};

std::vector<Edge> sorted_edges(const Mesh& mesh, const std::vector<std::uint32_t>& welded,
                               const std::vector<TriangleFrame>& frames) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (frames[t].handedness == 0) continue;
        for (std::uint32_t c = 0; c < 3; ++c) {
            std::uint32_t corner_a = std::uint32_t(3 * t) + c;
            std::uint32_t corner_b = std::uint32_t(3 * t) + (c + 1) % 3;
            std::uint32_t a = welded[mesh.triangles[t][int(c)]];
            std::uint32_t b = welded[mesh.triangles[t][int((c + 1) % 3)]];
            if (a > b) {
                std::swap(a, b);
                std::swap(corner_a, corner_b);
            }
            edges.push_back({(std::uint64_t(a) << 32) | b, corner_a, corner_b});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
        return x.key != y.key ? x.key < y.key : x.corner_low < y.corner_low;
    });
    return edges;
}

// Joins the corners on both sides of each edge where the handedness is the same.
Groups group_corners(const Mesh& mesh, const std::vector<std::uint32_t>& welded,
                     const std::vector<TriangleFrame>& frames) {
    Groups groups(3 * mesh.triangles.size());
    const std::vector<Edge> edges = sorted_edges(mesh, welded, frames);
    // The last edge seen of each handedness, among those with the same key.
    std::array<const Edge*, 2> last = {nullptr, nullptr};
    for (const Edge& edge : edges) {
        const Edge*& previous = last[frames[edge.corner_low / 3].handedness > 0 ? 1 : 0];
        if (previous != nullptr && previous->key == edge.key) {
            groups.join(previous->corner_low, edge.corner_low);
            groups.join(previous->corner_high, edge.corner_high);
        }
        previous = &edge;
    }
    return groups;
}

glm::dvec3 project(const glm::dvec3& vector, const glm::dvec3& normal) {
    return vector - normal * glm::dot(normal, vector);
}

// The angle between the two edges at corner c, both projected to the vertex's tangent plane.
double corner_angle(const Mesh& mesh, const glm::uvec3& t, int c, const glm::dvec3& normal) {
    const glm::dvec3 here(mesh.positions_os[t[c]]);
    const glm::dvec3 to_next = project(glm::dvec3(mesh.positions_os[t[(c + 1) % 3]]) - here, normal);
    const glm::dvec3 to_previous = project(glm::dvec3(mesh.positions_os[t[(c + 2) % 3]]) - here, normal);
    const double lengths = glm::length(to_next) * glm::length(to_previous);
    if (!(lengths > 0.0)) return 0.0;
    return std::acos(std::clamp(glm::dot(to_next, to_previous) / lengths, -1.0, 1.0));
}

glm::vec3 any_perpendicular(const glm::vec3& normal) {
    const glm::vec3 axis = std::abs(normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - normal * glm::dot(axis, normal));
}

glm::vec4 perpendicular_tangent(const glm::vec3& normal) {
    return glm::vec4(any_perpendicular(normal), 1.0f);
}

// The tangent of each corner's group; w = 0 for corners of triangles without area in uv.
std::vector<glm::vec4> corner_tangents(const Mesh& mesh, const std::vector<TriangleFrame>& frames,
                                       Groups& groups) {
    std::vector<glm::dvec3> sums(3 * mesh.triangles.size(), glm::dvec3(0.0));
    for (std::uint32_t corner = 0; corner < sums.size(); ++corner) {
        const TriangleFrame& frame = frames[corner / 3];
        if (frame.handedness == 0) continue;
        const glm::uvec3& t = mesh.triangles[corner / 3];
        const int c = int(corner % 3);
        const glm::dvec3 normal(mesh.normals_os[t[c]]);
        const glm::dvec3 tangent = project(frame.tangent, normal);
        const double length = glm::length(tangent);
        if (length > 0.0) sums[groups.root(corner)] += corner_angle(mesh, t, c, normal) / length * tangent;
    }
    std::vector<glm::vec4> tangents(sums.size(), glm::vec4(0.0f));
    for (std::uint32_t corner = 0; corner < sums.size(); ++corner) {
        const int handedness = frames[corner / 3].handedness;
        if (handedness == 0) continue;
        const glm::vec3& normal = mesh.normals_os[mesh.triangles[corner / 3][int(corner % 3)]];
        const glm::vec3 tangent = normalized_or(sums[groups.root(corner)], any_perpendicular(normal));
        tangents[corner] = glm::vec4(tangent, float(handedness));
    }
    return tangents;
}

// Corners without a frame of their own take that of another corner at the same place, if there is one.
void fill_missing_tangents(const Mesh& mesh, const std::vector<std::uint32_t>& welded,
                           std::vector<glm::vec4>& tangents) {
    std::vector<glm::vec4> of_vertex(welded.size(), glm::vec4(0.0f));
    const auto vertex_of = [&](std::size_t corner) { return mesh.triangles[corner / 3][int(corner % 3)]; };
    for (std::size_t corner = tangents.size(); corner-- > 0;) {
        if (tangents[corner].w != 0.0f) of_vertex[welded[vertex_of(corner)]] = tangents[corner];
    }
    for (std::size_t corner = 0; corner < tangents.size(); ++corner) {
        if (tangents[corner].w != 0.0f) continue;
        const std::uint32_t vertex = vertex_of(corner);
        const glm::vec4& other = of_vertex[welded[vertex]];
        tangents[corner] = other.w != 0.0f ? other : perpendicular_tangent(mesh.normals_os[vertex]);
    }
}

// Writes corner tangents to vertices; a vertex whose corners disagree is split.
void assign_tangents(Mesh& mesh, const std::vector<glm::vec4>& tangents) {
    constexpr std::uint32_t NONE = 0xffffffffu;
    std::vector<std::uint32_t> sources(mesh.positions_os.size());
    std::iota(sources.begin(), sources.end(), 0u);
    std::vector<glm::vec4> of_vertex(sources.size(), glm::vec4(0.0f));
    std::vector<std::uint32_t> next_copy(sources.size(), NONE);
    for (std::size_t corner = 0; corner < tangents.size(); ++corner) {
        std::uint32_t& index = mesh.triangles[corner / 3][int(corner % 3)];
        const glm::vec4& tangent = tangents[corner];
        std::uint32_t vertex = index;
        while (of_vertex[vertex].w != 0.0f && of_vertex[vertex] != tangent) {
            if (next_copy[vertex] == NONE) {
                next_copy[vertex] = std::uint32_t(sources.size());
                sources.push_back(sources[vertex]);
                of_vertex.emplace_back(0.0f);
                next_copy.push_back(NONE);
            }
            vertex = next_copy[vertex];
        }
        of_vertex[vertex] = tangent;
        index = vertex;
    }
    remap_vertices(mesh, sources);
    for (std::size_t v = 0; v < of_vertex.size(); ++v) {
        if (of_vertex[v].w == 0.0f) of_vertex[v] = perpendicular_tangent(mesh.normals_os[v]);
    }
    mesh.tangents_os = std::move(of_vertex);
}

}  // namespace

void add_flat_normals(Mesh& mesh) {
    std::vector<std::uint32_t> sources;
    sources.reserve(3 * mesh.triangles.size());
    for (glm::uvec3& triangle : mesh.triangles) {
        const std::uint32_t first = std::uint32_t(sources.size());
        for (int c = 0; c < 3; ++c) sources.push_back(triangle[c]);
        triangle = {first, first + 1, first + 2};
    }
    mesh.normals_os.clear();
    mesh.tangents_os.clear();
    remap_vertices(mesh, sources);
    mesh.normals_os = compute_flat_normals(mesh, mesh.positions_os);
    for (MorphTarget& target : mesh.morph_targets) {
        target.normals_os.clear();
        target.tangents_os.clear();
        if (target.positions_os.empty()) continue;
        std::vector<glm::vec3> moved = mesh.positions_os;
        for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += target.positions_os[v];
        target.normals_os = compute_flat_normals(mesh, moved);
        for (std::size_t v = 0; v < moved.size(); ++v) target.normals_os[v] -= mesh.normals_os[v];
    }
}

void normalize_normals(Mesh& mesh) {
    std::map<std::uint32_t, glm::dvec3> repaired;
    for (std::size_t v = 0; v < mesh.normals_os.size(); ++v) {
        const glm::vec3 normal = normalized_or(glm::dvec3(mesh.normals_os[v]), glm::vec3(0.0f));
        if (normal == glm::vec3(0.0f)) repaired.emplace(std::uint32_t(v), glm::dvec3(0.0));
        mesh.normals_os[v] = normal;
    }
    if (repaired.empty()) return;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int c = 0; c < 3; ++c) {
            const auto found = repaired.find(t[c]);
            if (found == repaired.end()) continue;
            found->second +=
                area_normal(mesh.positions_os[t.x], mesh.positions_os[t.y], mesh.positions_os[t.z]);
        }
    }
    for (const auto& [vertex, sum] : repaired) mesh.normals_os[vertex] = normalized_or(sum, FALLBACK_NORMAL);
}

void add_tangents(Mesh& mesh, int uv_set) {
    const std::vector<glm::vec2> uv = uv_set == 0 ? mesh.uv0 : mesh.uv1;
    mesh.tangents_os.clear();
    if (uv.empty()) {
        for (const glm::vec3& normal : mesh.normals_os)
            mesh.tangents_os.push_back(perpendicular_tangent(normal));
        return;
    }
    std::vector<TriangleFrame> frames;
    frames.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) frames.push_back(frame_of(mesh, uv, t));
    const std::vector<std::uint32_t> welded = weld_vertices(mesh, uv);
    Groups groups = group_corners(mesh, welded, frames);
    std::vector<glm::vec4> tangents = corner_tangents(mesh, frames, groups);
    fill_missing_tangents(mesh, welded, tangents);
    assign_tangents(mesh, tangents);
}

}  // namespace tarn
