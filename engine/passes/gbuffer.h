// The G-buffer: which triangle each pixel sees, and the surface there.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "frame/history.h"
#include "frame/pool.h"
#include "gl/vertex_array.h"
#include "passes/frame_context.h"
#include "passes/gpu_scene.h"
#include "shared/interface/bindings.h"

namespace tarn {

// The surface that each pixel sees: LAYER_STRIDE texels RGBA32F a pixel, side by side, row 0 on top. Layout:
// shaders/passes/gbuffer/resolve.comp.
class SurfaceTable {
  public:
    // Error beyond the texels that a buffer texture of the driver can have.
    explicit SurfaceTable(const glm::ivec2& size_px, BufferUse use = BufferUse::DEVICE);

    const glm::ivec2& size_px() const { return size_px_; }
    const RowBuffer& texels() const { return texels_; }

    // One texel (LAYER_*) of every pixel, for tests and reports; waits for the device.
    std::vector<glm::vec4> download(int layer) const;
    // Replaces it, of a DYNAMIC table: one value for each pixel.
    void upload(int layer, std::span<const glm::vec4> values);

  private:
    glm::ivec2 size_px_;
    RowBuffer texels_;
};

using Surfaces = std::shared_ptr<SurfaceTable>;

struct GBuffer {
    Picture seen;  // RG32UI: instance, primitive; INVALID_INDEX: nothing
    Surfaces surfaces;
    std::optional<Previous<Surfaces>> previous;  // what the last frame saw, where it is the one before this
};

// Binds what lib/gbuffer.glsl reads.
PassRecorder& read_gbuffer(PassRecorder& pass, const GBuffer& gbuffer);

struct GBufferStatistics {
    std::uint32_t draws = 0;
    std::uint64_t triangles_drawn = 0;
    std::uint64_t triangles_total = 0;
};

class GBufferPass {
  public:
    explicit GBufferPass(const GpuScene& gpu_scene);
    ~GBufferPass();

    // Draws what `camera` sees of `world` and resolves it to surfaces. `previous`: the last frame's, handed
    // on.
    GBuffer record(const FrameContext& frame, const World& world, const CameraRecord& camera,
                   std::optional<Previous<Surfaces>> previous);

    // Memory for surfaces of a picture of this size.
    Surfaces take_surfaces(const glm::ivec2& size_px);

    const GBufferStatistics& statistics() const { return statistics_; }

  private:
    struct DrawCommand;
    struct Bucket;
    struct Target;

    Picture find_seen(const FrameContext& frame, const World& world, const CameraRecord& camera);
    void collect_draws(const FrameContext& frame, const World& world, const CameraRecord& camera);
    std::vector<DrawBatch> list_batches(bool coverage) const;
    Picture raster(const FrameContext& frame);
    Surfaces resolve(const FrameContext& frame, const Picture& seen);

    Pool<Target> targets_;
    Pool<SurfaceTable> surfaces_;
    VertexArray vertex_array_;
    std::unique_ptr<Buffer> draw_ids_;
    std::unique_ptr<Buffer> commands_;
    std::vector<Bucket> buckets_;
    GBufferStatistics statistics_;
};

}  // namespace tarn
