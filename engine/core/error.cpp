#include "core/error.h"

#include <cstdio>
#include <cstdlib>

namespace tarn {

void fail_assertion(const char* condition, const char* file, int line, const std::string& message) {
    std::fprintf(stderr, "%s:%d: assertion failed: %s: %s\n", file, line, condition, message.c_str());
    std::abort();
}

}  // namespace tarn
