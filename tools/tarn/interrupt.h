// Ctrl-C as a flag that long work checks, so that it can stop early and leave complete files.
#pragma once

#include <atomic>

namespace tarn {

// True once the user pressed Ctrl-C (or the process got SIGTERM). The first call starts listening; a second
// Ctrl-C ends the program at once.
const std::atomic<bool>& interrupt_flag();

}  // namespace tarn
