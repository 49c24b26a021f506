#include "core/log.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <set>

#include <fmt/format.h>

namespace tarn {
namespace {

std::atomic<bool> quiet = false;

std::string bar(double fraction, int width) {
    const int filled = int(fraction * width);
    return std::string(std::size_t(filled), '#') + std::string(std::size_t(width - filled), '.');
}

}  // namespace

void warn_once(const std::string& message) {
    static std::mutex mutex;
    static std::set<std::string> said;
    const std::lock_guard lock(mutex);
    if (!said.insert(message).second || quiet) return;
    std::fprintf(stderr, "tarn: warning: %s\n", message.c_str());
}

void set_quiet(bool value) {
    quiet = value;
}

Progress::Progress(std::string label, std::uint64_t total)
    : label_(std::move(label)),
      total_(std::max<std::uint64_t>(total, 1)),
      start_(Clock::now()),
      last_shown_(start_),
      terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (shown_ && terminal_) std::fprintf(stderr, "\r\033[K");
}

void Progress::update(std::uint64_t done) {
    const auto now = Clock::now();
    const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000);
    if (quiet || now - start_ < std::chrono::seconds(1) || now - last_shown_ < interval) return;
    last_shown_ = now;
    shown_ = true;
    const double fraction = double(std::min(done, total_)) / double(total_);
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const double remaining_s = fraction > 0 ? elapsed_s * (1 - fraction) / fraction : 0;
    if (terminal_) {
        const std::string line = fmt::format("\r\033[K{} [{}] {:3.0f} %  {:.0f} s left", label_,
                                             bar(fraction, 30), 100 * fraction, remaining_s);
        std::fputs(line.c_str(), stderr);
    } else {
        std::fputs(fmt::format("{}: {:.0f} %, {:.0f} s left\n", label_, 100 * fraction, remaining_s).c_str(),
                   stderr);
    }
    std::fflush(stderr);
}

}  // namespace tarn
