#include "reference/path_integrator.h"

#include "shared/math/shadow_ray.h"

namespace tarn {
namespace {

// Paths longer than this end at random, with the survivors' weight raised to match.
constexpr int ROULETTE_AFTER = 4;
constexpr float MAX_SURVIVAL = 0.95f;

// Numbers that one bounce uses, from DIMENSION_BOUNCE + 8 * bounce on.
constexpr std::uint32_t LIGHT_PLACE = 0, LIGHT_KIND = 1, CONTINUE = 2;

// Power heuristic, exponent 2 (Veach, "Robust Monte Carlo Methods for Light Transport Simulation",
// 1997, 9.2.4), in a form without overflow. `pdf` > 0.
float power_heuristic(float pdf, float other_pdf) {
    const float ratio = other_pdf / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

bool is_black(const glm::vec3& v) {
    return max_component(v) == 0.0f;
}

}  // namespace

PathIntegrator::PathIntegrator(const World& world, const LightTree& light_tree, const RayTracer& tracer,
                               const ReferenceSettings& settings)
    : world_(world), tracer_(tracer), settings_(settings), scene_(world, &light_tree) {}

glm::vec3 PathIntegrator::sample_radiance(int column, int row, std::uint32_t sample) {
    key_ = RandomKey{std::uint32_t(row) * std::uint32_t(settings_.width) + std::uint32_t(column), sample,
                     settings_.seed};
    const RayRecord ray = make_camera_ray(column, row);
    const auto hit = trace(ray, RAY_CAMERA, BackFaces::PASS);
    if (!hit) return scene_.load_environment(ray.direction);
    return gather_path(find_first_vertex(*hit, ray.direction));
}

// Without a pixel filter nearly all samples of a pixel begin at one place.
const PathIntegrator::Vertex& PathIntegrator::find_first_vertex(const Hit& hit, const glm::vec3& direction) {
    const bool is_known = hit.instance == first_.hit.instance && hit.primitive == first_.hit.primitive &&
                          hit.barycentrics == first_.hit.barycentrics && direction == first_.direction;
    if (!is_known) first_ = {hit, direction, make_vertex(hit, direction)};
    return first_.vertex;
}

RayRecord PathIntegrator::make_camera_ray(int column, int row) const {
    glm::vec2 position_px(float(column) + 0.5f, float(row) + 0.5f);
    if (settings_.box_pixel_filter) {
        const glm::vec4 u = random4(key_, DIMENSION_PIXEL);
        position_px = glm::vec2(float(column) + u.x, float(row) + u.y);
    }
    const PixelRay through =
        camera_ray(settings_.camera, position_px, glm::vec2(settings_.width, settings_.height));
    RayRecord ray;
    ray.origin = through.origin;
    ray.max_t = RAY_INFINITY;
    ray.direction = through.direction;
    ray.pixel = key_.pixel;
    return ray;
}

std::optional<Hit> PathIntegrator::trace(const RayRecord& ray, std::uint32_t ray_kind, BackFaces back_faces) {
    ++rays_;
    return tracer_.trace_closest(ray, CoverageKey{key_.frame, key_.seed, ray_kind}, back_faces);
}

PathIntegrator::Vertex PathIntegrator::make_vertex(const Hit& hit, const glm::vec3& direction) {
    Vertex vertex;
    vertex.surface = scene_.evaluate_surface(hit.instance, hit.primitive, hit.barycentrics, direction);
    vertex.frame = make_frame(vertex.surface.point.shading_normal);
    vertex.brdf = prepare_brdf(vertex.surface.point.material, to_local(vertex.frame, -direction));
    return vertex;
}

bool PathIntegrator::may_emit(const Hit& hit) {
    const std::uint32_t material = scene_.load_instance(hit.instance).material;
    return !is_black(scene_.load_material(material).emission);
}

// The camera's first surface onwards. Emission found by bounce rays was also looked for by direct sampling
// one step earlier: the weights of the two add up to one.
glm::vec3 PathIntegrator::gather_path(Vertex vertex) {
    glm::vec3 radiance = vertex.surface.emission;
    if (vertex.surface.unlit) return radiance;
    glm::vec3 throughput(1.0f);
    const int bounces = settings_.direct_only ? 1 : settings_.bounces;
    for (int bounce = 0; bounce < bounces; ++bounce) {
        const std::uint32_t dimension = DIMENSION_BOUNCE + 8u * std::uint32_t(bounce);
        radiance += throughput * sample_direct_light(vertex, dimension);

        const glm::vec4 u = random4(key_, dimension + CONTINUE);
        const BrdfSample next = sample_direction(vertex, glm::vec3(u));
        if (is_black(next.weight)) break;
        throughput *= next.weight;
        if (bounce + 1 >= ROULETTE_AFTER) {
            const float survival = min(MAX_SURVIVAL, max_component(throughput));
            if (u.w >= survival) break;
            throughput /= survival;
        }

        const ShadingPoint& point = vertex.surface.point;
        RayRecord ray;
        ray.origin =
            offset_ray_origin(point.position, point.position_error, point.geometric_normal, next.direction);
        ray.max_t = RAY_INFINITY;
        ray.direction = next.direction;
        ray.pixel = key_.pixel;
        const auto hit = trace(ray, RAY_BOUNCE + std::uint32_t(bounce), BackFaces::HIT);
        if (!hit) {
            radiance += throughput * weigh_sky(next.direction, next.pdf_solid_angle);
            break;
        }
        // Where the path ends, all that counts is what the surface emits.
        if (bounce + 1 == bounces && !may_emit(*hit)) break;
        const Vertex reached = make_vertex(*hit, next.direction);
        if (reached.surface.unlit) break;
        radiance += throughput * weigh_emission(vertex, reached, *hit, next.pdf_solid_angle);
        vertex = reached;
    }
    return radiance;
}

// ---- Light sampling
// -----------------------------------------------------------------------------------------------

// A place on a light or in the sky; its pdf holds every choice that was made.
SceneAccess::LightCandidate PathIntegrator::draw_light(const ShadingPoint& point, std::uint32_t dimension) {
    const float sky_probability = scene_.environment_probability();
    const glm::uvec4 bits = random_bits4(key_, dimension + LIGHT_PLACE);
    const float u = random4(key_, dimension + LIGHT_KIND).x;
    if (u < sky_probability) {
        SceneAccess::LightCandidate sky = scene_.draw_environment(bits);
        sky.pdf *= sky_probability;
        return sky;
    }
    if (scene_.get_light_count() == 0u) return scene_.no_candidate();
    SceneAccess::LightCandidate light =
        settings_.light_tree ? scene_.draw_light_by_tree(bits, point.position, point.shading_normal)
                             : scene_.draw_light_by_power(bits);
    light.pdf *= 1.0f - sky_probability;
    return light;
}

// Probability with which draw_light takes a light, the sky left aside.
float PathIntegrator::light_probability(const ShadingPoint& point, std::uint32_t light) {
    return settings_.light_tree ? scene_.light_tree_pmf(light, point.position, point.shading_normal)
                                : world_.lights.pmf[light];
}

// Direct light at a vertex by one sample of the lights, MIS weight included.
glm::vec3 PathIntegrator::sample_direct_light(const Vertex& vertex, std::uint32_t dimension) {
    const ShadingPoint& point = vertex.surface.point;
    const SceneAccess::LightCandidate candidate = draw_light(point, dimension);
    if (!(candidate.pdf > 0.0f)) return glm::vec3(0.0f);
    const IncidentLight incident = scene_.load_incident_light(candidate.drawn, point.position);
    const bool is_sky = candidate.drawn.light == LIGHT_ENVIRONMENT;
    const bool has_surface = dot(incident.light_normal, incident.light_normal) > 0.0f;
    const bool can_be_hit = is_sky || has_surface;
    if (can_be_hit && settings_.strategy == LightStrategy::BRDF_ONLY) return glm::vec3(0.0f);
    glm::vec3 reflected = reflect_light(point, vertex.frame, vertex.brdf, incident);
    if (is_black(reflected)) return glm::vec3(0.0f);

    const RayRecord shadow =
        make_shadow_ray(point, incident, scene_.load_light_error(candidate.drawn), key_.pixel);
    ++rays_;
    if (!tracer_.is_visible(shadow, CoverageKey{key_.frame, key_.seed, RAY_SHADOW})) return glm::vec3(0.0f);

    const glm::vec3 light_local = to_local(vertex.frame, incident.direction);
    float weight = 1.0f;
    if (can_be_hit) {
        const float geometry = is_sky ? 1.0f
                                      : dot(incident.light_normal, -incident.direction) /
                                            (incident.distance * incident.distance);
        const float pdf_brdf = pdf_brdf_solid_angle(point.material, vertex.brdf, light_local);
        weight = weigh_light_sample(candidate.pdf / geometry, pdf_brdf);
    }
    if (settings_.planted_bug == PlantedBug::DROP_COSINE) reflected /= light_local.z;
    if (settings_.planted_bug == PlantedBug::DROP_LIGHT_PDF) return reflected * weight;
    return reflected * (weight / candidate.pdf);
}

// ---- BRDF sampling
// ------------------------------------------------------------------------------------------------

PathIntegrator::BrdfSample PathIntegrator::sample_direction(const Vertex& vertex, const glm::vec3& u) const {
    const ShadingPoint& point = vertex.surface.point;
    const glm::vec3 local = sample_brdf(point.material, vertex.brdf, u);
    BrdfSample sample;
    sample.direction = from_local(vertex.frame, local);
    sample.pdf_solid_angle = pdf_brdf_solid_angle(point.material, vertex.brdf, local);
    sample.weight = glm::vec3(0.0f);
    if (!(sample.pdf_solid_angle > 0.0f) || dot(point.geometric_normal, sample.direction) <= 0.0f)
        return sample;
    const BrdfValue value = evaluate_brdf_parts(point.material, vertex.brdf, local);
    sample.weight =
        (point.material.diffuse_albedo * value.diffuse + value.specular) * (local.z / sample.pdf_solid_angle);
    return sample;
}

glm::vec3 PathIntegrator::weigh_sky(const glm::vec3& direction, float pdf_brdf) {
    const glm::vec3 radiance = scene_.load_environment(direction);
    if (is_black(radiance)) return radiance;
    const float pdf_light = scene_.environment_pdf_solid_angle(direction) * scene_.environment_probability();
    return radiance * weigh_brdf_sample(pdf_brdf, pdf_light);
}

glm::vec3 PathIntegrator::weigh_emission(const Vertex& from, const Vertex& to, const Hit& hit,
                                         float pdf_brdf) {
    if (is_black(to.surface.emission)) return glm::vec3(0.0f);
    const float pdf_light = light_pdf_solid_angle(from.surface.point, hit);
    return to.surface.emission * weigh_brdf_sample(pdf_brdf, pdf_light);
}

// Density with which draw_light gives the emissive place `hit`, as seen from `point`; 0 where it never does.
float PathIntegrator::light_pdf_solid_angle(const ShadingPoint& point, const Hit& hit) {
    const std::uint32_t index = scene_.find_triangle_light(hit.instance, hit.primitive);
    if (index == INVALID_INDEX) return 0.0f;
    const Light light = scene_.load_light(index);
    const IncidentLight incident =
        incident_from_triangle(light, hit.barycentrics, glm::vec3(1.0f), point.position);
    const float geometry = incident.value.x;
    if (!(geometry > 0.0f)) return 0.0f;
    const float pdf_area =
        light_probability(point, index) * (1.0f - scene_.environment_probability()) / triangle_area(light);
    return pdf_area / geometry;
}

// ---- Weights of the two strategies
// --------------------------------------------------------------------------------

float PathIntegrator::weigh_light_sample(float pdf_light, float pdf_brdf) const {
    if (settings_.strategy == LightStrategy::LIGHTS_ONLY) return 1.0f;
    return power_heuristic(pdf_light, pdf_brdf);
}

// What light sampling can never find belongs to BRDF sampling in full, whatever the strategy.
float PathIntegrator::weigh_brdf_sample(float pdf_brdf, float pdf_light) const {
    const bool bug = settings_.planted_bug == PlantedBug::DOUBLE_COUNT_EMISSION;
    if (pdf_light == 0.0f || bug || settings_.strategy == LightStrategy::BRDF_ONLY) return 1.0f;
    if (settings_.strategy == LightStrategy::LIGHTS_ONLY) return 0.0f;
    return power_heuristic(pdf_brdf, pdf_light);
}

}  // namespace tarn
