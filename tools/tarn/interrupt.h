// Ctrl-C as a wish that long work looks at, so that it ends with whole files.
#pragma once

#include <atomic>

namespace tarn {

// True once the user pressed Ctrl-C (or the process got SIGTERM). The first call starts listening; a second
// Ctrl-C ends the program at once.
const std::atomic<bool>& interrupt_flag();

}  // namespace tarn
