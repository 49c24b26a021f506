// Embree against the brute-force oracle: closest hits, shadow rays, alpha, facing, updates, threads, bad
// rays.
#include "rays/ray_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shared/math/random.h"
#include "support/ray_soup.h"

namespace tarn::test {
namespace {

float edge_distance(const std::optional<Hit>& hit) {
    if (!hit) return 1.0f;
    return std::min(
        {hit->barycentrics.x, hit->barycentrics.y, 1.0f - hit->barycentrics.x - hit->barycentrics.y});
}

// Rounding may decide differently at a triangle's edge, between two hits at one distance, and at max_t.
bool is_borderline(const RayRecord& ray, const std::optional<Hit>& a, const std::optional<Hit>& b) {
    if (edge_distance(a) < 1e-4f || edge_distance(b) < 1e-4f) return true;
    if (a && b) return std::abs(a->t - b->t) < 1e-4f;
    const float t = a ? a->t : b->t;
    return t < 1e-4f || std::abs(t - ray.max_t) < 1e-4f;
}

// add_random_instances makes every fifth instance flat: all its triangles lie in one plane and hit at one
// distance.
bool hit_one_plane(const std::optional<Hit>& a, const std::optional<Hit>& b) {
    return a && b && a->instance == b->instance && a->instance % 5 == 4 && std::abs(a->t - b->t) < 1e-4f;
}

struct Disagreements {
    int hits = 0;
    int borderline = 0;
    int unexplained = 0;
};

Disagreements compare_closest(const RayTracer& tracer, const RayTracer& oracle, const CoverageKey& key,
                              BackFaces back_faces, int count) {
    Rng rng(11);
    Disagreements result;
    for (int i = 0; i < count; ++i) {
        const RayRecord ray = random_ray(rng, std::uint32_t(i));
        const auto a = tracer.trace_closest(ray, key, back_faces);
        const auto b = oracle.trace_closest(ray, key, back_faces);
        result.hits += b.has_value();
        const bool same = a.has_value() == b.has_value() &&
                          (!a || (a->instance == b->instance && a->primitive == b->primitive &&
                                  std::abs(a->t - b->t) < 1e-4f &&
                                  glm::distance(a->barycentrics, b->barycentrics) < 1e-3f));
        if (same || hit_one_plane(a, b)) continue;
        ++(is_borderline(ray, a, b) ? result.borderline : result.unexplained);
    }
    return result;
}

std::vector<RayRecord> random_rays(int count) {
    Rng rng(13);
    std::vector<RayRecord> rays;
    for (int i = 0; i < count; ++i) rays.push_back(random_ray(rng, std::uint32_t(i)));
    return rays;
}

TEST(Rays, closest_hits_agree_with_the_oracle) {
    const World world = make_soup(false);
    const auto embree = create_embree_tracer(world);
    const auto oracle = create_brute_force_tracer(world);
    const Disagreements d = compare_closest(*embree, *oracle, {}, BackFaces::HIT, 6000);
    EXPECT_GT(d.hits, 2500);
    EXPECT_EQ(d.unexplained, 0);
    EXPECT_LE(d.borderline, 20);
}

TEST(Rays, camera_rays_pass_the_backs_of_single_sided_surfaces) {
    const World world = make_soup(false);
    const auto embree = create_embree_tracer(world);
    const auto oracle = create_brute_force_tracer(world);
    const Disagreements d = compare_closest(*embree, *oracle, {}, BackFaces::PASS, 6000);
    EXPECT_GT(d.hits, 1500);
    EXPECT_EQ(d.unexplained, 0);
    EXPECT_LE(d.borderline, 20);
}

// Transforms that Embree cannot invert (here: z goes nearly where x and y go) are multiplied into a copy of
// the mesh, which turns the winding of mirrored ones.
TEST(Rays, camera_rays_meet_the_fronts_of_flattened_mirrored_instances) {
    Rng rng(11);
    ToyScene toy;
    const MeshIndex mesh = toy.add_mesh(toy.add_material(Material{}), random_triangles(rng, 40));
    for (const double thickness : {1e-6, -1e-6}) {
        glm::dmat4 m(1.0);
        m[2] = glm::dvec4(0.8, 0.6, thickness, 0.0);
        m[3].z = 1e6 * thickness;
        toy.add_instance(mesh, m);
    }
    const World world = build_world(toy.scene);
    ASSERT_NE(world.instances[0].mirrored, world.instances[1].mirrored);
    const auto embree = create_embree_tracer(world);
    const auto oracle = create_brute_force_tracer(world);
    const Disagreements d = compare_closest(*embree, *oracle, {}, BackFaces::PASS, 6000);
    EXPECT_GT(d.hits, 300);
    EXPECT_EQ(d.unexplained, 0);
}

TEST(Rays, alpha_masks_and_stochastic_coverage_agree_with_the_oracle) {
    const World world = make_soup(true);
    const auto embree = create_embree_tracer(world);
    const auto oracle = create_brute_force_tracer(world);
    const CoverageKey key{3, 5, RAY_BOUNCE};
    const Disagreements d = compare_closest(*embree, *oracle, key, BackFaces::PASS, 4000);
    EXPECT_GT(d.hits, 1000);
    // Opacity jumps at no point of a texture, but coverage does where it crosses the cutoff.
    EXPECT_LE(d.unexplained, 4);
    EXPECT_LE(d.borderline, 20);
}

TEST(Rays, coverage_keeps_its_share_and_changes_with_the_frame) {
    ToyScene toy;
    Material glass;
    glass.alpha_mode = AlphaMode::BLEND;
    glass.base_color.w = 0.3f;
    toy.add_quad(toy.add_material(glass), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    const World world = build_world(toy.scene);
    const auto embree = create_embree_tracer(world);
    RayRecord ray;
    ray.origin = {0.2f, 0.1f, 1.0f};
    ray.direction = {0.0f, 0.0f, -1.0f};
    ray.max_t = RAY_INFINITY;
    int blocked = 0;
    for (std::uint32_t frame = 0; frame < 10000; ++frame) {
        ray.pixel = 17;
        const CoverageKey key{frame, 1, RAY_SHADOW};
        blocked += !embree->is_visible(ray, key);
        EXPECT_EQ(embree->is_visible(ray, key), embree->is_visible(ray, key));
    }
    EXPECT_NEAR(blocked, 3000, 5 * std::sqrt(10000 * 0.3 * 0.7));
}

TEST(Rays, shadow_batches_agree_with_the_oracle_and_count) {
    const World world = make_soup(true);
    const auto embree = create_embree_tracer(world);
    const auto oracle = create_brute_force_tracer(world);
    const std::vector<RayRecord> rays = random_rays(3000);
    const CoverageKey key{1, 2, RAY_SHADOW};
    std::vector<float> visibility(rays.size(), -1.0f);
    const RayBatchResult result = embree->trace_visibility(pack_rays(rays), visibility, key);
    EXPECT_EQ(result.traced, rays.size());
    EXPECT_EQ(result.rejected, 0u);
    int blocked = 0, different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        blocked += visibility[i] == 0.0f;
        different += visibility[i] != (oracle->is_visible(rays[i], key) ? 1.0f : 0.0f);
    }
    EXPECT_GT(blocked, 700);
    EXPECT_LE(different, 6);
}

TEST(Rays, bad_rays_are_occluded_and_counted_and_inactive_ones_visible) {
    const World world = make_soup(false);
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    RayRecord good;
    good.origin = {0, 0, 50};
    good.direction = {0, 0, 1};
    good.max_t = 1.0f;
    good.pixel = 0;
    std::vector<RayRecord> rays(9, good);
    rays[1].origin.x = nan;
    rays[2].direction.y = nan;
    rays[3].direction = glm::vec3(0.0f);
    rays[4].max_t = nan;
    rays[5].direction.z = inf;
    rays[6].origin.z = -inf;
    rays[7] = inactive_ray();
    rays[8].direction = glm::vec3(1e-30f);
    const float expected[] = {1, 0, 0, 0, 0, 0, 0, 1, 0};
    for (const auto& tracer : {create_embree_tracer(world), create_brute_force_tracer(world)}) {
        std::vector<float> visibility(rays.size(), -1.0f);
        const RayBatchResult result = tracer->trace_visibility(pack_rays(rays), visibility, {});
        EXPECT_EQ(result.traced, 1u);
        EXPECT_EQ(result.rejected, 7u);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(visibility[i], expected[i]) << i;
            if (expected[i] == 0.0f) {
                EXPECT_FALSE(tracer->trace_closest(rays[i], {}).has_value()) << i;
            }
        }
    }
}

// A batch says of each ray what asking for it alone says.
TEST(Rays, batches_of_closest_hits_are_the_hits_of_each_ray) {
    const World world = make_soup(true);
    std::vector<RayRecord> rays = random_rays(5000);
    for (std::size_t i = 0; i < rays.size(); i += 50) rays[i] = inactive_ray();
    for (std::size_t i = 1; i < rays.size(); i += 50)
        rays[i].origin.x = std::numeric_limits<float>::infinity();
    const CoverageKey key{3, 4, RAY_SHADOW};
    for (const auto& tracer : {create_embree_tracer(world), create_brute_force_tracer(world)}) {
        std::vector<glm::uvec4> rows(rays.size() * HIT_ROWS);
        const RayBatchResult result = tracer->trace_closest_hits(pack_rays(rays), rows, key);
        EXPECT_EQ(result.traced, rays.size() * 48 / 50);
        EXPECT_EQ(result.rejected, rays.size() / 50);
        int hits = 0, wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const HitRecord record = unpack_hit(rows[i * HIT_ROWS], rows[i * HIT_ROWS + 1]);
            const auto hit = tracer->trace_closest(rays[i], key);
            const Hit expected = hit.value_or(Hit{});
            const float distance = hit ? hit->t : i % 50 < 2 ? -1.0f : RAY_INFINITY;
            hits += hit.has_value();
            wrong += record.instance != expected.instance || record.primitive != expected.primitive ||
                     record.barycentrics != expected.barycentrics || record.distance != distance ||
                     record.direction != rays[i].direction;
        }
        EXPECT_GT(hits, 1000);
        EXPECT_LT(hits, 4500);
        EXPECT_EQ(wrong, 0);
    }
}

