// Round building blocks: spheres, surfaces of revolution and tubes.
#include <cmath>

#include "content/portable_math.h"
#include "content/shapes.h"

namespace tarn::content {
namespace {

// The unit circle's point k of n, exactly closed.
glm::vec2 on_circle(int k, int n) {
    const double angle = 2.0 * PI * (k % n) / n;
    return {cosine(angle), sine(angle)};
}

// A row of (n + 1) vertices around +Y; the first and the last share their place but not their u.
void append_ring(Shape& shape, int n, float radius, float y, glm::vec2 normal, float u_scale, float v) {
    for (int k = 0; k <= n; ++k) {
        const glm::vec2 c = on_circle(k, n);
        shape.positions.emplace_back(radius * c.x, y, -radius * c.y);
        shape.normals.emplace_back(normal.x * c.x, normal.y, -normal.x * c.y);
        shape.uvs.emplace_back(u_scale * static_cast<float>(k) / static_cast<float>(n), v);
    }
}

// Joins two rows of n + 1 vertices; `lower_open`, `upper_open`: whether that row has a radius.
void join_rings(Shape& shape, std::uint32_t lower, std::uint32_t upper, int n, bool lower_open,
                bool upper_open) {
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(n); ++k) {
        if (lower_open) shape.triangles.emplace_back(lower + k, lower + k + 1, upper + k + 1);
        if (upper_open) shape.triangles.emplace_back(lower + k, upper + k + 1, upper + k);
    }
}

}  // namespace

Shape make_sphere(float radius, int segments, int rings) {
    Shape shape;
    for (int ring = 0; ring <= rings; ++ring) {
        const double angle = PI * ring / rings;
        const bool pole = ring == 0 || ring == rings;
        const glm::vec2 c(pole ? 0.0 : sine(angle), pole ? (ring == 0 ? -1.0 : 1.0) : -cosine(angle));
        append_ring(shape, segments, radius * c.x, radius * c.y, c, 1.0f,
                    1.0f - static_cast<float>(ring) / rings);
    }
    const auto stride = static_cast<std::uint32_t>(segments + 1);
    for (int ring = 0; ring < rings; ++ring) {
        join_rings(shape, ring * stride, (ring + 1) * stride, segments, ring > 0, ring + 1 < rings);
    }
    for (glm::vec3& normal : shape.normals) normal = glm::normalize(normal);
    return shape;
}

Shape make_lathe(const std::vector<glm::vec2>& profile, int segments) {
    const auto outward = [&](std::size_t i) {
        const glm::vec2 along = glm::normalize(profile[i + 1] - profile[i]);
        return glm::vec2(along.y, -along.x);
    };
    const float SHARP_COSINE = 0.766f;
    const std::size_t edges = profile.size() - 1;
    const auto normal_at = [&](std::size_t edge, std::size_t other) {
        if (other >= edges || glm::dot(outward(edge), outward(other)) < SHARP_COSINE) return outward(edge);
        return glm::normalize(outward(edge) + outward(other));
    };
    float widest = 0.0f;
    for (const glm::vec2& point : profile) widest = std::max(widest, point.x);
    const auto around_m = static_cast<float>(2.0 * PI * widest);
    Shape shape;
    float v = 0.0f;
    for (std::size_t edge = 0; edge < edges; ++edge) {
        const glm::vec2 a = profile[edge], b = profile[edge + 1];
        const float length = glm::length(b - a);
        const auto base = static_cast<std::uint32_t>(shape.positions.size());
        append_ring(shape, segments, a.x, a.y, normal_at(edge, edge == 0 ? edges : edge - 1), around_m, -v);
        append_ring(shape, segments, b.x, b.y, normal_at(edge, edge + 1), around_m, -v - length);
        join_rings(shape, base, base + segments + 1, segments, a.x > 0.0f, b.x > 0.0f);
        v += length;
    }
    return shape;
}

Shape make_tube(const std::vector<glm::vec3>& path, float radius, int sides) {
    Shape shape;
    std::vector<glm::vec3> first_ring, last_ring;
    float v = 0.0f;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const glm::vec3 before = path[i == 0 ? 0 : i - 1], after = path[std::min(i + 1, path.size() - 1)];
        const glm::vec3 along = glm::normalize(after - before);
        const glm::vec3 helper = std::abs(along.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        const glm::vec3 side = glm::normalize(glm::cross(helper, along)), up = glm::cross(along, side);
        if (i > 0) v += glm::length(path[i] - path[i - 1]);
        for (int k = 0; k <= sides; ++k) {
            const glm::vec2 c = on_circle(k, sides);
            const glm::vec3 normal = c.x * side + c.y * up;
            shape.positions.push_back(path[i] + radius * normal);
            shape.normals.push_back(glm::normalize(normal));
            shape.uvs.emplace_back(static_cast<float>(2.0 * PI) * radius * k / sides, -v);
            if (i == 0 && k < sides) first_ring.insert(first_ring.begin(), shape.positions.back());
            if (i + 1 == path.size() && k < sides) last_ring.push_back(shape.positions.back());
        }
    }
    const auto stride = static_cast<std::uint32_t>(sides + 1);
    for (std::uint32_t i = 0; i + 1 < path.size(); ++i) {
        join_rings(shape, i * stride, (i + 1) * stride, sides, true, true);
    }
    append_polygon(shape, first_ring);
    append_polygon(shape, last_ring);
    return shape;
}

}  // namespace tarn::content
