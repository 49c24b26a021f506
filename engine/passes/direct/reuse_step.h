// One step of reuse, as temporal and spatial steps share it: rays that its MIS weights ask for, their
// answers, and the merge, band of rows by band of rows so that the rays of a band fit a storage block.
#pragma once

#include <functional>
#include <optional>

#include "passes/direct/direct_frame.h"
#include "passes/visibility.h"

namespace tarn {

class ReuseStep {
  public:
    ReuseStep(ProgramLibrary& programs, int width_px, int height_px);

    // Where a step reads and writes.
    struct Io {
        const RowBuffer& in;
        const RowBuffer& out;
        const Buffer* shadow_rays;  // set for the last step: the rays that test its samples, RAY_ROWS a pixel
        const Texture2D* light = nullptr;  // set for the last step where all its samples light the pixel
    };

    // Runs passes/PATH.comp for each band; `bind` sets uniforms and reads what only this step reads.
    void record(const DirectFrame& direct, const std::string& path, std::uint32_t rays_per_pixel,
                const Io& io, const std::function<void(PassRecorder&, const Program&)>& bind);

    // Rays of the last frame's steps, since the last call.
    RayBatchResult take_result();

  private:
    struct Band {
        int begin;
        int end;
        std::uint32_t rays_per_pixel;
    };
    using Bind = std::function<void(PassRecorder&, const Program&)>;

    void reserve_rays(std::size_t count);
    int rows_per_band(std::uint32_t rays_per_pixel) const;
    std::vector<std::string> defines_for(const DirectFrame& direct, bool last_step) const;
    void write_rays(const DirectFrame& direct, const std::string& path, const Band& band, const Io& io,
                    const Bind& bind);
    void merge(const DirectFrame& direct, const std::string& path, const Band& band, const Io& io,
               const Bind& bind);
    void set_band(const DirectFrame& direct, const Program& program, const Band& band) const;

    ProgramLibrary& programs_;
    int width_px_;
    int height_px_;
    std::size_t ray_capacity_ = 0;
    std::optional<Buffer> rays_;
    std::optional<VisibilityPass> visibility_;
    RayBatchResult result_;
};

}  // namespace tarn
