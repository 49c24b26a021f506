#include "replay_file.h"

#include <fmt/format.h>

#include <fstream>
#include <set>
#include <sstream>

#include "../tarn_names.h"
#include "simulation.h"

namespace game {
namespace {

constexpr const char* TITLE = "tarn-sandbox-replay";
constexpr int VERSION = 3;
constexpr std::size_t STEP_LIMIT = 24u * 3600u * 60u;  // a day
constexpr int SIZE_LIMIT_PX = 16384;

struct Key {
    char letter;
    bool StepInput::*flag;
};
constexpr Key KEYS[] = {{'r', &StepInput::run},        {'c', &StepInput::crouch}, {'j', &StepInput::jump},
                        {'t', &StepInput::throw_ball}, {'u', &StepInput::use},    {'x', &StepInput::restart},
                        {'f', &StepInput::torch}};

std::string describe_keys(const StepInput& input) {
    std::string letters;
    for (const Key& key : KEYS) {
        if (input.*key.flag) letters += key.letter;
    }
    return letters.empty() ? "-" : letters;
}

// One line's words, taken in turn. Each function throws a message without file and line.
class Words {
  public:
    explicit Words(const std::string& line) : stream_(line) {}

    std::string take(const char* what) {
        std::string word;
        if (!(stream_ >> word)) throw Error(fmt::format("{} is missing", what));
        return word;
    }
    std::string take_rest(const char* what) {
        std::string rest;
        std::getline(stream_ >> std::ws, rest);
        if (rest.empty()) throw Error(fmt::format("{} is missing", what));
        return rest;
    }
    long long take_number(const char* what, long long least, long long most) {
        const std::string word = take(what);
        std::size_t used = 0;
        long long value = 0;
        try {
            value = std::stoll(word, &used);
        } catch (const std::exception&) {
            used = 0;
        }
        if (used != word.size() || value < least || value > most)
            throw Error(fmt::format("{} is '{}', it must be {} to {}", what, word, least, most));
        return value;
    }
    std::uint64_t take_hash(const char* what) {
        const std::string word = take(what);
        if (word.size() != 16 || word.find_first_not_of("0123456789abcdef") != std::string::npos)
            throw Error(fmt::format("{} is '{}', it must be 16 hexadecimal digits", what, word));
        return std::stoull(word, nullptr, 16);
    }
    void end() {
        std::string word;
        if (stream_ >> word) throw Error(fmt::format("'{}' is one word too many", word));
    }

  private:
    std::istringstream stream_;
};

void read_keys(const std::string& letters, StepInput& input) {
    if (letters == "-") return;
    for (const char letter : letters) {
        bool is_known = false;
        for (const Key& key : KEYS) {
            if (key.letter != letter) continue;
            input.*key.flag = true;
            is_known = true;
        }
        if (!is_known) throw Error(fmt::format("'{}' is no key", letter));
    }
}

class Reader {
  public:
    Replay read(std::istream& stream) {
        replay_.is_complete = false;
        std::string line;
        while (std::getline(stream, line)) {
            ++line_;
            // Who was killed left half a line, which may say less than was meant.
            if (stream.eof() && line_ > 1) return finish();
            if (line.empty()) continue;
            if (replay_.is_complete) throw Error("there is more after the end");
            read_line(line);
        }
        ++line_;
        return finish();
    }
    int line() const { return line_; }

  private:
    Replay finish() {
        if (!replay_.is_complete && replay_.steps.empty())
            throw Error("the file is cut off before its first step");
        return std::move(replay_);
    }

    void check_head() const {
        for (const char* kind : {"scene", "level", "size", "seed", "fireflies"}) {
            if (!seen_.contains(kind)) throw Error(fmt::format("the line '{}' is missing", kind));
        }
    }

