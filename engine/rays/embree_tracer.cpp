// Embree behind the RayTracer interface: one BVH of what stands still, instances of what moves, at the
// present moment and the one before.
//
// A hit's meaning (alpha, facing) comes from the world's own tables, by filters. Coverage belongs to
// geometries and is set where a mesh has an instance with an alpha test. Facing belongs to the query: camera
// rays alone bring it along. Of an instance both see object space, where facing needs no care for mirrored
// ones: the determinant's sign turns the normal and the winding alike. What stands still lies in world space,
// where the winding of a mirrored instance is turned. While the still scene has instances that have left it,
// queries also bring a filter that passes these.
#include <array>

#include "rays/embree_handles.h"
#include "rays/embree_mesh.h"
#include "rays/embree_snapshot.h"
#include "rays/embree_still_world.h"
#include "rays/geometry_revisions.h"
#include "rays/ray_checks.h"
#include "rays/ray_tracer.h"

namespace tarn {
namespace {

// What filters need to know of the ray. Embree hands the context through to them.
struct QueryContext {
    EmbreeContext embree;  // first, since filters get a pointer to it
    const World* world;
    const EmbreeSnapshot* snapshot;
    CoverageKey key;
};

const QueryContext& context_of(const RTCFilterFunctionNArguments* arguments) {
    return *reinterpret_cast<const QueryContext*>(arguments->context);
}

std::uint32_t instance_of(const QueryContext& query, const RTCFilterFunctionNArguments* arguments,
                          unsigned int i) {
    return query.snapshot->instance_of(RTCHitN_instID(arguments->hit, arguments->N, i, 0),
                                       RTCHitN_geomID(arguments->hit, arguments->N, i));
}

// Passes what was there and has left.
void filter_left(const RTCFilterFunctionNArguments* arguments) {
    const EmbreeSnapshot& snapshot = *context_of(arguments).snapshot;
    const unsigned int n = arguments->N;
    for (unsigned int i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const std::uint32_t instance = RTCHitN_instID(arguments->hit, n, i, 0);
        if (snapshot.is_left(instance, RTCHitN_geomID(arguments->hit, n, i))) arguments->valid[i] = 0;
    }
}

void filter_coverage(const RTCFilterFunctionNArguments* arguments) {
    const QueryContext& query = context_of(arguments);
    const unsigned int n = arguments->N;
    for (unsigned int i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const glm::vec2 barycentrics(RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i));
        const std::uint32_t pixel = RTCRayN_id(arguments->ray, n, i);
        const bool covered = is_hit_covered(*query.world, query.snapshot->material_rows(), query.key, pixel,
                                            instance_of(query, arguments, i),
                                            RTCHitN_primID(arguments->hit, n, i), barycentrics);
        if (!covered) arguments->valid[i] = 0;
    }
}

void filter_back_faces(const RTCFilterFunctionNArguments* arguments) {
    const QueryContext& query = context_of(arguments);
    const unsigned int n = arguments->N;
    for (unsigned int i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const std::uint32_t flags = query.world->flags_of(instance_of(query, arguments, i));
        if ((flags & MATERIAL_DOUBLE_SIDED) != 0u) continue;
        const glm::vec3 normal(RTCHitN_Ng_x(arguments->hit, n, i), RTCHitN_Ng_y(arguments->hit, n, i),
                               RTCHitN_Ng_z(arguments->hit, n, i));
        const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, n, i), RTCRayN_dir_y(arguments->ray, n, i),
                                  RTCRayN_dir_z(arguments->ray, n, i));
        const bool is_back = dot(normal, direction) > 0.0f;
        if (is_back != EmbreeMesh::is_winding_turned(arguments->geometryUserPtr)) arguments->valid[i] = 0;
    }
}

void filter_left_and_back_faces(const RTCFilterFunctionNArguments* arguments) {
    filter_left(arguments);
    filter_back_faces(arguments);
}

void fill_ray(RTCRay& target, const RayRecord& ray) {
    target.org_x = ray.origin.x;
    target.org_y = ray.origin.y;
    target.org_z = ray.origin.z;
    target.tnear = 0.0f;
    target.dir_x = ray.direction.x;
    target.dir_y = ray.direction.y;
    target.dir_z = ray.direction.z;
    target.time = 0.0f;
    target.tfar = ray.max_t;
    target.mask = 0xffffffffu;
    target.id = ray.pixel;
    target.flags = 0;
}

