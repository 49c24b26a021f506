// What each pass of a frame cost.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace tarn {

struct PassTiming {
    std::string name;  // "direct/candidates": also the debug group, the shader's path and the key in JSON
    double ms = 0.0;
    std::size_t bytes_read = 0;  // of what the pass said it reads and writes, whole tables and images
    std::size_t bytes_written = 0;
    bool is_on_cpu = false;  // the worker threads' own work
};

struct FrameTimings {
    double frame_ms = 0.0;  // wall clock, from the first command to the last answer
    std::vector<PassTiming> passes;
};

// Frame timings of a run, and their medians.
class TimingLog {
  public:
    void add(const FrameTimings& timings);
    std::size_t frame_count() const { return frame_ms_.size(); }

    // Quantile of the frame times, ms, 0 <= q <= 1; 0 without frames.
    double frame_quantile_ms(double q) const;

    // Each pass with the median of its times, in the order in which the passes first ran.
    std::vector<PassTiming> pass_medians() const;

  private:
    std::vector<double> frame_ms_;
    std::vector<PassTiming> passes_;  // each as it first ran, in that order
    std::map<std::string, std::vector<double>> pass_ms_;
};

}  // namespace tarn
