// A source of frames whose noise, bias and time are known: the benchmark's stand-in for the renderer.
#pragma once

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "bench/sequence.h"

namespace tarn::test {

// What goes wrong with one method.
struct ToyFault {
    double brightness = 1.0;        // factor on all radiance
    double bias = 0.0;              // added to all radiance
    double shading_slowdown = 1.0;  // factor on the pass "toy/shade"
    std::set<std::uint32_t>
        dropped;  // frame numbers within a cell at which the picture before is shown again
};

// Radiance of a pixel: the truth plus normal noise of `deviation`; shading takes 2 ms + 0.05 ms a candidate,
// three passes before it 1 ms each, all with 2 % of jitter, and all times the machine's slowness and the
// share of pixels.
class ToySource : public FrameSource {
  public:
    static constexpr int WIDTH_PX = 24;
    static constexpr int HEIGHT_PX = 16;

    explicit ToySource(std::vector<ToyFault> faults, double deviation = 0.5, double slowness = 1.0,
                       unsigned time_seed = 1)
        : faults_(std::move(faults)), deviation_(deviation), slowness_(slowness), clock_(time_seed) {}

    static ReferenceResult make_reference() {
        ReferenceResult reference;
        reference.radiance = Image(WIDTH_PX, HEIGHT_PX, 3);
        reference.variance = Image(WIDTH_PX, HEIGHT_PX, 3);
        for (std::size_t i = 0; i < reference.radiance.values.size(); ++i) {
            reference.radiance.values[i] = 0.5f + float(i % 7) / 7.0f;
        }
        reference.spp = 1;
        return reference;
    }
    static Truth make_toy_truth() { return make_truth(make_reference(), {}, 0.0f); }

    RenderedFrame render(const FrameRequest& request) override {
        ++rendered_;
        const auto& [method, settings, seed, frame, starts, lead, resolution] = request;
        const ToyFault& fault = faults_[method];
        RenderedFrame result;
        result.radiance =
            fault.dropped.contains(frame % (1u << 20)) ? before_ : make_picture(fault, seed, frame);
        before_ = result.radiance;
        const double pixels = resolution * resolution;
        const auto take_ms = [&](double ms) { return slowness_ * jitter() * ms * pixels; };
        result.timings.passes = {
            {"toy/raster", take_ms(1.0)},
            {"toy/resolve", take_ms(1.0)},
            {"toy/trace", take_ms(1.0)},
            {"toy/shade", take_ms(fault.shading_slowdown * (2.0 + 0.05 * settings.direct.candidates))}};
        for (const PassTiming& pass : result.timings.passes) result.timings.frame_ms += pass.ms;
        result.rays = result.radiance.pixel_count();
        return result;
    }

    std::map<std::string, std::uint64_t> read_counters(std::size_t) override { return {{"bad_radiance", 0}}; }

    int rendered() const { return rendered_; }

  private:
    Image make_picture(const ToyFault& fault, std::uint32_t seed, std::uint32_t frame) {
        // The same for every method, as methods share the renderer's random numbers.
        std::mt19937 rng(seed * 7919u + frame);
        std::normal_distribution<double> noise(0.0, deviation_);
        Image picture = make_reference().radiance;
        for (float& value : picture.values) {
            value = float(fault.brightness * (value + noise(rng)) + fault.bias);
        }
        return picture;
    }

    double jitter() { return std::normal_distribution<double>(1.0, 0.02)(clock_); }

    std::vector<ToyFault> faults_;
    double deviation_;
    double slowness_;
    std::mt19937 clock_;
    Image before_;
    int rendered_ = 0;
};

}  // namespace tarn::test