void fill_ray(RTCRay8& target, std::size_t i, const RayRecord& ray) {
    target.org_x[i] = ray.origin.x;
    target.org_y[i] = ray.origin.y;
    target.org_z[i] = ray.origin.z;
    target.tnear[i] = 0.0f;
    target.dir_x[i] = ray.direction.x;
    target.dir_y[i] = ray.direction.y;
    target.dir_z[i] = ray.direction.z;
    target.time[i] = 0.0f;
    target.tfar[i] = ray.max_t;
    target.mask[i] = 0xffffffffu;
    target.id[i] = ray.pixel;
    target.flags[i] = 0;
}

class EmbreeTracer : public RayTracer {
  public:
    explicit EmbreeTracer(const World& world) : device_(rtcNewDevice(nullptr)) {
        if (!device_) check_embree(nullptr, "creating its device");
        rebuild(world);
    }

    void update(const World& world) override {
        if (!has_same_memory(world)) {
            rebuild(world);
            revision_ += 2;  // nothing is left of the moment before
            return;
        }
        world_ = &world;
        still_->update(world);
        GeometryRevisions now = geometry_revisions_of(world);
        if (now == followed_) {
            snapshots_[present_]->follow(world, still_->scene());  // which may be another one
            return;
        }
        followed_ = std::move(now);
        // The older of the two moments becomes the present one.
        present_ = 1 - present_;
        if (snapshots_[present_]) {
            snapshots_[present_]->follow(world, still_->scene());
        } else {
            snapshots_[present_] = take_snapshot(world);
        }
        ++revision_;
        check_embree(device_.get(), "updating the scene");
    }

    std::uint64_t geometry_revision() const override { return revision_; }

