// Which Tarn this is. In a library of its own, tarn_version: it changes with every commit, and what links it
// is linked anew.
#pragma once

#include <string>

namespace tarn {

extern const char* const VERSION;  // "0.1.0"
extern const char* const COMMIT;   // 12 hexadecimal digits, or "unknown" where the sources came without git
extern const char* const BUILD_TYPE;  // "RelWithDebInfo"

// "tarn 0.1.0 (commit 0123456789ab, RelWithDebInfo)", as pictures and pages have it.
inline std::string describe_program() {
    return std::string("tarn ") + VERSION + " (commit " + COMMIT + ", " + BUILD_TYPE + ")";
}

}  // namespace tarn
