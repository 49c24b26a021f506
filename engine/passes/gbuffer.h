// The G-buffer: which triangle each pixel sees, and the surface there.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frame/frame_recorder.h"
#include "gl/program_library.h"
#include "gl/vertex_array.h"
#include "passes/gpu_scene.h"

namespace tarn {

// Layout of the surface images: shaders/passes/gbuffer/resolve.comp.
struct GBuffer {
    const Texture2D& seen;  // RG32UI: instance, primitive; INVALID_INDEX: nothing
    const Texture2D& position;
    const Texture2D& normals;
    const Texture2D& diffuse;
    const Texture2D& specular;
    const Texture2D& emission;
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

    const GBufferStatistics& statistics() const { return statistics_; }

  private:
    struct Bucket;

    void collect_draws(const World& world, const CameraRecord& camera);
    void issue_draws(bool coverage) const;

    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
    Texture2D seen_;
    Texture2D depth_;
    Texture2D position_;
    Texture2D normals_;
    Texture2D diffuse_;
    Texture2D specular_;
    Texture2D emission_;
    Framebuffer target_;
    VertexArray vertex_array_;
    std::unique_ptr<Buffer> draw_ids_;
    std::unique_ptr<Buffer> commands_;
    std::vector<Bucket> buckets_;
    GBufferStatistics statistics_;
};

}  // namespace tarn
