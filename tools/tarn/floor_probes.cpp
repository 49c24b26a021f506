#include "floor_probes.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <chrono>
#include <cstring>

#include "bench/bare_embree.h"
#include "gl/fence.h"
#include "passes/culling.h"
#include "shared/math/random.h"

namespace tarn {
namespace {

template <class Work>
double time_work_ms(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// As passes are timed on llvmpipe: from an idle device to an idle device.
template <class Commands>
double time_commands_ms(const Commands& commands) {
    Fence().wait();
    return time_work_ms([&] {
        commands();
        Fence().wait();
    });
}

ShaderStage make_stage(GLenum type, const std::string& text) {
    return {type, ShaderSource{"#version 450 core\n" + text, {"floor"}, {}}};
}

Program make_raster_program() {
    const ShaderStage stages[] = {
        make_stage(GL_VERTEX_SHADER,
                   "layout(location = 0) in vec3 position;\n"
                   "uniform mat4 clip_from_world;\n"
                   "void main() { gl_Position = clip_from_world * vec4(position, 1.0); }\n"),
        make_stage(GL_FRAGMENT_SHADER, "void main() {}\n")};
    return Program("floor/raster", stages);
}

Program make_empty_program() {
    const ShaderStage stages[] = {
        make_stage(GL_COMPUTE_SHADER, "layout(local_size_x = 8, local_size_y = 8) in;\nvoid main() {}\n")};
    return Program("floor/empty", stages);
}

// As shaders/passes/gbuffer/raster.vert projects: reversed depth, row 0 on top.
glm::mat4 clip_from_world(const CameraRecord& camera, float depth_parameter) {
    const glm::vec3 right = camera.right / glm::dot(camera.right, camera.right);
    const glm::vec3 down = -camera.up / glm::dot(camera.up, camera.up);
    const glm::vec3 forward = camera.forward;
    const auto row = [&](const glm::vec3& axis) { return glm::vec4(axis, -glm::dot(axis, camera.position)); };
    const glm::vec4 none(0.0f, 0.0f, 0.0f, 1.0f);
    const glm::vec4 depth = camera.orthographic ? none - row(forward) / depth_parameter
                                                : glm::vec4(0.0f, 0.0f, 0.0f, depth_parameter);
    return glm::transpose(glm::mat4(row(right), row(down), depth, camera.orthographic ? none : row(forward)));
}

// Corners of the triangles in view, with outward windings alike; one-sided ones first.
std::vector<glm::vec3> collect_corners(const World& world, const CameraRecord& camera,
                                       std::size_t& one_sided) {
    std::vector<glm::vec3> corners[2];
    for (const TriangleRange& range : find_visible_ranges(world, camera)) {
        const WorldInstance& instance = world.instances[range.instance];
        const WorldMesh& mesh = world.meshes[instance.mesh];
        const bool two_sided = (world.flags_of(range.instance) & MATERIAL_DOUBLE_SIDED) != 0u;
        for (std::uint32_t i = 0; i < range.triangle_count; ++i) {
            glm::uvec3 triangle = world.triangles[mesh.first_triangle + range.first_triangle + i];
            if (instance.mirrored) std::swap(triangle.y, triangle.z);
            for (int corner = 0; corner < 3; ++corner) {
                const glm::uvec4 row =
                    world.vertex_rows[std::size_t(mesh.first_vertex + triangle[corner]) * VERTEX_ROWS];
                glm::vec3 position;
                std::memcpy(&position, &row, sizeof(position));
                corners[two_sided ? 1 : 0].push_back(
                    glm::vec3(instance.world_from_object * glm::vec4(position, 1.0f)));
            }
        }
    }
    one_sided = corners[0].size();
    corners[0].insert(corners[0].end(), corners[1].begin(), corners[1].end());
    return std::move(corners[0]);
}

}  // namespace

// ---- Rays ----

struct RayCapture::Threads {
    tbb::enumerable_thread_specific<std::vector<RayRecord>> rays;
};

RayCapture::RayCapture(const RayTracer& tracer) : tracer_(tracer), threads_(std::make_unique<Threads>()) {}

RayCapture::~RayCapture() = default;

std::optional<Hit> RayCapture::trace_closest(const RayRecord& ray, const CoverageKey& key,
                                             BackFaces back_faces) const {
    return tracer_.trace_closest(ray, key, back_faces);
}

bool RayCapture::is_unoccluded(const RayRecord& ray, const CoverageKey& key, Moment moment) const {
    threads_->rays.local().push_back(ray);
    return tracer_.is_visible(ray, key, moment);
}

std::vector<RayRecord> RayCapture::take_rays() {
    std::vector<RayRecord> rays;
    for (std::vector<RayRecord>& part : threads_->rays) rays.insert(rays.end(), part.begin(), part.end());
    threads_->rays.clear();
    std::stable_sort(rays.begin(), rays.end(),
                     [](const RayRecord& a, const RayRecord& b) { return a.pixel < b.pixel; });
    return rays;
}

struct BareRays::State {
    State(const World& world, const std::vector<RayRecord>& records) : embree(world, {}) {
        for (const RayRecord& record : records) rays.push_back(BareEmbree::make_ray(record));
    }
    BareEmbree embree;
    std::vector<RTCRay> rays;
};

BareRays::BareRays(const World& world, const std::vector<RayRecord>& rays)
    : state_(std::make_unique<State>(world, rays)) {}

BareRays::~BareRays() = default;

double BareRays::time_ms() {
    std::vector<RTCRay> rays = state_->rays;  // Embree answers in them
    return time_work_ms([&] { state_->embree.trace(rays); });
}

struct BareCameraRays::State {
    explicit State(const World& world) : embree(world, {0, 0, RAY_CAMERA}) {}
    BareEmbree embree;
    std::vector<RTCRay> rays;
};

BareCameraRays::BareCameraRays(const World& world, const CameraRecord& camera, int width_px, int height_px)
    : state_(std::make_unique<State>(world)) {
    for (int row = 0; row + 2 <= height_px; row += 2) {
        for (int column = 0; column + 4 <= width_px; column += 4) {
            for (int i = 0; i < 8; ++i) {
                const glm::ivec2 pixel(column + i % 4, row + i / 4);
                const PixelRay view =
                    camera_ray(camera, glm::vec2(pixel) + 0.5f, glm::vec2(width_px, height_px));
                state_->rays.push_back(BareEmbree::make_ray({view.origin, RAY_INFINITY, view.direction,
                                                             std::uint32_t(pixel.y * width_px + pixel.x)}));
            }
        }
    }
}

BareCameraRays::~BareCameraRays() = default;

double BareCameraRays::time_ms() {
    return time_work_ms([&] { state_->embree.trace_closest(state_->rays); });
}

// ---- Raster ----

BareRaster::BareRaster(const World& world, const CameraRecord& camera, int width_px, int height_px)
    : program_(make_raster_program()),
      depth_("floor/depth", width_px, height_px, GL_DEPTH_COMPONENT32F),
      target_("floor/raster", {}, &depth_),
      vertex_array_("floor/vertices") {
    std::size_t one_sided = 0;
    std::vector<glm::vec3> corners = collect_corners(world, camera, one_sided);
    one_sided_count_ = GLsizei(one_sided);
    count_ = GLsizei(corners.size());
    if (corners.empty()) corners.resize(3);
    vertices_ = std::make_unique<Buffer>(Buffer::from("floor/vertices", corners));
    vertex_array_.add_float_attribute(0, 3, *vertices_, 0, sizeof(glm::vec3));
    const double diameter = world.bounds.empty() ? 1.0 : glm::length(world.bounds.extent());
    const double depth_range = camera.orthographic ? 8.0 * diameter : 1e-5 * diameter;
    program_.set("clip_from_world", clip_from_world(camera, float(depth_range)));
}

double BareRaster::time_ms() {
    depth_.clear(glm::vec4(0.0f));
    const double ms = time_commands_ms([&] {
        program_.use();
        target_.bind();
        vertex_array_.bind();
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_GREATER);
        glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
        glFrontFace(GL_CW);
        if (one_sided_count_ > 0) glDrawArrays(GL_TRIANGLES, 0, one_sided_count_);
        glDisable(GL_CULL_FACE);
        if (count_ > one_sided_count_)
            glDrawArrays(GL_TRIANGLES, one_sided_count_, count_ - one_sided_count_);
    });
    glDisable(GL_DEPTH_TEST);
    return ms;
}

// ---- Passes ----

EmptyPass::EmptyPass(int width_px, int height_px)
    : program_(make_empty_program()), width_px_(width_px), height_px_(height_px) {}

double EmptyPass::time_ms() {
    return time_commands_ms([&] {
        program_.use();
        glDispatchCompute(GLuint((width_px_ + 7) / 8), GLuint((height_px_ + 7) / 8), 1);
        glMemoryBarrier(GL_ALL_BARRIER_BITS);
    });
}

double time_copy_ms(std::size_t bytes_read, std::size_t bytes_written) {
    constexpr std::size_t PIECE_BYTES = 1 << 18;
    std::vector<char> source(std::max<std::size_t>(bytes_read, 1), 1),
        target(std::max<std::size_t>(bytes_written, 1), 2);
    // What is read beyond what is written goes into a piece that stays in the cache, and the other way round.
    const std::size_t pieces = (std::max(bytes_read, bytes_written) + PIECE_BYTES - 1) / PIECE_BYTES;
    return time_work_ms([&] {
        tbb::parallel_for(std::size_t(0), pieces, [&](std::size_t piece) {
            thread_local std::vector<char> scratch(PIECE_BYTES, 3);
            const std::size_t at = piece * PIECE_BYTES;
            const auto left = [&](std::size_t size) {
                return at < size ? std::min(PIECE_BYTES, size - at) : 0;
            };
            const std::size_t in = left(bytes_read), out = left(bytes_written);
            const std::size_t both = std::min(in, out);
            std::memcpy(target.data() + (both > 0 ? at : 0), source.data() + (both > 0 ? at : 0), both);
            if (in > both) std::memcpy(scratch.data(), source.data() + at + both, in - both);
            if (out > both) std::memcpy(target.data() + at + both, scratch.data(), out - both);
        });
    });
}

}  // namespace tarn
