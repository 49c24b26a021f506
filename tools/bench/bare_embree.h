// Embree as its manual shows it, with nothing of the engine around it: what the engine's ray passes are
// measured against.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <vector>

#include "rays/embree_api.h"
#include "rays/flush_denormals.h"
#include "rays/ray_checks.h"

namespace tarn {

// The world's triangles in a two-level scene, built with the engine's choices of quality and robustness.
class BareEmbree {
  public:
    // `key` decides about hits on surfaces with an alpha test.
    BareEmbree(const World& world, const CoverageKey& key)
        : world_(world), key_(key), device_(rtcNewDevice(nullptr)), top_(new_scene(RTC_SCENE_FLAG_DYNAMIC)) {
        std::vector<bool> tested(world.meshes.size(), false);
        for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
            if (has_alpha_test(world.flags_of(i))) tested[world.instances[i].mesh] = true;
        }
        std::vector<RTCScene> meshes;
        for (std::size_t i = 0; i < world.meshes.size(); ++i) {
            meshes.push_back(add_mesh(world.meshes[i], tested[i]));
        }
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
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    // A ray in Embree's own layout.
    static RTCRay make_ray(const RayRecord& r) {
        return {r.origin.x,    r.origin.y, r.origin.z, 0.0f,        r.direction.x, r.direction.y,
                r.direction.z, 0.0f,       r.max_t,    0xffffffffu, r.pixel,       0u};
    }

    // Answers in the rays themselves: tfar is -infinity where something is in the way.
    void trace(std::vector<RTCRay>& rays) const {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 512), [&](const auto& range) {
            const FlushDenormals flush;
            Context context{{}, this};
            init_context(context.embree);
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                occlude_one(top_, context.embree, rays[i]);
            }
        });
    }

  private:
    struct Context {
        EmbreeContext embree;  // first, since the filter gets a pointer to it
        const BareEmbree* self;
    };

    // The scene's own rule, without which the answers would be others.
    static void filter(const RTCFilterFunctionNArguments* arguments) {
        const BareEmbree& self = *reinterpret_cast<const Context*>(arguments->context)->self;
        const RTCHit& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
        const RTCRay& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
        const bool covered = is_hit_covered(self.world_, self.world_.material_rows, self.key_, ray.id,
                                            hit.instID[0], hit.primID, glm::vec2(hit.u, hit.v));
        if (!covered) arguments->valid[0] = 0;
    }

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

    RTCScene add_mesh(const WorldMesh& mesh, bool alpha_tested) const {
        RTCScene scene = new_scene();
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   &world_.vertex_rows[std::size_t(mesh.first_vertex) * VERTEX_ROWS], 0,
                                   VERTEX_ROWS * sizeof(glm::uvec4), mesh.vertex_count);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   &world_.triangles[mesh.first_triangle], 0, sizeof(glm::uvec3),
                                   mesh.triangle_count);
        if (alpha_tested) rtcSetGeometryOccludedFilterFunction(geometry, filter);
        attach(scene, geometry);
        rtcCommitScene(scene);
        return scene;
    }

    const World& world_;
    CoverageKey key_;
    RTCDevice device_;
    RTCScene top_;
};

}  // namespace tarn