    std::optional<Hit> trace_closest(const RayRecord& ray, const CoverageKey& key,
                                     BackFaces back_faces) const override {
        if (classify_ray(ray) != RayState::TRACEABLE) return std::nullopt;
        QueryContext query = make_query(key, snapshot_at(Moment::PRESENT));
        RTCRayHit ray_hit;
        fill_ray(ray_hit.ray, ray);
        ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        intersect_one(query.snapshot->scene(), query.embree, filter_for(*query.snapshot, back_faces),
                      ray_hit);
        if (ray_hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        return Hit{query.snapshot->instance_of(ray_hit.hit.instID[0], ray_hit.hit.geomID), ray_hit.hit.primID,
                   glm::vec2(ray_hit.hit.u, ray_hit.hit.v), ray_hit.ray.tfar};
    }

  private:
    bool is_unoccluded(const RayRecord& ray, const CoverageKey& key, Moment moment) const override {
        QueryContext query = make_query(key, snapshot_at(moment));
        RTCRay shadow;
        fill_ray(shadow, ray);
        occlude_one(query.snapshot->scene(), query.embree, filter_for(*query.snapshot, BackFaces::HIT),
                    shadow);
        return shadow.tfar >= 0.0f;  // Embree answers with -infinity
    }

    // Without the filter of facing, which would be called for every triangle on the way: few rays meet a back
    // first, and those are traced again.
    void trace_packet(std::span<const RayRecord, PACKET> rays, std::size_t count, const CoverageKey& key,
                      std::span<Hit, PACKET> hits) const override {
        QueryContext query = make_query(key, snapshot_at(Moment::PRESENT));
        alignas(32) int valid[PACKET] = {};
        RTCRayHit8 packet;
        for (std::size_t i = 0; i < count; ++i) {
            valid[i] = classify_ray(rays[i]) == RayState::TRACEABLE ? -1 : 0;
            fill_ray(packet.ray, i, rays[i]);
            packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        intersect_eight(valid, query.snapshot->scene(), query.embree,
                        filter_for(*query.snapshot, BackFaces::HIT), packet);
        for (std::size_t i = 0; i < count; ++i) {
            hits[i] = Hit{};
            if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
            if (may_be_back(*query.snapshot, packet, i)) {
                hits[i] = trace_closest(rays[i], key, BackFaces::PASS).value_or(Hit{});
                continue;
            }
            hits[i] = {query.snapshot->instance_of(packet.hit.instID[0][i], packet.hit.geomID[i]),
                       packet.hit.primID[i], glm::vec2(packet.hit.u[i], packet.hit.v[i]), packet.ray.tfar[i]};
        }
    }

    // Whether a hit lies on the back of a single-sided surface; of instances that move, whose normals are
    // those of object space, whether their surface has one.
    bool may_be_back(const EmbreeSnapshot& snapshot, const RTCRayHit8& packet, std::size_t i) const {
        const std::uint32_t instance_id = packet.hit.instID[0][i];
        const std::uint32_t instance = snapshot.instance_of(instance_id, packet.hit.geomID[i]);
        if ((world_->flags_of(instance) & MATERIAL_DOUBLE_SIDED) != 0u) return false;
        if (instance == instance_id) return true;
        const float towards = packet.hit.Ng_x[i] * packet.ray.dir_x[i] +
                              packet.hit.Ng_y[i] * packet.ray.dir_y[i] +
                              packet.hit.Ng_z[i] * packet.ray.dir_z[i];
        return (towards > 0.0f) != world_->instances[instance].mirrored;
    }

    static RTCFilterFunctionN filter_for(const EmbreeSnapshot& snapshot, BackFaces back_faces) {
        if (back_faces == BackFaces::HIT) return snapshot.has_left() ? filter_left : nullptr;
        return snapshot.has_left() ? filter_left_and_back_faces : filter_back_faces;
    }

    const EmbreeSnapshot& snapshot_at(Moment moment) const {
        return *snapshots_[moment == Moment::PRESENT ? present_ : 1 - present_];
    }

    QueryContext make_query(const CoverageKey& key, const EmbreeSnapshot& snapshot) const {
        QueryContext query;
        init_context(query.embree);
        query.world = world_;
        query.snapshot = &snapshot;
        query.key = key;
        return query;
    }

    // Whether the meshes that Embree reads in place are where they were.
    bool has_same_memory(const World& world) const {
        return world.vertex_rows.data() == vertices_ && world.triangles.data() == triangles_ &&
               world.meshes.size() == is_filtered_.size() &&
               world.instances.size() == followed_.instances.size();
    }

    void rebuild(const World& world) {
        world_ = &world;
        vertices_ = world.vertex_rows.data();
        triangles_ = world.triangles.data();
        followed_ = geometry_revisions_of(world);
        snapshots_ = {};
        is_filtered_.assign(world.meshes.size(), false);
        for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
            if (world.has_alpha_test(i)) is_filtered_[world.instances[i].mesh] = true;
        }
        static_meshes_.clear();
        still_ = std::make_unique<EmbreeStillWorld>(device_.get(), world, is_filtered_, filter_coverage);
        snapshots_[present_] = take_snapshot(world);
        check_embree(device_.get(), "building the scene");
    }

    std::unique_ptr<EmbreeSnapshot> take_snapshot(const World& world) {
        return std::make_unique<EmbreeSnapshot>(device_.get(), world, still_->scene(), static_meshes_,
                                                is_filtered_, filter_coverage);
    }

    const World* world_ = nullptr;
    const void* vertices_ = nullptr;
    const void* triangles_ = nullptr;
    GeometryRevisions followed_;
    std::uint64_t revision_ = 0;
    EmbreeDevice device_;
    std::vector<bool> is_filtered_;  // per mesh: some instance has an alpha test
    StaticMeshes static_meshes_{device_.get(), is_filtered_, filter_coverage};
    std::unique_ptr<EmbreeStillWorld> still_;
    std::array<std::unique_ptr<EmbreeSnapshot>, 2> snapshots_;  // the second once something moves
    std::size_t present_ = 0;
};

}  // namespace

std::unique_ptr<RayTracer> create_embree_tracer(const World& world) {
    return std::make_unique<EmbreeTracer>(world);
}

std::string describe_ray_library() {
    return RTC_VERSION_STRING;
}

}  // namespace tarn
