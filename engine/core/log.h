// What the program says to a person: warnings (each said once) and progress of long work, on stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace tarn {

// Writes "tarn: warning: MESSAGE" to stderr, the first time this very message is given.
void warn_once(const std::string& message);

// Silences or restores warnings and progress (tests, --quiet).
void set_quiet(bool quiet);

// Progress of long work: a bar that redraws itself on a terminal, a line every few seconds elsewhere.
// Nothing is shown for work that ends within a second. Not thread-safe: call from one thread.
class Progress {
  public:
    Progress(std::string label, std::uint64_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // `done` of `total` is finished.
    void update(std::uint64_t done);

  private:
    using Clock = std::chrono::steady_clock;
    std::string label_;
    std::uint64_t total_;
    Clock::time_point start_;
    Clock::time_point last_shown_;
    bool terminal_;
    bool shown_ = false;
};

}  // namespace tarn
