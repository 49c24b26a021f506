#include "passes/gbuffer.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "passes/culling.h"
#include "passes/trace_rays.h"
#include "shared/interface/bindings.h"

namespace tarn {
namespace {

Culling culling_of(const World& world, std::uint32_t instance) {
    if ((world.flags_of(instance) & MATERIAL_DOUBLE_SIDED) != 0u) return Culling::NONE;
    return world.instances[instance].mirrored ? Culling::BACK_MIRRORED : Culling::BACK;
}

// A buffer that grows by doubling.
template <class Row>
bool reserve(std::unique_ptr<Buffer>& buffer, const std::string& name, std::size_t count) {
    const std::size_t needed = std::max<std::size_t>(count, 1) * sizeof(Row);
    if (buffer && buffer->size_bytes() >= needed) return false;
    buffer = std::make_unique<Buffer>(name, 2 * needed, BufferUse::DYNAMIC);
    return true;
}

}  // namespace

// As glMultiDrawElementsIndirect reads it.
struct GBufferPass::DrawCommand {
    GLuint index_count;
    GLuint instance_count;
    GLuint first_index;
    GLint base_vertex;
    GLuint base_instance;  // index into the draw ids
};

struct GBufferPass::Bucket {
    Culling culling;
    bool coverage;
    std::vector<DrawCommand> commands;
};

struct GBufferPass::Target {
    explicit Target(const glm::ivec2& size_px)
        : seen("gbuffer/seen", size_px.x, size_px.y, GL_RG32UI),
          depth("gbuffer/depth", size_px.x, size_px.y, GL_DEPTH_COMPONENT32F),
          framebuffer("gbuffer/raster", {&seen}, &depth) {}

