#include "replay_recorder.h"

#include <fmt/format.h>

#include <utility>

#include "../tarn_names.h"
#include "step_line.h"

namespace game {
namespace {

constexpr auto FLUSH_TIME = std::chrono::seconds(1);

}  // namespace

ReplayRecorder::ReplayRecorder(const std::filesystem::path& file, const Replay& head)
    : file_(file), stream_(file, std::ios::trunc | std::ios::binary) {
    stream_ << describe_head(head);
    flush();
}

void ReplayRecorder::check() const {
    if (!stream_) throw Error(fmt::format("{}: the replay cannot be written", file_.string()));
}

void ReplayRecorder::write_run() {
    if (run_ > 0) stream_ << describe_steps(std::exchange(run_, 0), input_);
}

void ReplayRecorder::add(const StepInput& input) {
    if (input != input_) write_run();
    input_ = input;
    ++run_;
    ++steps_;
}

void ReplayRecorder::flush() {
    write_run();
    stream_.flush();
    flushed_at_ = std::chrono::steady_clock::now();
    check();
}

void ReplayRecorder::flush_when_due() {
    if (std::chrono::steady_clock::now() - flushed_at_ >= FLUSH_TIME) flush();
}

void ReplayRecorder::end(std::uint64_t state_hash) {
    write_run();
    stream_ << describe_end(steps_, state_hash);
    stream_.close();
    check();
}

void save_replay(const std::filesystem::path& file, const Replay& replay) {
    ReplayRecorder recorder(file, replay);
    for (const StepInput& input : replay.steps) recorder.add(input);
    if (replay.is_complete) {
        recorder.end(replay.state_hash);
    } else {
        recorder.flush();
    }
}

}  // namespace game
