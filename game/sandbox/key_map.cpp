#include "key_map.h"

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "../tarn_names.h"

namespace game {
namespace {

// In the order of Action.
constexpr const char* ACTION_NAMES[ACTION_COUNT] = {
    "forward", "back",    "left", "right", "run",  "crouch", "jump",       "use",
    "torch",   "restart", "help", "panel", "save", "load",   "fullscreen", "screenshot"};

struct NamedKey {
    const char* name;
    int key;
};
// Besides letters, digits and F1 to F12. Escape always frees the mouse, and quits.
constexpr NamedKey NAMED_KEYS[] = {{"Space", GLFW_KEY_SPACE},
                                   {"Tab", GLFW_KEY_TAB},
                                   {"Enter", GLFW_KEY_ENTER},
                                   {"Backspace", GLFW_KEY_BACKSPACE},
                                   {"Insert", GLFW_KEY_INSERT},
                                   {"Delete", GLFW_KEY_DELETE},
                                   {"Home", GLFW_KEY_HOME},
                                   {"End", GLFW_KEY_END},
                                   {"PageUp", GLFW_KEY_PAGE_UP},
                                   {"PageDown", GLFW_KEY_PAGE_DOWN},
                                   {"Left", GLFW_KEY_LEFT},
                                   {"Right", GLFW_KEY_RIGHT},
                                   {"Up", GLFW_KEY_UP},
                                   {"Down", GLFW_KEY_DOWN},
                                   {"LeftShift", GLFW_KEY_LEFT_SHIFT},
                                   {"RightShift", GLFW_KEY_RIGHT_SHIFT},
                                   {"LeftControl", GLFW_KEY_LEFT_CONTROL},
                                   {"RightControl", GLFW_KEY_RIGHT_CONTROL},
                                   {"LeftAlt", GLFW_KEY_LEFT_ALT},
                                   {"RightAlt", GLFW_KEY_RIGHT_ALT}};
constexpr int LAST_F_KEY = 12;

std::map<std::string, int> make_key_names() {
    std::map<std::string, int> names;
    for (const NamedKey& key : NAMED_KEYS) names[key.name] = key.key;
    for (char letter = 'A'; letter <= 'Z'; ++letter)
        names[std::string(1, letter)] = GLFW_KEY_A + (letter - 'A');
    for (char digit = '0'; digit <= '9'; ++digit) names[std::string(1, digit)] = GLFW_KEY_0 + (digit - '0');
    for (int i = 1; i <= LAST_F_KEY; ++i) names[fmt::format("F{}", i)] = GLFW_KEY_F1 + i - 1;
    return names;
}

const std::map<std::string, int>& key_names() {
    static const std::map<std::string, int> NAMES = make_key_names();
    return NAMES;
}

std::string name_of(int key) {
    for (const auto& [name, code] : key_names()) {
        if (code == key) return name;
    }
    return "?";
}

std::string list_actions() {
    std::string list;
    for (const char* name : ACTION_NAMES) list += fmt::format("{}{}", list.empty() ? "" : ", ", name);
    return list;
}

std::string list_keys() {
    std::string list = "A to Z, 0 to 9, F1 to F12";
    for (const NamedKey& key : NAMED_KEYS) list += fmt::format(", {}", key.name);
    return list;
}

// One file. Each function throws a message without file and line.
class KeyFile {
  public:
    void read(std::istream& stream) {
        for (std::string line; std::getline(stream, line);) {
            ++line_;
            const std::size_t comment = line.find('#');
            if (comment != std::string::npos) line.resize(comment);
            if (line.find_first_not_of(" \t\r") != std::string::npos) read_line(line);
        }
        check_defaults();
    }
    int line() const { return line_; }
    const KeyMap& keys() const { return keys_; }

