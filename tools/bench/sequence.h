// One sequence of frames of one method and seed: rendered, timed, averaged and held against the truth.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "frame/timings.h"
#include "metrics/image_error.h"
#include "reference/reference.h"
#include "settings/settings.h"

namespace tarn {

struct RenderedFrame {
    Image radiance;
    FrameTimings timings;
    std::uint64_t rays = 0;
};

struct FrameRequest {
    std::size_t method = 0;
    const RenderSettings& settings;
    std::uint32_t seed = 0;
    std::uint32_t frame = 0;  // its number
    bool starts = false;      // drops all history before it
    int lead = 0;             // frames until the first that counts: where on its way a moving camera is
    double resolution =
        1.0;  // rendered width and height, as a share of the picture's; the picture is enlarged
};

// What renders for the benchmark: the renderer, or a stand-in in tests.
class FrameSource {
  public:
    virtual ~FrameSource() = default;

    virtual RenderedFrame render(const FrameRequest& request) = 0;

    // What the method dropped, clamped or rejected since the source was made, by name.
    virtual std::map<std::string, std::uint64_t> read_counters(std::size_t method) = 0;
};

// What errors are measured against. Linear metrics see radiance * 2^exposure_ev.
struct Truth {
    Image radiance;              // NaN in the pixels that are left out
    Image display;               // the same, exposed and tone-mapped
    Image picture;               // radiance of all pixels, for the eye
    std::size_t left_out = 0;    // pixels
    Image variance;              // of the reference's own mean
    double mean_variance = 0.0;  // the same, averaged over channels and pixels
    double noise_rel_mse = 0.0;  // what it adds to the relMSE of a picture
    float exposure_ev = 0.0f;
    std::uint64_t spp = 0;
    double relative_error = 0.0;  // as ReferenceResult::relative_error
};

// Makes the truth of a reference. `left_out`: pixels that prove nothing, as the rasterizer and the rays
// round to different triangles there. Without `exposure_ev` exposed automatically.
Truth make_truth(const ReferenceResult& reference, std::span<const std::uint32_t> left_out = {},
                 std::optional<float> exposure_ev = {});

// The mean of the values that are finite; 0 where none is.
double mean_finite_value(const Image& image);

struct PictureErrors {
    ImageErrors linear;
    double flip_ldr = 0.0;
};

// Errors over the pixels that count; `non_finite` counts only those that the picture itself spoils.
PictureErrors measure_picture(const Truth& truth, const Image& radiance);

// Mean errors of the means of `frames` successive frames, over all such groups of the sequence.
struct CurvePoint {
    int frames = 1;
    double mse = 0.0;
    double rel_mse = 0.0;
    double rel_mse_trimmed = 0.0;
};

struct PassSamples {
    std::string name;
    std::vector<double> ms;  // one a frame
};

struct SequenceMeasure {
    std::vector<double> frame_ms;
    std::vector<PassSamples> passes;  // in the order in which they first ran
    std::uint64_t rays = 0;           // of all frames
    double flicker = 0.0;             // mean |frame - frame before| over the truth's mean
    double shared_samples = 0.0;      // share of pixels with the very sample of a neighbour, one frame later
    int repeated_frames = 0;          // equal to the frame before, bit for bit: a frame got lost
    PictureErrors first;              // of the first frame
    PictureErrors mean;               // of the mean of all frames
    std::map<std::string, std::uint64_t> counters;  // what was dropped, clamped or rejected meanwhile
    std::vector<CurvePoint> curve;                  // frames 1, 2, 4, ...; empty unless asked for
};

struct MeasuredSequence {
    SequenceMeasure measure;
    Image first;
    Image mean;
};

struct SequenceRequest {
    std::size_t method = 0;
    RenderSettings settings;
    double resolution = 1.0;
    std::uint32_t seed = 0;
    std::uint32_t first_frame = 0;
    int warm_up_frames = 0;  // rendered before, and forgotten
    int frames = 1;
    bool with_curve =
        false;  // errors of means of frames, a power of two of them, and which samples are shared
};

MeasuredSequence measure_sequence(FrameSource& source, const Truth& truth, const SequenceRequest& request);

}  // namespace tarn
