// Small scenes with known answers: the Cornell box, white furnaces, and single lights over a plane.
#include "content/portable_math.h"
#include "content/scenes.h"

namespace tarn::content {
namespace {

int add_diffuse(GltfWriter& writer, const std::string& name, const glm::vec3& albedo) {
    MaterialSpec spec;
    spec.name = name;
    spec.base_color = albedo;
    spec.specular = 0.0f;
    return writer.add_material(spec);
}

// Emits on its front alone and reflects nothing.
int add_emitter(GltfWriter& writer, const std::string& name, const glm::vec3& radiance) {
    MaterialSpec spec;
    spec.name = name;
    spec.base_color = glm::vec3(0.0f);
    spec.specular = 0.0f;
    spec.radiance = radiance;
    return writer.add_material(spec);
}

void add_object(GltfWriter& writer, const std::string& name, const Shape& shape, int material,
                const Placement& placement = {}) {
    writer.add_node(name, placement, writer.add_mesh(name, {{shape, material}}));
}

// 20 m square, albedo 0.5, at y = 0.
void add_plane(GltfWriter& writer) {
    const int material = add_diffuse(writer, "plane", glm::vec3(0.5f));
    add_object(writer, "plane", make_quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}), material);
}

}  // namespace

void build_cornell(GltfWriter& writer, const SceneOptions&) {
    constexpr float X = 0.278f, Y = 0.5488f, Z = -0.5592f;  // half width, height, back wall
    const int white = add_diffuse(writer, "white", {0.725f, 0.71f, 0.68f});
    const int red = add_diffuse(writer, "red", {0.63f, 0.065f, 0.05f});
    const int green = add_diffuse(writer, "green", {0.14f, 0.45f, 0.091f});
    const int light = add_emitter(writer, "light", {17.0f, 12.0f, 4.0f});
    add_object(writer, "floor", make_quad({-X, 0, 0}, {2 * X, 0, 0}, {0, 0, Z}), white);
    add_object(writer, "ceiling", make_quad({-X, Y, Z}, {2 * X, 0, 0}, {0, 0, -Z}), white);
    add_object(writer, "back wall", make_quad({-X, 0, Z}, {2 * X, 0, 0}, {0, Y, 0}), white);
    add_object(writer, "left wall", make_quad({-X, 0, 0}, {0, 0, Z}, {0, Y, 0}), red);
    add_object(writer, "right wall", make_quad({X, 0, Z}, {0, 0, -Z}, {0, Y, 0}), green);
    const auto block = [](float side, float height) {
        return make_box({-0.5f * side, 0, -0.5f * side}, {0.5f * side, height, 0.5f * side});
    };
    const glm::vec3 up(0, 1, 0);
    add_object(writer, "short block", block(0.165f, 0.165f), white,
               {{0.0925f, 0, -0.169f}, rotate_about(up, -17.0 / 180.0 * PI)});
    add_object(writer, "tall block", block(0.165f, 0.33f), white,
               {{-0.0905f, 0, -0.351f}, rotate_about(up, 17.5 / 180.0 * PI)});
    add_object(writer, "light", make_quad({-0.065f, Y - 0.001f, -0.332f}, {0.13f, 0, 0}, {0, 0, 0.105f}),
               light);
    writer.add_camera("main", {0, 0.2744f, 0.8f}, {0, 0.2744f, -0.2f}, 39.3);
}

// A room 4 m wide, 2.5 m high and 6 m deep, parted by a wall that leaves a gap on the right. The strong lamp
// behind the wall faces away from the gap: none of what the camera sees is lit by it directly. The dim lamp
// on the ceiling of the front part, the first of both, is there so that something stays when the other goes
// out.
void build_corner(GltfWriter& writer, const SceneOptions&) {
    constexpr float X = 2.0f, Y = 2.5f, Z = 3.0f;
    const int white = add_diffuse(writer, "white", glm::vec3(0.75f));
    const int red = add_diffuse(writer, "red", {0.7f, 0.25f, 0.15f});
    const int dim = add_emitter(writer, "dim lamp", glm::vec3(0.5f));
    const int strong = add_emitter(writer, "strong lamp", {60.0f, 50.0f, 35.0f});
    add_object(writer, "floor", make_quad({-X, 0, Z}, {2 * X, 0, 0}, {0, 0, -2 * Z}), white);
    add_object(writer, "ceiling", make_quad({-X, Y, -Z}, {2 * X, 0, 0}, {0, 0, 2 * Z}), white);
    add_object(writer, "back wall", make_quad({-X, 0, -Z}, {2 * X, 0, 0}, {0, Y, 0}), white);
    add_object(writer, "front wall", make_quad({X, 0, Z}, {-2 * X, 0, 0}, {0, Y, 0}), white);
    add_object(writer, "left wall", make_quad({-X, 0, Z}, {0, 0, -2 * Z}, {0, Y, 0}), red);
    add_object(writer, "right wall", make_quad({X, 0, -Z}, {0, 0, 2 * Z}, {0, Y, 0}), white);
    add_object(writer, "parting wall", make_box({-X, 0, -0.1f}, {0.6f, Y, 0}), white);
    add_object(writer, "dim lamp", make_quad({-0.9f, Y - 0.01f, 1.2f}, {0.3f, 0, 0}, {0, 0, 0.3f}), dim);
    add_object(writer, "strong lamp", make_quad({-0.8f, 0.8f, -1.9f}, {0, 0, 0.6f}, {0, 0.6f, 0}), strong);
    writer.add_camera("main", {-1.2f, 1.4f, 2.8f}, {0.9f, 1.0f, -1.0f}, 55.0);
}

void build_furnace(GltfWriter& writer, const SceneOptions&) {
    add_object(writer, "sphere", make_sphere(1.0f, 192, 96), add_diffuse(writer, "white", glm::vec3(1.0f)));
    writer.add_camera("main", {0, 0, 4}, {0, 0, 0}, 40.0);
}

void build_furnace_ggx(GltfWriter& writer, const SceneOptions&) {
    const Shape sphere = make_sphere(0.5f, 96, 48);
    for (int metallic = 0; metallic < 2; ++metallic) {
        for (int step = 0; step <= 5; ++step) {
            MaterialSpec spec;
            spec.name =
                std::string(metallic ? "metal" : "dielectric") + " roughness 0." + std::to_string(2 * step);
            if (step == 5) spec.name = std::string(metallic ? "metal" : "dielectric") + " roughness 1.0";
            spec.metallic = static_cast<float>(metallic);
            spec.roughness = 0.2f * static_cast<float>(step);
            const glm::vec3 place(1.2f * (static_cast<float>(step) - 2.5f), metallic ? -0.6f : 0.6f, 0);
            add_object(writer, spec.name, sphere, writer.add_material(spec), {place});
        }
    }
    writer.add_camera("main", {0, 0, 8}, {0, 0, 0}, 30.0);
}

void build_point_over_plane(GltfWriter& writer, const SceneOptions&) {
    add_plane(writer);
    writer.add_point_light("point", {0, 1, 0}, glm::vec3(1.0f), 10.0);
    writer.add_camera("main", {0, 3, 4}, {0, 0, 0}, 50.0);
}

void build_rectangle_over_plane(GltfWriter& writer, const SceneOptions&) {
    add_plane(writer);
    const int light = add_emitter(writer, "light", glm::vec3(5.0f));
    add_object(writer, "rectangle", make_quad({-0.5f, 1, -0.25f}, {1, 0, 0}, {0, 0, 0.5f}), light);
    writer.add_camera("main", {0, 3, 4}, {0, 0, 0}, 50.0);
}

}  // namespace tarn::content
