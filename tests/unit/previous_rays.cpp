// Rays of the last frame: the tracer answers them by the geometry, the materials and the random numbers of
// then.
#include <gtest/gtest.h>

#include "rays/ray_tracer.h"
#include "support/ray_soup.h"

namespace tarn::test {
namespace {

// Moves two instances, one of them flattened, deforms a mesh and lets the alpha of a material fade.
void change_world(World& world, Rng& rng, float alpha) {
    WorldMesh& mesh = world.meshes[1];
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
        glm::uvec4& row = world.vertex_rows[(mesh.first_vertex + v) * VERTEX_ROWS];
        row = pack_row(row_xyz(row) + random_point(rng, 0.2f), row.w);
    }
    ++mesh.revision;
    for (const std::uint32_t i : {0u, 4u}) {
        WorldInstance& instance = world.instances[i];
        instance.world_from_object[3] += glm::vec4(random_point(rng, 1.0f), 0.0f);
        ++instance.revision;
    }
    for (std::size_t m = 0; m < world.material_flags.size(); ++m) {
        world.material_rows[m * MATERIAL_ROWS].w = floatBitsToUint(alpha);
    }
    ++world.material_revision;
}

// Rays flagged RAY_PREVIOUS get the answers that the tracer gave before the update, with that frame's key;
// the others those of the present. Through several updates, since geometry is kept in turns.
TEST(PreviousRays, are_answered_as_before_the_update) {
    World world = make_soup(true);
    world.meshes[1].deforms = true;
    const auto embree = create_embree_tracer(world);
    Rng rng(29);
    std::vector<RayRecord> rays;
    for (std::uint32_t i = 0; i < 4000; ++i) rays.push_back(random_ray(rng, i));
    std::vector<RayRecord> mixed = rays;
    for (std::size_t i = 0; i < mixed.size(); i += 2) mixed[i].pixel |= RAY_PREVIOUS;
    const auto answer = [&](const std::vector<RayRecord>& of, const CoverageKey& key,
                            const PreviousRays& previous) {
        std::vector<float> visibility(of.size());
        embree->trace_visibility(pack_rays(of), visibility, key, previous);
        return visibility;
    };
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        const CoverageKey before_key{frame, 3, RAY_SHADOW}, key{frame + 1, 3, RAY_SHADOW};
        const std::uint64_t before_revision = embree->geometry_revision();
        const std::vector<float> before = answer(rays, before_key, {});
        change_world(world, rng, 0.3f + 0.2f * float(frame % 3));
        embree->update(world);
        EXPECT_EQ(embree->geometry_revision(), before_revision + 1);
        EXPECT_TRUE(embree->remembers(before_revision));
        const std::vector<float> now = answer(rays, key, {});
        const std::vector<float> both = answer(mixed, key, {before_revision, before_key});
        int differ = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(both[i], i % 2 == 0 ? before[i] : now[i]) << "ray " << i << " of frame " << frame;
            differ += before[i] != now[i];
        }
        EXPECT_GT(differ, 100);
    }
}

TEST(PreviousRays, without_a_change_the_previous_geometry_is_the_present_one) {
    World world = make_soup(false);
    const auto embree = create_embree_tracer(world);
    const std::uint64_t first = embree->geometry_revision();
    embree->update(world);
    EXPECT_EQ(embree->geometry_revision(), first);
    Rng rng(31);
    change_world(world, rng, 1.0f);
    embree->update(world);
    change_world(world, rng, 1.0f);
    embree->update(world);
    EXPECT_FALSE(embree->remembers(first));
    EXPECT_TRUE(embree->remembers(first + 1));
}

}  // namespace
}  // namespace tarn::test
