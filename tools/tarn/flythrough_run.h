// One flight along a camera path by several methods: frames, times, errors and flicker, kept as they come so
// that a flight that was stopped goes on.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "bench/method.h"
#include "bench/reference_cache.h"
#include "bench/sequence.h"
#include "bench/work_folder.h"
#include "scene/camera_path.h"
#include "session.h"

namespace tarn {

struct FlightPlan {
    std::vector<Method> methods;  // one at least
    int frames = 60;
    int pictures = 10;
    int measured = 3;
    int reference_spp = 64;
};

// What one method did in one frame. `errors` and `flicker` stand where the frame was measured.
struct FlightFrame {
    FrameTimings timings;
    std::uint64_t rays = 0;
    std::optional<PictureErrors> errors;
    double flicker = 0.0;  // mean |next frame of the same moment - this frame| over the reference's mean
};

struct Flight {
    std::vector<std::vector<FlightFrame>> methods;               // [method][frame]
    std::vector<int> pictured;                                   // frames with a picture a method
    std::vector<int> measured;                                   // frames with a reference
    std::vector<std::map<std::string, std::uint64_t>> counters;  // [method]
    std::optional<float> exposure_ev;                            // by which errors are measured
    std::optional<float> shown_ev;                               // of the pictures
    double reference_error = 0.0;  // the largest ReferenceResult::relative_error
    bool interrupted = false;
};

// Names of the pictures: "frame_0007.png" of the first method, "frame_0007_ris.png" of the others.
std::string flight_picture_name(const FlightPlan& plan, std::size_t method, int frame);
std::string flight_reference_name(int frame);

// Flies, writes pictures into `out`, keeps each frame in `work` and takes those that are there already. Ends
// early where the user interrupts. Each method has a renderer of its own; the session's only scouts. Throws
// Error where a file cannot be written.
Flight fly(const FlightPlan& plan, const CameraPath& path, const RenderOptions& options,
           RenderSession& session, std::vector<Renderer*> renderers, const std::filesystem::path& out,
           const WorkFolder& work);

}  // namespace tarn