    void read_line(const std::string& line) {
        Words words(line);
        const std::string kind = words.take("a word");
        if (line_ == 1) return read_title(kind, words);
        if (kind != "step" && kind != "set" && !seen_.insert(kind).second)
            throw Error(fmt::format("'{}' is there twice", kind));
        if (kind == "scene") {
            replay_.scene = words.take_rest("the scene");
        } else if (kind == "level") {
            replay_.level_hash = words.take_hash("the level's hash");
        } else if (kind == "size") {
            replay_.width_px = int(words.take_number("the width", 1, SIZE_LIMIT_PX));
            replay_.height_px = int(words.take_number("the height", 1, SIZE_LIMIT_PX));
        } else if (kind == "seed") {
            replay_.seed = std::uint32_t(words.take_number("the seed", 0, 0xffffffffll));
        } else if (kind == "fireflies") {
            replay_.fireflies = int(words.take_number("the number of fireflies", 0, FIREFLY_LIMIT));
        } else if (kind == "set") {
            const std::string name = words.take("the setting's name");
            replay_.settings.emplace_back(name, words.take("the setting's value"));
        } else if (kind == "step") {
            read_step(words);
        } else if (kind == "end") {
            read_end(words);
        } else {
            throw Error(fmt::format("'{}' begins no line of a replay", kind));
        }
        words.end();
    }

    void read_title(const std::string& title, Words& words) {
        if (title != TITLE) throw Error("this is no replay of tarn-sandbox");
        const long long version = words.take_number("the version", 0, 1000000);
        if (version != VERSION)
            throw Error(fmt::format("its version is {}, this program reads {}", version, VERSION));
        words.end();
    }

    void read_step(Words& words) {
        if (replay_.steps.empty()) check_head();
        constexpr int MOUSE_LIMIT = 1000000;
        const std::size_t count = std::size_t(words.take_number("the count", 1, (long long)STEP_LIMIT));
        if (replay_.steps.size() + count > STEP_LIMIT)
            throw Error(fmt::format("there are more than {} steps", STEP_LIMIT));
        StepInput input;
        input.right = int(words.take_number("right", -FULL_SPEED, FULL_SPEED));
        input.forward = int(words.take_number("forward", -FULL_SPEED, FULL_SPEED));
        read_keys(words.take("the keys"), input);
        input.look_right = int(words.take_number("look right", -MOUSE_LIMIT, MOUSE_LIMIT));
        input.look_down = int(words.take_number("look down", -MOUSE_LIMIT, MOUSE_LIMIT));
        input.wheel = int(words.take_number("the wheel", -1000, 1000));
        replay_.steps.insert(replay_.steps.end(), count, input);
    }

    void read_end(Words& words) {
        check_head();
        const long long steps = words.take_number("the number of steps", 0, (long long)STEP_LIMIT);
        if (std::size_t(steps) != replay_.steps.size())
            throw Error(fmt::format("it ends after {} steps, there are {}", steps, replay_.steps.size()));
        replay_.state_hash = words.take_hash("the state's hash");
        replay_.is_complete = true;
    }

    Replay replay_;
    std::set<std::string> seen_;
    int line_ = 0;
};

}  // namespace

std::string describe_head(const Replay& replay) {
    std::string text = fmt::format("{} {}\nscene {}\nlevel {:016x}\nsize {} {}\nseed {}\nfireflies {}\n",
                                   TITLE, VERSION, replay.scene, replay.level_hash, replay.width_px,
                                   replay.height_px, replay.seed, replay.fireflies);
    for (const auto& [name, value] : replay.settings) text += fmt::format("set {} {}\n", name, value);
    return text;
}

std::string describe_steps(std::size_t count, const StepInput& input) {
    return fmt::format("step {} {} {} {} {} {} {}\n", count, input.right, input.forward, describe_keys(input),
                       input.look_right, input.look_down, input.wheel);
}

std::string describe_end(std::size_t steps, std::uint64_t state_hash) {
    return fmt::format("end {} {:016x}\n", steps, state_hash);
}

Replay load_replay(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
        throw Error(fmt::format("{}: the replay cannot be read", file.string()));
    Reader reader;
    try {
        return reader.read(stream);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: line {}: {}", file.string(), reader.line(), error.what()));
    }
}

}  // namespace game
