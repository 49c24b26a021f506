// What the studies have in common. A study answers one question about the methods with a table, and keeps
// what it measured as JSON.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "metrics/frame_mean.h"
#include "metrics/seed_statistics.h"
#include "session.h"

namespace tarn {

// Each adds its subcommand to `tarn study`.
void add_visibility_study(CLI::App& study);
void add_option_study(CLI::App& study);
void add_light_count_study(CLI::App& study);
void add_fault_study(CLI::App& study);
void add_lag_study(CLI::App& study);
void add_cache_study(CLI::App& study);
void add_noise_study(CLI::App& study);
void add_crawl_study(CLI::App& study);

// A new folder that goes with the object. Throws Error where none can be made.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

// "1.23 (1.20 .. 1.26)"
std::string format_estimate(const Estimate& estimate, int decimals);
nlohmann::ordered_json describe_estimate(const Estimate& estimate);

// The sequence of frames that a study looks at, of one seed: `warm_up` frames that fill the history, then
// `frames` more.
struct StudySequence {
    RenderSettings settings;
    CameraRecord camera;
    std::uint32_t seed = 0;
    int warm_up = 0;
    int frames = 0;
};

// Called with each frame after the warm-up; may change the settings of the next one (debug views).
using FrameVisitor = std::function<void(int frame, const FrameOutput& output, RenderSettings& settings)>;

// Throws Error on Ctrl-C.
void render_sequence(Renderer& renderer, const StudySequence& sequence, const FrameVisitor& visit);

// The mean of all values of all images but number `left_out`.
double mean_value(const std::vector<Image>& images, std::size_t left_out);

// Variance over seeds, averaged over values, without image number `left_out`.
double mean_variance(const std::vector<Image>& images, std::size_t left_out);

}  // namespace tarn
