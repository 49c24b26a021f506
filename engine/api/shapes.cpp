#include "api/shapes.h"

#include <cmath>
#include <map>
#include <utility>

namespace tarn::api {
namespace {

// Corners on the unit sphere.
struct Ball {
    std::vector<glm::dvec3> corners;
    std::vector<glm::uvec3> triangles;
};

Ball make_icosahedron() {
    const double t = 0.5 * (1.0 + std::sqrt(5.0));
    Ball ball;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-t, t}) {
            ball.corners.push_back(glm::normalize(glm::dvec3(x, y, 0.0)));
            ball.corners.push_back(glm::normalize(glm::dvec3(0.0, x, y)));
            ball.corners.push_back(glm::normalize(glm::dvec3(y, 0.0, x)));
        }
    }
    // Neighbours are at an angle of 63 degrees, all others at 116 or more: three neighbours make a triangle.
    const auto are_close = [&](unsigned a, unsigned b) {
        return glm::dot(ball.corners[a], ball.corners[b]) > 0.4;
    };
    for (unsigned a = 0; a < 12; ++a) {
        for (unsigned b = a + 1; b < 12; ++b) {
            for (unsigned c = b + 1; c < 12; ++c) {
                if (!are_close(a, b) || !are_close(b, c) || !are_close(a, c)) continue;
                const glm::dmat3 corners(ball.corners[a], ball.corners[b], ball.corners[c]);
                const bool faces_out = glm::determinant(corners) > 0.0;
                ball.triangles.push_back(faces_out ? glm::uvec3(a, b, c) : glm::uvec3(a, c, b));
            }
        }
    }
    return ball;
}

void halve_edges(Ball& ball) {
    std::map<std::pair<unsigned, unsigned>, unsigned> middles;
    const auto middle = [&](unsigned a, unsigned b) {
        const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), unsigned(ball.corners.size()));
        if (is_new) ball.corners.push_back(glm::normalize(ball.corners[a] + ball.corners[b]));
        return entry->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& t : ball.triangles) {
        const unsigned ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
        finer.insert(finer.end(), {{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}});
    }
    ball.triangles = std::move(finer);
}

void finish(Mesh& mesh) {
    for (const glm::vec3& position : mesh.positions_os) mesh.bounds_os.add(glm::dvec3(position));
}

}  // namespace

Mesh make_sphere(double radius_m, int subdivisions) {
    Ball ball = make_icosahedron();
    for (int i = 0; i < subdivisions; ++i) halve_edges(ball);
    Mesh mesh;
    for (const glm::dvec3& corner : ball.corners) {
        mesh.positions_os.emplace_back(radius_m * corner);
        mesh.normals_os.emplace_back(corner);
    }
    mesh.triangles = std::move(ball.triangles);
    finish(mesh);
    return mesh;
}

Mesh make_box(const glm::dvec3& half_extent_m) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 normal(0.0), u(0.0), v(0.0);
            normal[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 1.0;
            const auto first = unsigned(mesh.positions_os.size());
            for (const glm::dvec3& corner : {-u - v, u - v, u + v, v - u}) {
                mesh.positions_os.emplace_back((normal + corner) * half_extent_m);
                mesh.normals_os.emplace_back(normal);
            }
            mesh.triangles.emplace_back(first, first + 1, first + 2);
            mesh.triangles.emplace_back(first, first + 2, first + 3);
        }
    }
    finish(mesh);
    return mesh;
}

}  // namespace tarn::api
