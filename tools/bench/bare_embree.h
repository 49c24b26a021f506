// Embree as its manual shows it, with nothing of the engine around it: what the engine's ray passes are
// measured against.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

#include "rays/embree_api.h"
#include "rays/flush_denormals.h"
#include "rays/ray_checks.h"

namespace tarn {

// The world's triangles under one BVH, whatever of them moves: the fastest that Embree offers for a scene
// that stands still. Robust, as the engine's is.
class BareEmbree {
  public:
    // `key` decides about hits on surfaces with an alpha test.
    BareEmbree(const World& world, const CoverageKey& key)
        : world_(world), key_(key), device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        for (std::uint32_t i = 0; i < world.instances.size(); ++i) add_instance(i);
        rtcCommitScene(scene_);
    }
    ~BareEmbree() {
        rtcReleaseScene(scene_);
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
                occlude_one(scene_, context.embree, nullptr, rays[i]);
            }
        });
    }

    // Eight rays of neighbouring pixels at a time, what they meet first thrown away.
    void trace_closest(const std::vector<RTCRay>& rays) const {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size() / 8, 64), [&](const auto& range) {
            const FlushDenormals flush;
            Context context{{}, this};
            init_context(context.embree);
            alignas(32) int valid[8];
            std::fill(std::begin(valid), std::end(valid), -1);
            for (std::size_t packet = range.begin(); packet != range.end(); ++packet) {
                RTCRayHit8 hits = make_packet(&rays[8 * packet]);
                intersect_eight(valid, scene_, context.embree, nullptr, hits);
            }
        });
    }

  private:
    static RTCRayHit8 make_packet(const RTCRay* rays) {
        RTCRayHit8 packet = {};
        for (int i = 0; i < 8; ++i) {
            packet.ray.org_x[i] = rays[i].org_x;
            packet.ray.org_y[i] = rays[i].org_y;
            packet.ray.org_z[i] = rays[i].org_z;
            packet.ray.dir_x[i] = rays[i].dir_x;
            packet.ray.dir_y[i] = rays[i].dir_y;
            packet.ray.dir_z[i] = rays[i].dir_z;
            packet.ray.tfar[i] = rays[i].tfar;
            packet.ray.mask[i] = rays[i].mask;
            packet.ray.id[i] = rays[i].id;
            packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
        return packet;
    }

    struct Context {
        EmbreeContext embree;  // first, since the filter gets a pointer to it
        const BareEmbree* self;
    };

    // The scene's own rule, without which the answers would be others.
    static void filter(const RTCFilterFunctionNArguments* arguments) {
        const BareEmbree& self = *reinterpret_cast<const Context*>(arguments->context)->self;
        const unsigned int n = arguments->N;
        for (unsigned int i = 0; i < n; ++i) {
            if (arguments->valid[i] != -1) continue;
            const glm::vec2 barycentrics(RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i));
            const bool covered = is_hit_covered(
                self.world_, self.world_.material_rows, self.key_, RTCRayN_id(arguments->ray, n, i),
                RTCHitN_geomID(arguments->hit, n, i), RTCHitN_primID(arguments->hit, n, i), barycentrics);
            if (!covered) arguments->valid[i] = 0;
        }
    }

    void add_instance(std::uint32_t index) const {
        const WorldInstance& instance = world_.instances[index];
        const WorldMesh& mesh = world_.meshes[instance.mesh];
        if (mesh.triangle_count == 0) return;
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   &world_.triangles[mesh.first_triangle], 0, sizeof(glm::uvec3),
                                   mesh.triangle_count);
        auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.vertex_count));
        for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
            const std::size_t row = std::size_t(mesh.first_vertex + v) * VERTEX_ROWS;
            positions[v] =
                glm::vec3(instance.world_from_object * glm::vec4(row_xyz(world_.vertex_rows[row]), 1.0f));
        }
        if (world_.has_alpha_test(index)) {
            rtcSetGeometryOccludedFilterFunction(geometry, filter);
            rtcSetGeometryIntersectFilterFunction(geometry, filter);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene_, geometry, index);
        rtcReleaseGeometry(geometry);
    }

    const World& world_;
    CoverageKey key_;
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace tarn
