// Writes a replay while it is played, so that a program that is killed loses no more than its last moment.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>

#include "replay_file.h"

namespace game {

// Its functions throw Error that names the file where it cannot be written.
class ReplayRecorder {
  public:
    // Starts the file; of `head` all but steps and state. What was there before is gone.
    ReplayRecorder(const std::filesystem::path& file, const Replay& head);

    void add(const StepInput& input);
    // Hands what was added to the operating system; play need not wait for a disk.
    void flush();
    // The same once a second has passed since the last time: call it often.
    void flush_when_due();
    // The last line. Nothing may be added after it.
    void end(std::uint64_t state_hash);

    const std::filesystem::path& file() const { return file_; }

  private:
    void write_run();
    void check() const;

    std::filesystem::path file_;
    std::ofstream stream_;
    StepInput input_;        // of the steps that are not written yet
    std::size_t run_ = 0;    // how many those are
    std::size_t steps_ = 0;  // all
    std::chrono::steady_clock::time_point flushed_at_;
};

// A whole file at once.
void save_replay(const std::filesystem::path& file, const Replay& replay);

}  // namespace game
