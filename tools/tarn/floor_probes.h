// What a frame cannot beat on this machine: bare Embree on its rays, a bare raster of its triangles, an empty
// pass, a copy of the bytes that a pass moves.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "rays/ray_tracer.h"

namespace tarn {

// The rays of one frame, in the order of their pixels: passes each on to `tracer` and keeps it.
class RayCapture : public RayTracer {
  public:
    explicit RayCapture(const RayTracer& tracer);
    ~RayCapture() override;

    void update(const World&) override {}
    std::uint64_t geometry_revision() const override { return tracer_.geometry_revision(); }
    std::optional<Hit> trace_closest(const RayRecord& ray, const CoverageKey& key,
                                     BackFaces back_faces) const override;

    // All rays since the last call.
    std::vector<RayRecord> take_rays();

  private:
    bool is_unoccluded(const RayRecord& ray, const CoverageKey& key, Moment moment) const override;

    struct Threads;
    const RayTracer& tracer_;
    std::unique_ptr<Threads> threads_;
};

// The same rays by Embree alone, on the same threads. ms() is the time of all of them.
class BareRays {
  public:
    BareRays(const World& world, const std::vector<RayRecord>& rays);
    ~BareRays();
    double time_ms();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// A ray through each pixel by Embree alone, in packets of 4 x 2 pixels: what is seen first, but for the backs
// of single-sided surfaces, which nobody leaves out.
class BareCameraRays {
  public:
    BareCameraRays(const World& world, const CameraRecord& camera, int width_px, int height_px);
    ~BareCameraRays();
    double time_ms();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// The triangles in the camera's view, in world space, by one draw call a winding, into depth alone.
class BareRaster {
  public:
    BareRaster(const World& world, const CameraRecord& camera, int width_px, int height_px);
    double time_ms();

  private:
    Program program_;
    Texture2D depth_;
    Framebuffer target_;
    VertexArray vertex_array_;
    std::unique_ptr<Buffer> vertices_;
    GLsizei one_sided_count_ = 0;
    GLsizei count_ = 0;
};

// A dispatch that does nothing, of one invocation a pixel.
class EmptyPass {
  public:
    EmptyPass(int width_px, int height_px);
    double time_ms();

  private:
    Program program_;
    int width_px_;
    int height_px_;
};

// Reads `bytes_read` and writes `bytes_written` on all threads.
double time_copy_ms(std::size_t bytes_read, std::size_t bytes_written);

}  // namespace tarn
