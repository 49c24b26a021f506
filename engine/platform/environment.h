// An environment variable that is set for a while.
#pragma once

#include <optional>
#include <string>

namespace tarn {

// Sets `name` to `value` until it dies, then restores what was there. Drivers are configured this way at
// their start; not for use while other threads read the environment.
class ScopedEnvironment {
  public:
    ScopedEnvironment(std::string name, const std::string& value);
    ~ScopedEnvironment();
    ScopedEnvironment(const ScopedEnvironment&) = delete;
    ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;

  private:
    std::string name_;
    std::optional<std::string> previous_;
};

// The variable's value, or nothing where it is unset or empty.
std::optional<std::string> get_environment(const char* name);

}  // namespace tarn