    Texture2D seen;
    Texture2D depth;
    Framebuffer framebuffer;
};

SurfaceTable::SurfaceTable(const glm::ivec2& size_px, BufferUse use)
    : size_px_(size_px),
      texels_("gbuffer/surface",
              std::size_t(size_px.x) * std::size_t(size_px.y) * LAYER_STRIDE * sizeof(glm::vec4), use,
              GL_RGBA32F) {}

std::vector<glm::vec4> SurfaceTable::download(int layer) const {
    const auto all = texels_.buffer().download<glm::vec4>();
    std::vector<glm::vec4> values;
    values.reserve(all.size() / LAYER_STRIDE);
    for (std::size_t i = std::size_t(layer); i < all.size(); i += LAYER_STRIDE) values.push_back(all[i]);
    return values;
}

void SurfaceTable::upload(int layer, std::span<const glm::vec4> values) {
    auto all = texels_.buffer().download<glm::vec4>();
    TARN_ASSERT(values.size() * LAYER_STRIDE == all.size(), "{} values for {} pixels", values.size(),
                all.size() / LAYER_STRIDE);
    for (std::size_t i = 0; i < values.size(); ++i) all[i * LAYER_STRIDE + std::size_t(layer)] = values[i];
    texels_.buffer().upload(0, all);
}

PassRecorder& read_gbuffer(PassRecorder& pass, const GBuffer& gbuffer) {
    return pass.read(UNIT_SURFACE, gbuffer.surfaces->texels());
}

GBufferPass::GBufferPass(const GpuScene& gpu_scene) : vertex_array_("gbuffer/vertices") {
    for (const Culling culling : {Culling::BACK, Culling::BACK_MIRRORED, Culling::NONE}) {
        buckets_.push_back({culling, false, {}});
        buckets_.push_back({culling, true, {}});
    }
    vertex_array_.add_float_attribute(0, 3, gpu_scene.vertex_buffer(), 0, VERTEX_ROWS * sizeof(glm::uvec4));
    vertex_array_.set_index_buffer(gpu_scene.triangle_buffer());
}

GBufferPass::~GBufferPass() = default;

void GBufferPass::collect_draws(const FrameContext& frame, const World& world, const CameraRecord& camera) {
    const glm::vec2 margin = glm::abs(frame.jitter_px) * 2.0f / glm::vec2(frame.size_px);
    const std::vector<TriangleRange> ranges = find_visible_ranges(world, camera, margin);
    std::vector<glm::uvec2> ids;
    for (Bucket& bucket : buckets_) bucket.commands.clear();
    for (const TriangleRange& range : ranges) {
        const WorldMesh& mesh = world.meshes[world.instances[range.instance].mesh];
        const Culling culling = culling_of(world, range.instance);
        const bool coverage = world.has_alpha_test(range.instance);
        const auto bucket = std::find_if(buckets_.begin(), buckets_.end(), [&](const Bucket& b) {
            return b.culling == culling && b.coverage == coverage;
        });
        bucket->commands.push_back({3 * range.triangle_count, 1,
                                    3 * (mesh.first_triangle + range.first_triangle),
                                    GLint(mesh.first_vertex), GLuint(ids.size())});
        ids.emplace_back(range.instance, range.first_triangle);
        statistics_.triangles_drawn += range.triangle_count;
    }
    statistics_.draws = std::uint32_t(ids.size());
    if (reserve<glm::uvec2>(draw_ids_, "gbuffer/draw_ids", ids.size())) {
        vertex_array_.add_uint_attribute(1, 2, *draw_ids_, 0, sizeof(glm::uvec2), 1);
    }
    if (!ids.empty()) draw_ids_->upload(0, ids);
    reserve<DrawCommand>(commands_, "gbuffer/draw_commands", ids.size());
    std::size_t offset_bytes = 0;
    for (const Bucket& bucket : buckets_) {
        if (bucket.commands.empty()) continue;
        commands_->upload(offset_bytes, bucket.commands);
        offset_bytes += bucket.commands.size() * sizeof(DrawCommand);
    }
}

std::vector<DrawBatch> GBufferPass::list_batches(bool coverage) const {
    std::vector<DrawBatch> batches;
    std::size_t offset_bytes = 0;
    for (const Bucket& bucket : buckets_) {
        if (bucket.coverage == coverage && !bucket.commands.empty()) {
            batches.push_back({bucket.culling, offset_bytes, int(bucket.commands.size())});
        }
        offset_bytes += bucket.commands.size() * sizeof(DrawCommand);
    }
    return batches;
}

Picture GBufferPass::raster(const FrameContext& frame) {
    const std::shared_ptr<Target> target = targets_.take(
        fmt::format("{} x {}", frame.size_px.x, frame.size_px.y), [&] { return Target(frame.size_px); });
    target->seen.clear(glm::uvec4(INVALID_INDEX));
    target->depth.clear(glm::vec4(0.0f));
    for (const bool coverage : {false, true}) {
        const std::vector<DrawBatch> batches = list_batches(coverage);
        if (coverage && batches.empty()) continue;
        frame.pass(coverage ? "gbuffer/raster_coverage" : "gbuffer/raster")
            .write_target(target->framebuffer, {&target->seen})
            .draw(frame.graphics(RasterVariant{coverage}), vertex_array_, *commands_, batches);
    }
    return Picture(target, &target->seen);
}

Picture GBufferPass::find_seen(const FrameContext& frame, const World& world, const CameraRecord& camera) {
    statistics_ = {};
    for (const WorldInstance& instance : world.instances)
        statistics_.triangles_total += world.meshes[instance.mesh].triangle_count;
    if (frame.plan.primary.by_rays) return trace_primary(frame, camera);
    collect_draws(frame, world, camera);
    return raster(frame);
}

GBuffer GBufferPass::record(const FrameContext& frame, const World& world, const CameraRecord& camera,
                            std::optional<Previous<Surfaces>> previous) {
    const Picture seen = find_seen(frame, world, camera);
    return {seen, resolve(frame, seen), std::move(previous)};
}

Surfaces GBufferPass::take_surfaces(const glm::ivec2& size_px) {
    return surfaces_.take(fmt::format("{} x {}", size_px.x, size_px.y),
                          [&] { return SurfaceTable(size_px); });
}

Surfaces GBufferPass::resolve(const FrameContext& frame, const Picture& seen) {
    const Surfaces surfaces = take_surfaces(frame.size_px);
    PassRecorder pass = frame.pass("gbuffer/resolve");
    pass.read(UNIT_PASS_A, seen).write_image(0, surfaces->texels());
    pass.dispatch(frame.compute(ResolveVariant{}), frame.size_px);
    return surfaces;
}

}  // namespace tarn