TEST(Rays, answers_do_not_depend_on_the_number_of_threads) {
    const World world = make_soup(true);
    const std::vector<glm::uvec4> rows = pack_rays(random_rays(20000));
    std::vector<float> answers[2];
    std::vector<glm::uvec4> hits[2];
    for (int threads = 1; threads <= 2; ++threads) {
        const WorkerLimit limit(threads);
        const auto embree = create_embree_tracer(world);
        answers[threads - 1].resize(rows.size() / RAY_ROWS);
        embree->trace_visibility(rows, answers[threads - 1], CoverageKey{1, 2, RAY_SHADOW});
        hits[threads - 1].resize(rows.size() / RAY_ROWS * HIT_ROWS);
        embree->trace_closest_hits(rows, hits[threads - 1], CoverageKey{1, 2, RAY_SHADOW});
    }
    EXPECT_EQ(answers[0], answers[1]);
    EXPECT_EQ(hits[0], hits[1]);
}

TEST(Rays, ties_between_coincident_triangles_do_not_depend_on_the_number_of_threads) {
    Rng rng(3);
    ToyScene toy;
    const std::vector<glm::vec3> once = random_triangles(rng, 30000);
    std::vector<glm::vec3> thrice;
    for (int copy = 0; copy < 3; ++copy) thrice.insert(thrice.end(), once.begin(), once.end());
    toy.add_instance(toy.add_mesh(toy.add_material(Material{}), thrice));
    const World world = build_world(toy.scene);
    std::vector<std::uint32_t> primitives[2];
    for (int threads = 1; threads <= 2; ++threads) {
        const WorkerLimit limit(threads);
        const auto embree = create_embree_tracer(world);
        for (const RayRecord& ray : random_rays(20000)) {
            const auto hit = embree->trace_closest(ray, {});
            primitives[threads - 1].push_back(hit ? hit->primitive : INVALID_INDEX);
        }
    }
    EXPECT_EQ(primitives[0], primitives[1]);
}

