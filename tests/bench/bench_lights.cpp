// What lights cost outside of a frame, from a thousand to a million emissive triangles: the table built,
// followed while one instance in a hundred moves, and the tree built and fitted. Medians, all threads;
// processor time too where it tells more on a busy machine.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

#include "support/draws.h"
#include "support/toy_scenes.h"
#include "world/light_tree.h"
#include "world/world.h"

namespace tarn {
namespace {

constexpr int INSTANCE_TRIANGLES = 100;
constexpr int UPDATES = 21;

double time_ms(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

glm::dmat4 draw_place(test::Draws& draws) {
    const glm::dvec3 place(draws.uniform(-50.0, 50.0), draws.uniform(0.0, 4.0), draws.uniform(-50.0, 50.0));
    return glm::rotate(glm::translate(glm::dmat4(1.0), place), draws.uniform(0.0, 6.28),
                       glm::dvec3(draws.unit_vector()));
}

// Clusters of 100 triangles of 2 cm within a metre, in a hall of 100 m.
Scene make_scene(int light_count, test::Draws& draws) {
    ToyScene toy;
    const MaterialIndex lamp = toy.add_material(emissive_material(glm::vec3(1.0f)));
    std::vector<vec3> corners;
    for (int i = 0; i < INSTANCE_TRIANGLES; ++i) {
        const vec3 place = draws.uniform_vec3();
        for (int c = 0; c < 3; ++c) corners.push_back(place + 0.01f * draws.unit_vector());
    }
    const MeshIndex mesh = toy.add_mesh(lamp, corners);
    for (int i = 0; i < light_count / INSTANCE_TRIANGLES; ++i) toy.add_instance(mesh, draw_place(draws));
    return toy.scene;
}

void move_one_percent(Scene& scene, test::Draws& draws) {
    for (std::size_t i = 0; i < std::max<std::size_t>(1, scene.nodes.size() / 100); ++i) {
        *scene.nodes[draws.bits() % scene.nodes.size()].matrix = draw_place(draws);
    }
    ++scene.revision;
}

void measure(int light_count) {
    test::Draws draws(1);
    Scene scene = make_scene(light_count, draws);
    World world;
    const double world_ms = time_ms([&] { world = build_world(scene); });
    const std::clock_t start = std::clock();
    LightTree tree;
    const double build_ms = time_ms([&] { update_light_tree(tree, world.lights); });
    const double build_cpu_ms = 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC;
    std::vector<double> update_ms, fit_ms;
    ChangeLog::Cursor reader;
    tree.changes.read(reader);
    std::size_t rows = 0;
    for (int i = 0; i < UPDATES; ++i) {
        move_one_percent(scene, draws);
        update_ms.push_back(time_ms([&] { update_world(world, scene, -1.0); }));
        fit_ms.push_back(time_ms([&] { update_light_tree(tree, world.lights); }));
        for (const IndexRange& range : tree.changes.read(reader).ranges) rows += range.last - range.first;
    }
    fmt::print("{:>8} {:>12.1f} {:>14.2f} {:>12.1f} {:>14.1f} {:>10.2f} {:>16.1f}\n", light_count, world_ms,
               median(update_ms), build_ms, build_cpu_ms, median(fit_ms),
               100.0 * double(rows) / UPDATES / double(tree.rows.size()));
}

}  // namespace
}  // namespace tarn

int main() {
    fmt::print(
        "  lights   world [ms]  1% moves [ms]    tree [ms]  tree, CPU [ms]   fit [ms]  rows fitted [%]\n");
    for (const int count : {1'000, 10'000, 100'000, 1'000'000}) tarn::measure(count);
    return 0;
}
