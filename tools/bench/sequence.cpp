#include "bench/sequence.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/display.h"
#include "core/error.h"
#include "core/statistics.h"
#include "metrics/flip.h"
#include "metrics/frame_mean.h"
#include "metrics/shared_samples.h"

namespace tarn {
namespace {

double linear_scale(const Truth& truth) {
    return std::exp2(double(truth.exposure_ev));
}

// The errors of the means of 1, 2, 4, ... frames. Means wait until their twin comes, as the bits of a
// counter.
class CurveMeter {
  public:
    explicit CurveMeter(const Truth& truth) : truth_(truth) {}

    void add(FrameMean mean) {
        for (std::size_t level = 0;; ++level) {
            if (level == waiting_.size()) {
                waiting_.emplace_back();
                points_.push_back({mean.frames(), 0.0, 0.0, 0.0});
                counts_.push_back(0);
            }
            measure(level, mean.mean());
            if (waiting_[level].frames() == 0) {
                waiting_[level] = std::move(mean);
                return;
            }
            mean.merge(waiting_[level]);
            waiting_[level] = {};
        }
    }

    std::vector<CurvePoint> points() const {
        std::vector<CurvePoint> means = points_;
        for (std::size_t i = 0; i < means.size(); ++i) {
            means[i].mse /= counts_[i];
            means[i].rel_mse /= counts_[i];
            means[i].rel_mse_trimmed /= counts_[i];
        }
        return means;
    }

  private:
    void measure(std::size_t level, const Image& picture) {
        const ImageErrors errors = compute_image_errors(truth_.radiance, picture, linear_scale(truth_));
        points_[level].mse += errors.mse;
        points_[level].rel_mse += errors.rel_mse;
        points_[level].rel_mse_trimmed += errors.rel_mse_trimmed;
        ++counts_[level];
    }

