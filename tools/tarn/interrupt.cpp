#include "interrupt.h"

#include <csignal>

namespace tarn {
namespace {

std::atomic<bool> interrupted = false;

void on_signal(int signal) {
    interrupted = true;
    std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& interrupt_flag() {
    static const bool listening = [] {
        std::signal(SIGINT, on_signal);
        std::signal(SIGTERM, on_signal);
        return true;
    }();
    (void)listening;
    return interrupted;
}

}  // namespace tarn