TEST(Rays, updates_follow_deformed_meshes_and_moved_instances) {
    World world = make_soup(false);
    world.meshes[1].deforms = true;
    const auto embree = create_embree_tracer(world);
    Rng rng(23);
    for (int step = 0; step < 3; ++step) {
        WorldMesh& mesh = world.meshes[1];
        for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
            glm::uvec4& row = world.vertex_rows[(mesh.first_vertex + v) * VERTEX_ROWS];
            row = pack_row(row_xyz(row) + random_point(rng, 0.2f), row.w);
        }
        ++mesh.revision;
        // The flattened one is moved as well.
        for (const std::uint32_t i : {0u, 4u}) {
            WorldInstance& instance = world.instances[i];
            instance.world_from_object[3] += glm::vec4(random_point(rng, 1.0f), 0.0f);
            ++instance.revision;
        }
        embree->update(world);
        const auto oracle = create_brute_force_tracer(world);
        const Disagreements d = compare_closest(*embree, *oracle, {}, BackFaces::PASS, 3000);
        EXPECT_GT(d.hits, 800);
        EXPECT_EQ(d.unexplained, 0) << step;
        EXPECT_LE(d.borderline, 15);
    }
}

// What begins to move leaves the still scene; one without it is built and takes over some updates later; what
// has rested for long enough joins again when the next one is built. Updates without any change count as
// well.
TEST(Rays, updates_follow_what_begins_to_move_and_comes_to_rest) {
    World world = make_soup(false);
    const auto embree = create_embree_tracer(world);
    Rng rng(41);
    const auto move = [&](std::uint32_t i) {
        WorldInstance& instance = world.instances[i];
        instance.world_from_object[3] += glm::vec4(random_point(rng, 1.0f), 0.0f);
        ++instance.revision;
    };
    for (int step = 0; step < 100; ++step) {
        if (step < 3) move(0);
        if (step == 5) move(2);   // while the first scene is being built
        if (step == 30) move(4);  // flattened
        if (step == 75) move(1);  // the others have come to rest
        if (step == 78) move(0);  // and is in the scene that is being built
        embree->update(world);
        const auto oracle = create_brute_force_tracer(world);
        const Disagreements d = compare_closest(*embree, *oracle, {}, BackFaces::PASS, 400);
        EXPECT_GT(d.hits, 80);
        EXPECT_EQ(d.unexplained, 0) << step;
    }
}

TEST(Rays, updates_follow_memory_that_moved) {
    World world = make_soup(false);
    const auto embree = create_embree_tracer(world);
    World moved = world;
    for (glm::uvec4& row : world.vertex_rows) row = glm::uvec4(0u);
    embree->update(moved);
    const auto oracle = create_brute_force_tracer(moved);
    const Disagreements d = compare_closest(*embree, *oracle, {}, BackFaces::HIT, 1000);
    EXPECT_GT(d.hits, 300);
    EXPECT_EQ(d.unexplained, 0);
}

TEST(Rays, a_world_without_triangles_hides_nothing) {
    const World world = build_world(Scene{});
    const auto embree = create_embree_tracer(world);
    RayRecord ray = inactive_ray();
    ray.max_t = RAY_INFINITY;
    EXPECT_TRUE(embree->is_visible(ray, {}));
    EXPECT_FALSE(embree->trace_closest(ray, {}).has_value());
}

}  // namespace
}  // namespace tarn::test