  private:
    void read_line(const std::string& line) {
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos) throw Error("a line is ACTION = KEY KEY ...");
        std::istringstream left(line.substr(0, equals)), right(line.substr(equals + 1));
        std::string name, more;
        if (!(left >> name) || left >> more) throw Error("a line is ACTION = KEY KEY ...");
        const auto* found = std::find(std::begin(ACTION_NAMES), std::end(ACTION_NAMES), name);
        if (found == std::end(ACTION_NAMES))
            throw Error(fmt::format("'{}' is no action; there are {}", name, list_actions()));
        const auto action = Action(found - std::begin(ACTION_NAMES));
        if (lines_.contains(action))
            throw Error(fmt::format("'{}' is in line {} already", name, lines_[action]));
        lines_[action] = line_;
        std::vector<int> keys;
        for (std::string key; right >> key;) keys.push_back(take_key(key, action));
        keys_.set_keys(action, keys);
    }

    int take_key(const std::string& name, Action action) {
        const auto found = key_names().find(name);
        if (found == key_names().end())
            throw Error(fmt::format("'{}' is no key; there are {}", name, list_keys()));
        const auto [owner, is_new] = owners_.try_emplace(found->second, action);
        if (!is_new) {
            throw Error(fmt::format("'{}' is a key of '{}' already, in line {}", name,
                                    ACTION_NAMES[int(owner->second)], lines_[owner->second]));
        }
        return found->second;
    }

    // What no line changes keeps its keys, if nothing else has taken them.
    void check_defaults() {
        for (int i = 0; i < ACTION_COUNT; ++i) {
            if (lines_.contains(Action(i))) continue;
            for (const int key : keys_.keys(Action(i))) {
                const auto owner = owners_.find(key);
                if (owner == owners_.end()) continue;
                line_ = lines_[owner->second];
                throw Error(fmt::format("'{}' is a key of '{}' already, which no line changes", name_of(key),
                                        ACTION_NAMES[i]));
            }
        }
    }

    KeyMap keys_;
    std::map<Action, int> lines_;
    std::map<int, Action> owners_;
    int line_ = 0;
};

}  // namespace

KeyMap::KeyMap() {
    set_keys(Action::FORWARD, {GLFW_KEY_W});
    set_keys(Action::BACK, {GLFW_KEY_S});
    set_keys(Action::LEFT, {GLFW_KEY_A});
    set_keys(Action::RIGHT, {GLFW_KEY_D});
    set_keys(Action::RUN, {GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT});
    set_keys(Action::CROUCH, {GLFW_KEY_C, GLFW_KEY_LEFT_CONTROL});
    set_keys(Action::JUMP, {GLFW_KEY_SPACE});
    set_keys(Action::USE, {GLFW_KEY_E});
    set_keys(Action::TORCH, {GLFW_KEY_F});
    set_keys(Action::RESTART, {GLFW_KEY_R});
    set_keys(Action::HELP, {GLFW_KEY_F1});
    set_keys(Action::PANEL, {GLFW_KEY_F2});
    set_keys(Action::SAVE, {GLFW_KEY_F5});
    set_keys(Action::LOAD, {GLFW_KEY_F9});
    set_keys(Action::FULLSCREEN, {GLFW_KEY_F11});
    set_keys(Action::SCREENSHOT, {GLFW_KEY_F12});
}

std::string KeyMap::describe(Action action) const {
    std::string list;
    const std::vector<int>& bound = keys(action);
    if (bound == std::vector<int>{GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT}) return "Shift";
    if (bound == std::vector<int>{GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL}) return "Control";
    if (bound == std::vector<int>{GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT}) return "Alt";
    for (const int key : bound) list += fmt::format("{}{}", list.empty() ? "" : ", ", name_of(key));
    return list.empty() ? "no key" : list;
}

std::string describe_keys(const KeyMap& keys) {
    std::string text = fmt::format(
        "# Keys of tarn-sandbox: ACTION = KEY KEY ...\n# Keys: {}\n"
        "# Escape frees the mouse and quits, whatever this file says.\n",
        list_keys());
    for (int i = 0; i < ACTION_COUNT; ++i) {
        text += fmt::format("{} =", ACTION_NAMES[i]);
        for (const int key : keys.keys(Action(i))) text += fmt::format(" {}", name_of(key));
        text += '\n';
    }
    return text;
}

KeyMap load_keys(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
        throw Error(fmt::format("{}: the keys cannot be read", file.string()));
    KeyFile keys;
    try {
        keys.read(stream);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: line {}: {}", file.string(), keys.line(), error.what()));
    }
    return keys.keys();
}

}  // namespace game
