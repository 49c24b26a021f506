// Flat-sided building blocks: quads, boxes, arches, and how shapes are joined.
#include "content/shapes.h"

#include "content/portable_math.h"

namespace tarn::content {
namespace {

glm::vec3 normal_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return glm::normalize(glm::cross(b - a, c - a));
}

// Texture coordinates in metres: the position seen along the axis closest to the normal, v down.
glm::vec2 project(const glm::vec3& p, const glm::vec3& normal) {
    const glm::vec3 size = glm::abs(normal);
    if (size.y >= size.x && size.y >= size.z) return {p.x, normal.y > 0.0f ? p.z : -p.z};
    if (size.x > size.z) return {normal.x > 0.0f ? -p.z : p.z, -p.y};
    return {normal.z > 0.0f ? p.x : -p.x, -p.y};
}

}  // namespace

void append(Shape& whole, const Shape& part, const glm::mat4& transform) {
    const auto base = static_cast<std::uint32_t>(whole.positions.size());
    const glm::mat3 linear(transform);
    const glm::mat3 normal_matrix = glm::transpose(glm::inverse(linear));
    const bool mirrored = glm::determinant(linear) < 0.0f;
    for (const glm::vec3& p : part.positions)
        whole.positions.push_back(glm::vec3(transform * glm::vec4(p, 1.0f)));
    for (const glm::vec3& n : part.normals) whole.normals.push_back(glm::normalize(normal_matrix * n));
    whole.uvs.insert(whole.uvs.end(), part.uvs.begin(), part.uvs.end());
    for (const glm::uvec3& t : part.triangles) {
        whole.triangles.push_back(base + (mirrored ? glm::uvec3(t.x, t.z, t.y) : t));
    }
}

void append_polygon(Shape& whole, const std::vector<glm::vec3>& corners) {
    const auto base = static_cast<std::uint32_t>(whole.positions.size());
    const glm::vec3 normal = normal_of(corners[0], corners[1], corners[2]);
    for (const glm::vec3& corner : corners) {
        whole.positions.push_back(corner);
        whole.normals.push_back(normal);
        whole.uvs.push_back(project(corner, normal));
    }
    for (std::uint32_t i = 2; i < corners.size(); ++i)
        whole.triangles.push_back(base + glm::uvec3(0, i - 1, i));
}

Shape make_quad(const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v) {
    Shape shape;
    append_polygon(shape, {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v});
    shape.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    return shape;
}

Shape make_box(const glm::vec3& lower, const glm::vec3& upper) {
    const glm::vec3 size = upper - lower;
    Shape shape = make_tapered_box(size, 1.0f);
    const glm::vec3 foot(0.5f * (lower.x + upper.x), lower.y, 0.5f * (lower.z + upper.z));
    for (glm::vec3& p : shape.positions) p += foot;
    return shape;
}

Shape make_tapered_box(const glm::vec3& size, float top_scale) {
    const float bx = 0.5f * size.x, bz = 0.5f * size.z, tx = bx * top_scale, tz = bz * top_scale, h = size.y;
    const glm::vec3 bottom[4] = {{-bx, 0, bz}, {bx, 0, bz}, {bx, 0, -bz}, {-bx, 0, -bz}};
    const glm::vec3 top[4] = {{-tx, h, tz}, {tx, h, tz}, {tx, h, -tz}, {-tx, h, -tz}};
    Shape shape;
    for (int i = 0; i < 4; ++i)
        append_polygon(shape, {bottom[i], bottom[(i + 1) % 4], top[(i + 1) % 4], top[i]});
    append_polygon(shape, {top[0], top[1], top[2], top[3]});
    append_polygon(shape, {bottom[3], bottom[2], bottom[1], bottom[0]});
    return shape;
}

Shape make_extrusion(const std::vector<glm::vec2>& outline, float depth) {
    Shape shape;
    std::vector<glm::vec3> front, back;
    for (const glm::vec2& p : outline) {
        front.emplace_back(p, 0.5f * depth);
        back.emplace(back.begin(), p, -0.5f * depth);
    }
    append_polygon(shape, front);
    append_polygon(shape, back);
    const std::size_t count = outline.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        append_polygon(shape, {front[next], front[i], back[count - 1 - i], back[count - 1 - next]});
    }
    return shape;
}

Shape make_arch(const ArchSize& size) {
    const float outer = 0.5f * size.width, inner = 0.5f * size.opening_width, z = 0.5f * size.depth;
    const float spring = size.spring_height, height = size.height;
    Shape shape;
    // A wall piece from (x0, y0) to (x1, y1), whose lower and upper edges may slope, on both faces of the
    // wall.
    const auto both_faces = [&](glm::vec2 a, glm::vec2 b, glm::vec2 c, glm::vec2 d) {
        append_polygon(shape, {{a.x, a.y, z}, {b.x, b.y, z}, {c.x, c.y, z}, {d.x, d.y, z}});
        append_polygon(shape, {{b.x, b.y, -z}, {a.x, a.y, -z}, {d.x, d.y, -z}, {c.x, c.y, -z}});
    };
    const auto across = [&](glm::vec2 a, glm::vec2 b) {  // a strip through the wall that faces left of a -> b
        append_polygon(shape, {{a.x, a.y, z}, {b.x, b.y, z}, {b.x, b.y, -z}, {a.x, a.y, -z}});
    };
    // Pieces end at the spring height, so that no corner lies in the middle of a neighbour's edge.
    for (const glm::vec2 range : {glm::vec2(0, spring), glm::vec2(spring, height)}) {
        const float low = range.x, high = range.y;
        both_faces({-outer, low}, {-inner, low}, {-inner, high}, {-outer, high});
        both_faces({inner, low}, {outer, low}, {outer, high}, {inner, high});
        across({-outer, low}, {-outer, high});
        across({outer, high}, {outer, low});
    }
    across({-inner, 0}, {-outer, 0});
    across({outer, 0}, {inner, 0});
    across({-inner, spring}, {-inner, 0});
    across({inner, 0}, {inner, spring});
    const auto on_round = [&](int i) {
        const double angle = PI * (1.0 - static_cast<double>(i) / size.segments);
        return i == 0               ? glm::vec2(-inner, spring)
               : i == size.segments ? glm::vec2(inner, spring)
                                    : glm::vec2(inner * cosine(angle), spring + inner * sine(angle));
    };
    for (int i = 0; i < size.segments; ++i) {
        const glm::vec2 a = on_round(i), b = on_round(i + 1);
        both_faces(a, b, {b.x, height}, {a.x, height});
        across(b, a);
        across({a.x, height}, {b.x, height});
    }
    across({-outer, height}, {-inner, height});
    across({inner, height}, {outer, height});
    return shape;
}

}  // namespace tarn::content
