#include "studies/study.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "commands.h"
#include "core/error.h"
#include "interrupt.h"

namespace tarn {

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tarn-study-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw Error("{}: cannot be made: {}", name, std::strerror(errno));
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string format_estimate(const Estimate& estimate, int decimals) {
    return fmt::format("{:.{}f} ({:.{}f} .. {:.{}f})", estimate.mean, decimals, estimate.low, decimals,
                       estimate.high, decimals);
}

nlohmann::ordered_json describe_estimate(const Estimate& estimate) {
    return {{"mean", estimate.mean}, {"low", estimate.low}, {"high", estimate.high}};
}

void render_sequence(Renderer& renderer, const StudySequence& sequence, const FrameVisitor& visit) {
    FrameInput input;
    input.camera = sequence.camera;
    input.seed = sequence.seed;
    input.settings = sequence.settings;
    renderer.reset_history();
    for (int i = 0; i < sequence.warm_up + sequence.frames; ++i) {
        if (interrupt_flag()) throw Error("interrupted; nothing is kept of a study that did not end");
        input.frame = std::uint32_t(i);
        const FrameOutput output = renderer.render(input);
        if (i < sequence.warm_up) continue;
        visit(i - sequence.warm_up, output, input.settings);
    }
}

double mean_value(const std::vector<Image>& images, std::size_t left_out) {
    RunningMoments moments;
    for (std::size_t k = 0; k < images.size(); ++k) {
        if (k == left_out) continue;
        for (const float value : images[k].values) moments.add(value);
    }
    return moments.mean();
}

double mean_variance(const std::vector<Image>& images, std::size_t left_out) {
    RunningMoments variances;
    for (std::size_t i = 0; i < images.front().values.size(); ++i) {
        RunningMoments seeds;
        for (std::size_t k = 0; k < images.size(); ++k) {
            if (k != left_out) seeds.add(images[k].values[i]);
        }
        variances.add(seeds.variance());
    }
    return variances.mean();
}

void add_study_command(CLI::App& app) {
    CLI::App* study = app.add_subcommand("study", "Answer one question about the methods, with a table");
    study->require_subcommand(1);
    add_visibility_study(*study);
    add_option_study(*study);
    add_light_count_study(*study);
    add_fault_study(*study);
    add_lag_study(*study);
    add_cache_study(*study);
    add_noise_study(*study);
    add_crawl_study(*study);
}

}  // namespace tarn
