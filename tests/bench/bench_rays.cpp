// Rays a second of trace_visibility against a bare Embree loop over the same rays on the same threads.
//
// Both trace the same incoherent shadow rays through the same two-level scene. The bare loop does nothing but
// call rtcOccluded1 on rays that lie ready in Embree's own layout. Required of the engine: at least 0.9 of
// its speed.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "rays/flush_denormals.h"
#include "rays/ray_tracer.h"
#include "support/toy_scenes.h"

namespace tarn {
namespace {

constexpr std::size_t RAY_COUNT = 1 << 15;

// 400 spheres of 9 120 triangles over a floor.
World make_world() {
    ToyScene toy;
    const MaterialIndex material = toy.add_material(Material{});
    const MeshIndex sphere = toy.add_mesh(material, sphere_corners(0.4f, 48));
    for (int x = 0; x < 20; ++x) {
        for (int z = 0; z < 20; ++z) {
            toy.add_instance(sphere, glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.6, z)));
        }
    }
    toy.add_quad(material, {0, 0, 0}, {0, 0, 20}, {20, 0, 0});
    return build_world(toy.scene);
}

// From random places at the floor to random places above the spheres: what a shader asks for, without any
// order.
std::vector<RayRecord> make_rays(const World& world) {
    std::mt19937 rng(5);
    std::uniform_real_distribution<float> u(0.0f, 20.0f), height(1.0f, 3.0f);
    std::vector<RayRecord> rays;
    for (std::size_t i = 0; i < RAY_COUNT; ++i) {
        RayRecord ray;
        const float x = u(rng), z = u(rng), target_x = u(rng), target_y = height(rng), target_z = u(rng);
        ray.origin = glm::vec3(glm::dvec3(x, 0.01f, z) - world.origin_ws);
        ray.direction = glm::vec3(target_x - x, target_y, target_z - z);
        ray.max_t = 1.0f;
        ray.pixel = std::uint32_t(i);
        rays.push_back(ray);
    }
    return rays;
}

// Embree as its manual shows it, without anything of the engine.
class BareEmbree {
  public:
    explicit BareEmbree(const World& world)
        : device_(rtcNewDevice(nullptr)), top_(new_scene(RTC_SCENE_FLAG_DYNAMIC)) {
        std::vector<RTCScene> meshes;
        for (const WorldMesh& mesh : world.meshes) meshes.push_back(add_mesh(world, mesh));
        for (const WorldInstance& instance : world.instances) {
            RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(geometry, meshes[instance.mesh]);
            rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                                    &instance.world_from_object[0][0]);
            attach(top_, geometry);
        }
        rtcCommitScene(top_);
        for (RTCScene mesh : meshes) rtcReleaseScene(mesh);
    }
    ~BareEmbree() {
        rtcReleaseScene(top_);
        rtcReleaseDevice(device_);
    }

    void trace(std::vector<RTCRay>& rays) const {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 512), [&](const auto& range) {
            const FlushDenormals flush;
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                rtcOccluded1(top_, &context, &rays[i]);
            }
        });
    }

  private:
    RTCScene new_scene(RTCSceneFlags more = RTC_SCENE_FLAG_NONE) const {
        RTCScene scene = rtcNewScene(device_);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | more);
        return scene;
    }

    static void attach(RTCScene scene, RTCGeometry geometry) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }

    RTCScene add_mesh(const World& world, const WorldMesh& mesh) const {
        RTCScene scene = new_scene();
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   &world.vertex_rows[std::size_t(mesh.first_vertex) * VERTEX_ROWS], 0,
                                   VERTEX_ROWS * sizeof(glm::uvec4), mesh.vertex_count);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   &world.triangles[mesh.first_triangle], 0, sizeof(glm::uvec3),
                                   mesh.triangle_count);
        attach(scene, geometry);
        rtcCommitScene(scene);
        return scene;
    }

    RTCDevice device_;
    RTCScene top_;
};

struct Bench {
    World world = make_world();
    std::vector<RayRecord> rays = make_rays(world);
    std::vector<glm::uvec4> rows = std::vector<glm::uvec4>(rays.size() * RAY_ROWS);
    std::vector<float> visibility = std::vector<float>(rays.size());
    std::vector<RTCRay> bare_rays = std::vector<RTCRay>(rays.size());
    std::unique_ptr<RayTracer> tracer = create_embree_tracer(world);
    BareEmbree bare{world};

    Bench() {
        for (std::size_t i = 0; i < rays.size(); ++i) pack_ray(rays[i], rows[2 * i], rows[2 * i + 1]);
    }

    // Embree overwrites its rays, so they are made anew before each run, outside the clock.
    void reset_bare_rays() {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayRecord& r = rays[i];
            bare_rays[i] = RTCRay{
                r.origin.x, r.origin.y,  r.origin.z, 0.0f, r.direction.x, r.direction.y, r.direction.z, 0.0f,
                r.max_t,    0xffffffffu, 0u,         0u};
        }
    }

    double time_engine_s() {
        const auto start = std::chrono::steady_clock::now();
        tracer->trace_visibility(rows, visibility, {});
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    double time_bare_s() {
        reset_bare_rays();
        const auto start = std::chrono::steady_clock::now();
        bare.trace(bare_rays);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
};

// Times both in turn, so that a busy machine slows both alike, and compares the best of each.
void compare_with_bare_embree(benchmark::State& state) {
    Bench bench;
    const WorkerLimit limit{int(state.range(0))};
    double engine_s = 1e30, bare_s = 1e30;
    for (auto _ : state) {
        engine_s = std::min(engine_s, bench.time_engine_s());
        bare_s = std::min(bare_s, bench.time_bare_s());
    }
    std::size_t different = 0;
    for (std::size_t i = 0; i < RAY_COUNT; ++i) {
        different += (bench.visibility[i] != 0.0f) != (bench.bare_rays[i].tfar >= 0.0f);
    }
    if (different > 0) state.SkipWithError("the engine and bare Embree disagree");
    state.counters["engine_Mrays_per_s"] = 1e-6 * double(RAY_COUNT) / engine_s;
    state.counters["bare_Mrays_per_s"] = 1e-6 * double(RAY_COUNT) / bare_s;
    state.counters["share_of_bare"] = bare_s / engine_s;
}

BENCHMARK(compare_with_bare_embree)
    ->Arg(1)
    ->Arg(0)
    ->UseRealTime()
    ->MinTime(2.0)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tarn

BENCHMARK_MAIN();
