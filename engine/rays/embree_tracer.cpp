// Embree behind the RayTracer interface: one BVH per mesh, instances on top.
//
// A hit's meaning (alpha, facing) comes from the world's own tables, by two filters. Coverage belongs to
// geometries and is set where a mesh has an instance with an alpha test. Facing belongs to the query: camera
// rays alone bring it along. Both see object space, where facing needs no care for mirrored instances: the
// determinant's sign turns the normal and the winding alike. Flattened copies lie in world space, where the
// winding of a mirrored one is turned.
#include <cmath>

#include "rays/embree_handles.h"
#include "rays/embree_mesh.h"
#include "rays/ray_checks.h"
#include "rays/ray_tracer.h"

namespace tarn {
namespace {

// What filters need to know of the ray. Embree hands the context through to them.
struct QueryContext {
    RTCIntersectContext embree;  // first, since filters get a pointer to it
    const World* world;
    CoverageKey key;
    std::uint32_t pixel;
};

const QueryContext& context_of(const RTCFilterFunctionNArguments* arguments) {
    return *reinterpret_cast<const QueryContext*>(arguments->context);
}

void filter_coverage(const RTCFilterFunctionNArguments* arguments) {
    const QueryContext& query = context_of(arguments);
    const unsigned int n = arguments->N;
    for (unsigned int i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const glm::vec2 barycentrics(RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i));
        const bool covered =
            is_hit_covered(*query.world, query.key, query.pixel, RTCHitN_instID(arguments->hit, n, i, 0),
                           RTCHitN_primID(arguments->hit, n, i), barycentrics);
        if (!covered) arguments->valid[i] = 0;
    }
}

void filter_back_faces(const RTCFilterFunctionNArguments* arguments) {
    const QueryContext& query = context_of(arguments);
    const unsigned int n = arguments->N;
    for (unsigned int i = 0; i < n; ++i) {
        if (arguments->valid[i] != -1) continue;
        const std::uint32_t flags = query.world->flags_of(RTCHitN_instID(arguments->hit, n, i, 0));
        if ((flags & MATERIAL_DOUBLE_SIDED) != 0u) continue;
        const glm::vec3 normal(RTCHitN_Ng_x(arguments->hit, n, i), RTCHitN_Ng_y(arguments->hit, n, i),
                               RTCHitN_Ng_z(arguments->hit, n, i));
        const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, n, i), RTCRayN_dir_y(arguments->ray, n, i),
                                  RTCRayN_dir_z(arguments->ray, n, i));
        const bool is_back = dot(normal, direction) > 0.0f;
        if (is_back != EmbreeMesh::is_winding_turned(arguments->geometryUserPtr)) arguments->valid[i] = 0;
    }
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
    target.id = 0;
    target.flags = 0;
}

// Whether Embree can take a ray into the instance's object space without losing its digits.
bool is_invertible(const glm::mat4& world_from_object) {
    const glm::dmat3 m(world_from_object);
    const double longest = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    return std::abs(glm::determinant(m)) > 1e-5 * longest;
}

class EmbreeTracer : public RayTracer {
  public:
    explicit EmbreeTracer(const World& world) : device_(rtcNewDevice(nullptr)) {
        if (!device_) check_embree(nullptr, "creating its device");
        rebuild(world);
    }

    void update(const World& world) override {
        if (meshes_.size() != world.meshes.size() || instances_.size() != world.instances.size()) {
            rebuild(world);
            return;
        }
        world_ = &world;
        bool changed = false;
        for (std::size_t i = 0; i < meshes_.size(); ++i) {
            mesh_changed_[i] = meshes_[i].update(world, world.meshes[i]);
        }
        for (std::uint32_t i = 0; i < instances_.size(); ++i) {
            if (!mesh_changed_[world.instances[i].mesh] &&
                instances_[i].revision == world.instances[i].revision) {
                continue;
            }
            place_instance(i);
            changed = true;
        }
        if (changed) rtcCommitScene(top_.get());
        check_embree(device_.get(), "updating the scene");
    }

