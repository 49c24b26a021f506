// How Tarn fails: Error for bad input and failing drivers, TARN_ASSERT for mistakes of programmers.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace tarn {

// Something outside the program is wrong: a file, a scene, a shader, a driver. The message is one line that
// names the thing, the value and the limit: Error("light_count is {}, the table holds {}", count, limit).
// Caught once, in main.
class Error : public std::runtime_error {
  public:
    template <class... Args>
    explicit Error(fmt::format_string<Args...> format, Args&&... args)
        : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

// The user asked for what does not exist or make sense: exit status 2 instead of 1.
class UsageError : public Error {
  public:
    using Error::Error;
};

[[noreturn]] void fail_assertion(const char* condition, const char* file, int line,
                                 const std::string& message);

}  // namespace tarn

// Stops the program when `condition` is false. On where CMake's option TARN_ASSERTIONS is: unless told
// otherwise, wherever the tests are built. Else it compiles to nothing.
#ifdef TARN_ASSERTIONS
#define TARN_ASSERT(condition, ...) \
    ((condition) ? (void)0 : ::tarn::fail_assertion(#condition, __FILE__, __LINE__, fmt::format(__VA_ARGS__)))
#else
#define TARN_ASSERT(condition, ...) ((void)sizeof(!(condition)))
#endif
