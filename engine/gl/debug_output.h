// What the driver complains about, kept for tests and logs, and named groups of commands for debuggers.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace tarn {

// Listens to the KHR_debug messages of the context that is current when it is made; must outlive that
// context.
class DebugOutput {
  public:
    DebugOutput();
    ~DebugOutput();
    DebugOutput(const DebugOutput&) = delete;
    DebugOutput& operator=(const DebugOutput&) = delete;

    struct Messages;

  private:
    std::unique_ptr<Messages> messages_;
};

// Returns and forgets the errors, undefined behaviour and high-severity messages of the current context since
// the last call, one string each (the first 100 are kept); empty when no DebugOutput listens.
std::vector<std::string> take_debug_errors();

// Names the GL commands issued during its life.
class DebugGroup {
  public:
    explicit DebugGroup(const std::string& name);
    ~DebugGroup();
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace tarn