    std::optional<Hit> trace_closest(const RayRecord& ray, const CoverageKey& key,
                                     BackFaces back_faces) const override {
        if (classify_ray(ray) != RayState::TRACEABLE) return std::nullopt;
        QueryContext query = make_query(ray, key);
        if (back_faces == BackFaces::PASS) query.embree.filter = filter_back_faces;
        RTCRayHit ray_hit;
        fill_ray(ray_hit.ray, ray);
        ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(top_.get(), &query.embree, &ray_hit);
        if (ray_hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        return Hit{ray_hit.hit.instID[0], ray_hit.hit.primID, glm::vec2(ray_hit.hit.u, ray_hit.hit.v),
                   ray_hit.ray.tfar};
    }

  private:
    struct PlacedInstance {
        EmbreeGeometry geometry;
        std::optional<EmbreeMesh> flattened;
        std::uint64_t revision = 0;
    };

    bool is_unoccluded(const RayRecord& ray, const CoverageKey& key) const override {
        QueryContext query = make_query(ray, key);
        RTCRay shadow;
        fill_ray(shadow, ray);
        rtcOccluded1(top_.get(), &query.embree, &shadow);
        return shadow.tfar >= 0.0f;  // Embree answers with -infinity
    }

    QueryContext make_query(const RayRecord& ray, const CoverageKey& key) const {
        QueryContext query;
        rtcInitIntersectContext(&query.embree);
        query.world = world_;
        query.key = key;
        query.pixel = ray.pixel;
        return query;
    }

    void rebuild(const World& world) {
        world_ = &world;
        top_.reset(rtcNewScene(device_.get()));
        rtcSetSceneFlags(top_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION |
                                         RTC_SCENE_FLAG_DYNAMIC);
        instances_.clear();
        meshes_.clear();
        filtered_.assign(world.meshes.size(), false);
        for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
            if (has_alpha_test(world.flags_of(i))) filtered_[world.instances[i].mesh] = true;
        }
        meshes_.reserve(world.meshes.size());
        for (std::size_t i = 0; i < world.meshes.size(); ++i) {
            meshes_.emplace_back(device_.get(), world, world.meshes[i], filter_of(std::uint32_t(i)));
        }
        mesh_changed_.assign(world.meshes.size(), false);
        instances_.resize(world.instances.size());
        for (std::uint32_t i = 0; i < instances_.size(); ++i) {
            instances_[i].geometry.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
            rtcAttachGeometryByID(top_.get(), instances_[i].geometry.get(), i);
            place_instance(i);
        }
        rtcCommitScene(top_.get());
        check_embree(device_.get(), "building the scene");
    }

    RTCFilterFunctionN filter_of(std::uint32_t mesh) const {
        return filtered_[mesh] ? filter_coverage : nullptr;
    }

    void place_instance(std::uint32_t index) {
        const WorldInstance& source = world_->instances[index];
        PlacedInstance& placed = instances_[index];
        glm::mat4 transform = source.world_from_object;
        RTCScene scene = meshes_[source.mesh].scene();
        if (!is_invertible(transform)) {
            placed.flattened.emplace(device_.get(), *world_, source, filter_of(source.mesh));
            scene = placed.flattened->scene();
            transform = glm::mat4(1.0f);
        }
        rtcSetGeometryInstancedScene(placed.geometry.get(), scene);
        rtcSetGeometryTransform(placed.geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &transform[0][0]);
        rtcCommitGeometry(placed.geometry.get());
        placed.revision = source.revision;
    }

    const World* world_ = nullptr;
    EmbreeDevice device_;
    std::vector<EmbreeMesh> meshes_;
    std::vector<bool> filtered_;      // per mesh: some instance has an alpha test
    std::vector<bool> mesh_changed_;  // per mesh: in the update under way
    std::vector<PlacedInstance> instances_;
    EmbreeScene top_;
};

}  // namespace

std::unique_ptr<RayTracer> create_embree_tracer(const World& world) {
    return std::make_unique<EmbreeTracer>(world);
}

std::string describe_ray_library() {
    return RTC_VERSION_STRING;
}

}  // namespace tarn