    const Truth& truth_;
    std::vector<FrameMean> waiting_;
    std::vector<CurvePoint> points_;
    std::vector<int> counts_;
};

void add_timings(SequenceMeasure& measure, const FrameTimings& timings) {
    measure.frame_ms.push_back(timings.frame_ms);
    for (const PassTiming& pass : timings.passes) {
        const auto found = std::find_if(measure.passes.begin(), measure.passes.end(),
                                        [&](const PassSamples& p) { return p.name == pass.name; });
        if (found == measure.passes.end()) {
            measure.passes.push_back({pass.name, {pass.ms}});
        } else {
            found->ms.push_back(pass.ms);
        }
    }
}

double mean_absolute_change(const Image& before, const Image& after) {
    double sum = 0.0;
    for (std::size_t i = 0; i < before.values.size(); ++i) {
        const double change = std::abs(double(after.values[i]) - double(before.values[i]));
        if (std::isfinite(change)) sum += change;
    }
    return sum / double(std::max<std::size_t>(1, before.values.size()));
}

void warm_up(FrameSource& source, const SequenceRequest& request) {
    for (int i = 0; i < request.warm_up_frames; ++i) {
        source.render({request.method, request.settings, request.seed, request.first_frame + std::uint32_t(i),
                       i == 0, request.warm_up_frames - i, request.resolution});
    }
}

// Which samples the frame after the sequence chose, as a picture, and how many of them neighbours share.
double measure_sharing(FrameSource& source, const SequenceRequest& request) {
    RenderSettings settings = request.settings;
    settings.direct.debug_view = DebugView::SAMPLES;
    const auto number = request.first_frame + std::uint32_t(request.warm_up_frames + request.frames);
    return find_shared_sample_share(
        source.render({request.method, settings, request.seed, number, false, 0, request.resolution})
            .radiance);
}

// What the counters gained since `before`.
std::map<std::string, std::uint64_t> count_since(const std::map<std::string, std::uint64_t>& before,
                                                 std::map<std::string, std::uint64_t> now) {
    for (auto& [name, value] : now) {
        const auto old = before.find(name);
        if (old != before.end()) value -= old->second;
    }
    return now;
}

// Mean of variance / (a^2 + 0.01), as relMSE weighs an error.
double relative_noise(const Truth& truth) {
    const double scale = linear_scale(truth);
    RunningMoments noise;
    for (std::size_t i = 0; i < truth.variance.values.size(); ++i) {
        const double value = scale * truth.radiance.values[i];
        const double share = scale * scale * truth.variance.values[i] / (value * value + REL_MSE_EPSILON);
        if (std::isfinite(share)) noise.add(share);
    }
    return noise.mean();
}

}  // namespace

double mean_finite_value(const Image& image) {
    RunningMoments moments;
    for (const float value : image.values) {
        if (std::isfinite(value)) moments.add(value);
    }
    return moments.mean();
}

Truth make_truth(const ReferenceResult& reference, std::span<const std::uint32_t> left_out,
                 std::optional<float> exposure_ev) {
    Truth truth;
    truth.picture = reference.radiance;
    truth.radiance = reference.radiance;
    truth.exposure_ev = exposure_ev ? *exposure_ev : measuring_exposure_ev(reference.radiance);
    truth.display = display_from_radiance(reference.radiance, truth.exposure_ev);
    truth.left_out = left_out.size();
    truth.spp = reference.spp;
    truth.relative_error = reference.relative_error;
    truth.variance = reference.variance;
    for (Image* image : {&truth.radiance, &truth.display, &truth.variance}) {
        for (const std::uint32_t pixel : left_out) {
            for (std::size_t c = 0; c < 3; ++c) image->values[3 * std::size_t(pixel) + c] = std::nanf("");
        }
    }
    truth.mean_variance = mean_finite_value(truth.variance);
    truth.noise_rel_mse = relative_noise(truth);
    return truth;
}

PictureErrors measure_picture(const Truth& truth, const Image& radiance) {
    const Image display = display_from_radiance(radiance, truth.exposure_ev);
    PictureErrors errors{compute_image_errors(truth.radiance, radiance, linear_scale(truth)),
                         mean_error(compute_ldr_flip(truth.display, display))};
    errors.linear.non_finite -= std::min(errors.linear.non_finite, truth.left_out);
    return errors;
}

MeasuredSequence measure_sequence(FrameSource& source, const Truth& truth, const SequenceRequest& request) {
    TARN_ASSERT(!request.with_curve || std::has_single_bit(unsigned(request.frames)),
                "a curve of {} frames: not a power of two", request.frames);
    MeasuredSequence result;
    SequenceMeasure& measure = result.measure;
    CurveMeter curve(truth);
    FrameMean total;
    Image before;
    double changes = 0.0;
    const auto counters_before = source.read_counters(request.method);
    warm_up(source, request);
    for (int i = 0; i < request.frames; ++i) {
        const std::uint32_t number = request.first_frame + std::uint32_t(request.warm_up_frames + i);
        const bool starts = i == 0 && request.warm_up_frames == 0;
        RenderedFrame frame = source.render(
            {request.method, request.settings, request.seed, number, starts, 0, request.resolution});
        add_timings(measure, frame.timings);
        measure.rays += frame.rays;
        FrameMean picture;
        picture.add(frame.radiance);
        total.merge(picture);
        if (request.with_curve) curve.add(std::move(picture));
        if (i > 0) {
            changes += mean_absolute_change(before, frame.radiance);
            measure.repeated_frames += before.values == frame.radiance.values;
        } else {
            result.first = frame.radiance;
        }
        before = std::move(frame.radiance);
    }
    const double truth_mean = mean_finite_value(truth.radiance);
    if (request.frames > 1 && truth_mean > 0.0) measure.flicker = changes / (request.frames - 1) / truth_mean;
    measure.counters = count_since(counters_before, source.read_counters(request.method));
    result.mean = total.mean();
    measure.first = measure_picture(truth, result.first);
    measure.mean = request.frames > 1 ? measure_picture(truth, result.mean) : measure.first;
    if (request.with_curve) {
        measure.curve = curve.points();
        measure.shared_samples = measure_sharing(source, request);
    }
    return result;
}

}  // namespace tarn
