// Building blocks: boxes, spheres, lathes, arches, ... as indexed triangles with outward normals,
// counter-clockwise seen from outside. Texture coordinates are in metres unless said otherwise.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace tarn::content {

struct Shape {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;
};

// Adds `part`, moved by an affine `transform` (mirrors allowed: the winding is turned back), to `whole`.
void append(Shape& whole, const Shape& part, const glm::mat4& transform = glm::mat4(1.0f));

// Adds one flat convex polygon, counter-clockwise seen from outside; its uvs are the positions projected
// along the axis closest to the normal, so that neighbouring polygons share one texture without a seam.
void append_polygon(Shape& whole, const std::vector<glm::vec3>& corners);

// Parallelogram from `corner` along two edges, normal edge_u x edge_v; uv spans 0..1, v down as in glTF.
Shape make_quad(const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v);

// Axis-aligned box.
Shape make_box(const glm::vec3& lower, const glm::vec3& upper);

// Box whose top is `top_scale` times as wide as its bottom, standing on y = 0, centred.
Shape make_tapered_box(const glm::vec3& size, float top_scale);

// Convex outline in the xy plane, counter-clockwise, made `depth` thick along z around z = 0.
Shape make_extrusion(const std::vector<glm::vec2>& outline, float depth);

// Sphere around the origin; uv spans 0..1.
Shape make_sphere(float radius, int segments, int rings);

// Surface of revolution about +Y through (radius, y) points. With the profile going up the outside faces
// outwards. An edge sharper than 40 degrees between two profile segments stays sharp. Closed where the
// profile meets radius 0.
Shape make_lathe(const std::vector<glm::vec2>& profile, int segments);

// Open or closed tube of constant radius along a polyline, with flat end caps.
Shape make_tube(const std::vector<glm::vec3>& path, float radius, int sides);

// Wall of `width` x `height` x `depth` (x centred, from y = 0, z centred) with one round-arched opening of
// `opening_width`, whose round part begins at `spring_height`. The opening reaches the floor.
struct ArchSize {
    float width, height, depth;
    float opening_width, spring_height;
    int segments;
};
Shape make_arch(const ArchSize& size);

}  // namespace tarn::content
