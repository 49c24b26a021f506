#include "replay_file.h"

#include <fmt/format.h>

#include <fstream>
#include <set>

#include "../tarn_names.h"
#include "simulation.h"
#include "step_line.h"

namespace game {
namespace {

constexpr const char* TITLE = "tarn-sandbox-replay";
constexpr int VERSION = 4;
constexpr std::size_t STEP_LIMIT = 24u * 3600u * 60u;  // a day
constexpr int SIZE_LIMIT_PX = 16384;

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
        const StepRun run = read_step_line(words, STEP_LIMIT - replay_.steps.size());
        replay_.steps.insert(replay_.steps.end(), run.count, run.input);
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
