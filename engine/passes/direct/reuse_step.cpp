#include "passes/direct/reuse_step.h"

#include <algorithm>

#include "core/error.h"
#include "gl/handle.h"
#include "shared/interface/bindings.h"
#include "shared/interface/records.h"

namespace tarn {
namespace {

constexpr std::size_t RAY_BYTES = RAY_ROWS * sizeof(glm::uvec4);
constexpr int GROUP_PX = 8;

}  // namespace

ReuseStep::ReuseStep(ProgramLibrary& programs, int width_px, int height_px)
    : programs_(programs), width_px_(width_px), height_px_(height_px) {}

void ReuseStep::reserve_rays(std::size_t count) {
    if (count <= ray_capacity_) return;
    visibility_.reset();
    rays_.emplace("direct/reuse_rays", count * RAY_BYTES, BufferUse::SHARED);
    visibility_.emplace(count);
    ray_capacity_ = count;
}

// A multiple of the group's height, so that no two bands share a group.
int ReuseStep::rows_per_band(std::uint32_t rays_per_pixel) const {
    if (rays_per_pixel == 0) return height_px_;
    const std::size_t limit = std::size_t(get_gl_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE)) / RAY_BYTES;
    const std::size_t rows = limit / (std::size_t(width_px_) * rays_per_pixel) / GROUP_PX * GROUP_PX;
    if (rows == 0) {
        throw Error(
            "reuse asks for {} rays for each of {} pixels in a row, the driver's storage blocks hold {}",
            rays_per_pixel, width_px_, limit);
    }
    return int(std::min(rows, std::size_t(height_px_)));
}

std::vector<std::string> ReuseStep::defines_for(const DirectFrame& direct, bool last_step) const {
    const DirectSettings& settings = direct.settings;
    std::vector<std::string> defines = direct.defines;
    defines.push_back(fmt::format("TARN_MIS={}", int(settings.mis)));
    defines.push_back(fmt::format("TARN_MIS_VISIBILITY={}", settings.mis_visibility ? 1 : 0));
    defines.push_back(fmt::format("TARN_SAMPLE_VISIBILITY={}", int(settings.visibility)));
    if (last_step) defines.emplace_back("TARN_LAST_STEP");
    return defines;
}

void ReuseStep::set_band(const DirectFrame& direct, const Program& program, const Band& band) const {
    program.set("band_begin", band.begin);
    program.set("band_end", band.end);
    program.set("rays_per_pixel", band.rays_per_pixel);
    program.set("target_weights", direct.target_weights);
}

void ReuseStep::write_rays(const DirectFrame& direct, const std::string& path, const Band& band, const Io& io,
                           const Bind& bind) {
    std::vector<std::string> defines = defines_for(direct, false);
    defines.emplace_back("TARN_WRITE_RAYS");
    const Program& program = programs_.compute(path, defines);
    set_band(direct, program, band);
    PassRecorder pass = direct.frame.pass(path + "_rays");
    bind(pass, program);
    read_gbuffer(pass, direct.gbuffer)
        .read(UNIT_PASS_A, io.in)
        .write(1, *rays_)
        .count(BLOCK_COUNTERS, direct.counters)
        .dispatch(program, width_px_, band.end - band.begin);
}

void ReuseStep::merge(const DirectFrame& direct, const std::string& path, const Band& band, const Io& io,
                      const Bind& bind) {
    std::vector<std::string> defines = defines_for(direct, io.shadow_rays != nullptr);
    if (io.light != nullptr) defines.emplace_back("TARN_SHADE_ALL");
    const Program& program = programs_.compute(path, defines);
    set_band(direct, program, band);
    PassRecorder pass = direct.frame.pass(path);
    bind(pass, program);
    read_gbuffer(pass, direct.gbuffer).read(UNIT_PASS_A, io.in).write(0, io.out);
    if (band.rays_per_pixel > 0) pass.read(UNIT_PASS_B, visibility_->answers());
    if (io.shadow_rays != nullptr) pass.write(2, *io.shadow_rays);
    if (io.light != nullptr) pass.write_image(0, *io.light);
    pass.count(BLOCK_COUNTERS, direct.counters).dispatch(program, width_px_, band.end - band.begin);
}

void ReuseStep::record(const DirectFrame& direct, const std::string& path, std::uint32_t rays_per_pixel,
                       const Io& io, const Bind& bind) {
    const int rows = rows_per_band(rays_per_pixel);
    reserve_rays(std::size_t(rows) * std::size_t(width_px_) * rays_per_pixel);
    for (int begin = 0; begin < height_px_; begin += rows) {
        const Band band{begin, std::min(begin + rows, height_px_), rays_per_pixel};
        if (rays_per_pixel > 0) {
            write_rays(direct, path, band, io, bind);
            const std::size_t count = std::size_t(band.end - begin) * std::size_t(width_px_) * rays_per_pixel;
            visibility_->record(direct.frame, path + "_visibility", direct.tracer, *rays_, count,
                                direct.shadow_key, direct.last_frame.value_or(PreviousRays{}));
            result_.traced += visibility_->result().traced;
            result_.rejected += visibility_->result().rejected;
        }
        merge(direct, path, band, io, bind);
    }
}

RayBatchResult ReuseStep::take_result() {
    const RayBatchResult result = result_;
    result_ = {};
    return result;
}

}  // namespace tarn
