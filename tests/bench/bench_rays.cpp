// Rays a second of the renderer's visibility pass against a bare Embree loop over the same rays on the same
// threads.
//
// The renderer draws lantern_court; of each frame the visibility pass counts, as the frame itself times it:
// rays that a shader wrote, read and answered in memory that GL shares. After each frame the bare loop
// answers the same rays, which lie ready in Embree's own layout. So both meet a machine that has just done
// something else, and a busy neighbour slows both alike. Exit status 1 where the median ratio is below what
// is required of the engine.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "bench/bare_embree.h"
#include "core/log.h"
#include "platform/context.h"
#include "renderer/renderer.h"
#include "support/test_scenes.h"

namespace tarn {
namespace {

constexpr int WIDTH_PX = 640;
constexpr int HEIGHT_PX = 360;
constexpr int WARM_UP_FRAMES = 5;
constexpr int FRAMES = 41;
constexpr double REQUIRED_SHARE = 0.9;

// Keeps the rays that the renderer has traced, by pixel; says that nothing is in their way.
class RayCollector : public RayTracer {
  public:
    void update(const World&) override {}
    std::uint64_t geometry_revision() const override { return 0; }
    std::optional<Hit> trace_closest(const RayRecord&, const CoverageKey&, BackFaces) const override {
        return std::nullopt;
    }

    std::vector<RTCRay> bare_rays() const {
        std::vector<RTCRay> rays;
        for (const RayRecord& ray : rays_) {
            if (ray.max_t >= 0.0f) rays.push_back(BareEmbree::make_ray(ray));
        }
        return rays;
    }

  private:
    bool is_unoccluded(const RayRecord& ray, const CoverageKey&, Moment) const override {
        rays_[ray.pixel] = ray;
        return true;
    }

    mutable std::vector<RayRecord> rays_ = std::vector<RayRecord>(WIDTH_PX * HEIGHT_PX, inactive_ray());
};

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

class Bench {
  public:
    Bench()
        : loaded_(test::load_test_scene(test::content_file("lantern_court"))),
          bare_(loaded_->world, {0, 0, RAY_SHADOW}),
          renderer_(loaded_->world, *loaded_->tracer, WIDTH_PX, HEIGHT_PX) {
        input_.camera = test::first_camera(*loaded_, double(WIDTH_PX) / HEIGHT_PX);
        input_.settings.direct.mode = DirectMode::RIS;
        const RayCollector collector;
        Renderer(loaded_->world, collector, WIDTH_PX, HEIGHT_PX).render(input_);
        rays_ = collector.bare_rays();
        check_agreement();
    }

    // Whether the pass is fast enough on `threads` threads; prints what it measured.
    bool measure(int threads) {
        const WorkerLimit limit(threads);
        std::vector<double> pass_s, bare_s, shares;
        for (int frame = 0; frame < WARM_UP_FRAMES + FRAMES; ++frame) {
            const double pass = time_pass_s(), bare = time_bare_s();
            if (frame < WARM_UP_FRAMES) continue;
            pass_s.push_back(pass);
            bare_s.push_back(bare);
            shares.push_back(bare / pass);
        }
        const double count = 1e-6 * double(rays_.size()), share = median(shares);
        fmt::print(
            "{} thread{}: visibility pass {:6.2f} Mrays/s, bare Embree {:6.2f} Mrays/s, share {:.3f}\n",
            threads, threads == 1 ? " " : "s", count / median(pass_s), count / median(bare_s), share);
        std::fflush(stdout);
        return share >= REQUIRED_SHARE;
    }

    std::size_t ray_count() const { return rays_.size(); }

  private:
    // Speeds compare only where the answers do.
    void check_agreement() {
        time_bare_s();
        std::size_t different = 0;
        for (std::size_t i = 0; i < rays_.size(); ++i) {
            const RTCRay& r = rays_[i];
            const RayRecord ray{{r.org_x, r.org_y, r.org_z}, r.tfar, {r.dir_x, r.dir_y, r.dir_z}, r.id};
            const bool bare_visible = bare_rays_[i].tfar >= 0.0f;
            different += loaded_->tracer->is_visible(ray, {0, 0, RAY_SHADOW}) != bare_visible;
        }
        if (different > 0) throw Error("{} of {} answers differ from bare Embree's", different, rays_.size());
    }

    double time_pass_s() {
        const FrameOutput output = renderer_.render(input_);
        if (output.shadow_rays.traced != rays_.size()) {
            throw Error("the renderer traced {} rays, the bare loop has {}", output.shadow_rays.traced,
                        rays_.size());
        }
        for (const PassTiming& pass : output.timings.passes) {
            if (pass.name == "visibility") return 1e-3 * pass.ms;
        }
        throw Error("the frame has no pass 'visibility'");
    }

    // Embree overwrites its rays, so they are made anew before each run, outside the clock.
    double time_bare_s() {
        bare_rays_ = rays_;
        const auto start = std::chrono::steady_clock::now();
        bare_.trace(bare_rays_);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::unique_ptr<test::TestScene> loaded_;
    BareEmbree bare_;
    Renderer renderer_;
    FrameInput input_;
    std::vector<RTCRay> rays_, bare_rays_;
};

int run() {
    set_quiet(true);
    const auto context = create_context({});
    Bench bench;
    fmt::print(
        "lantern_court at {} x {}: {} shadow rays a frame, medians of {} frames; at least {} of bare "
        "Embree is required\n",
        WIDTH_PX, HEIGHT_PX, bench.ray_count(), FRAMES, REQUIRED_SHARE);
    bool passes = true;
    for (const int threads : {1, 2}) passes = bench.measure(threads) && passes;
    return passes ? 0 : 1;
}

}  // namespace
}  // namespace tarn

int main() {
    try {
        return tarn::run();
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_rays: {}\n", error.what());
        return 1;
    }
}
