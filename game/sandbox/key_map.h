// Which keys do what: as a text file says that the user may change.
//
//     # a comment
//     ACTION = KEY KEY ...
//
// An action without a line has its default keys, one without keys has none. Keys are places on the US
// keyboard.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace game {

enum class Action {
    FORWARD,
    BACK,
    LEFT,
    RIGHT,
    RUN,
    CROUCH,
    JUMP,
    USE,
    TORCH,
    RESTART,
    HELP,
    PANEL,
    SAVE,
    LOAD,
    FULLSCREEN,
    SCREENSHOT
};
inline constexpr int ACTION_COUNT = int(Action::SCREENSHOT) + 1;

class KeyMap {
  public:
    // As long as nobody says otherwise.
    KeyMap();

    // GLFW_KEY_*
    const std::vector<int>& keys(Action action) const { return keys_[std::size_t(action)]; }
    void set_keys(Action action, const std::vector<int>& keys) { keys_[std::size_t(action)] = keys; }
    // "Space", or "C, LeftControl", or "no key".
    std::string describe(Action action) const;

    bool operator==(const KeyMap&) const = default;

  private:
    std::array<std::vector<int>, ACTION_COUNT> keys_;
};

// The file's text.
std::string describe_keys(const KeyMap& keys);

// Error that names the file and the line, and says what is accepted; also where two actions have one key.
KeyMap load_keys(const std::filesystem::path& file);

}  // namespace game
