// The G-buffer: which triangle each pixel sees, and the surface there.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frame/frame_recorder.h"
#include "frame/history.h"
#include "gl/program_library.h"
#include "gl/vertex_array.h"
#include "passes/gpu_scene.h"
#include "shared/interface/bindings.h"

namespace tarn {

// The surface that each pixel sees, RGBA32F. Layout: shaders/passes/gbuffer/resolve.comp.
struct SurfaceImages {
    SurfaceImages(int width_px, int height_px);

    TextureArray stack;             // all layers, read through one texture unit
    std::vector<Texture2D> layers;  // each alone (LAYER_*)
};

struct GBuffer {
    const Texture2D& seen;  // RG32UI: instance, primitive; INVALID_INDEX: nothing
    const SurfaceImages& images;
    Past<SurfaceImages> previous;

    const TextureArray& surface() const { return images.stack; }
    const Texture2D& position() const { return images.layers[LAYER_POSITION]; }
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
    GBufferPass(ProgramLibrary& programs, const GpuScene& gpu_scene, int width_px, int height_px);
    ~GBufferPass();

    // Draws what `camera` sees of `world` and resolves it to surfaces. `scene_defines`: what the scene has
    // (plan/frame_plan.h).
    GBuffer record(FrameRecorder& frame, const World& world, const CameraRecord& camera,
                   const std::vector<std::string>& scene_defines);

    // Ends the frame: the surfaces that it saw become the previous ones.
    void advance() { surfaces_.advance(); }

    const GBufferStatistics& statistics() const { return statistics_; }

  private:
    struct Bucket;

    void collect_draws(const World& world, const CameraRecord& camera);
    void issue_draws(bool coverage) const;
    void resolve(FrameRecorder& frame, const std::vector<std::string>& scene_defines);

    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
    Texture2D seen_;
    Texture2D depth_;
    History<SurfaceImages> surfaces_;
    Framebuffer target_;
    VertexArray vertex_array_;
    std::unique_ptr<Buffer> draw_ids_;
    std::unique_ptr<Buffer> commands_;
    std::vector<Bucket> buckets_;
    GBufferStatistics statistics_;
};

}  // namespace tarn
