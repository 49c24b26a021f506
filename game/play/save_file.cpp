#include "save_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <set>

#include "hash.h"
#include "step_line.h"
#include "words.h"

namespace game {
namespace {

constexpr const char* SAVE_TITLE = "tarn-sandbox-save";
constexpr int SAVE_VERSION = 1;
constexpr std::size_t THING_LIMIT = 100000;  // crates, lanterns
constexpr double FAR = 1e7;                  // metres, metres a second
constexpr double ANGLE_LIMIT_RAD = 10.0;
constexpr long long LONG_STEPS = 1ll << 53;

std::uint64_t compute_sum(const std::string& text) {
    Hash hash;
    for (const char byte : text) hash.add(byte);
    return hash.value();
}

// Shortest decimal numbers that give the same bits back.
std::string describe_numbers(const float* values, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += fmt::format(" {}", values[i]);
    return text;
}

template <std::size_t COUNT>
std::string describe_numbers(const std::array<float, COUNT>& values) {
    return describe_numbers(values.data(), COUNT);
}

std::string describe_body(const BodySnapshot& body) {
    return describe_numbers(body.turn) + describe_numbers(body.middle) + describe_numbers(body.velocity) +
           describe_numbers(body.spin) + fmt::format(" {} {}", body.activation, body.still_s);
}

std::string describe_person(const CharacterSnapshot& person) {
    return "person" + describe_numbers(person.middle) + describe_numbers(person.velocity) +
           describe_numbers(person.wish) +
           fmt::format(" {} {} {} {:d} {:d} {:d}\n", person.eye_height_m, person.rise_m_s, person.rise_m,
                       person.is_crouching, person.was_on_ground, person.was_jumping);
}

std::string describe_since(const std::vector<StepInput>& steps) {
    std::string text;
    for (std::size_t i = 0, next = 0; i < steps.size(); i = next) {
        while (next < steps.size() && steps[next] == steps[i]) ++next;
        text += describe_steps(next - i, steps[i]);
    }
    return text;
}

std::string describe_snapshot(const Snapshot& snapshot) {
    std::string text =
        fmt::format("play {} {} {} {} {} {} {:d}\n", snapshot.step, snapshot.yaw_rad, snapshot.pitch_rad,
                    snapshot.aimed_lantern, snapshot.next_color, snapshot.finished_step, snapshot.torch);
    text += describe_person(snapshot.character) + fmt::format("next {}\n", snapshot.next_ball);
    for (std::size_t i = 0; i < snapshot.balls.size(); ++i) {
        const BallSnapshot& ball = snapshot.balls[i];
        text += fmt::format("ball {} {}{}\n", i, ball.color, ball.is_alive ? describe_body(ball.body) : "");
    }
    for (const BodySnapshot& crate : snapshot.crates) text += "crate" + describe_body(crate) + "\n";
    for (const LanternState& lantern : snapshot.lanterns)
        text += fmt::format("lantern {:d} {} {}\n", lantern.is_lit, lantern.color, lantern.brightness);
    return text;
}

template <std::size_t COUNT>
void take_numbers(Words& words, const char* what, double most, std::array<float, COUNT>& values) {
    for (float& value : values) value = words.take_real<float>(what, most);
}

bool take_flag(Words& words, const char* what) {
    return words.take_number(what, 0, 1) != 0;
}

BodySnapshot take_body(Words& words) {
    constexpr int LAST_ACTIVATION = 5;  // of Bullet's
    BodySnapshot body;
    take_numbers(words, "the turn", 2.0, body.turn);
    take_numbers(words, "the place", FAR, body.middle);
    take_numbers(words, "the velocity", FAR, body.velocity);
    take_numbers(words, "the spin", FAR, body.spin);
    body.activation = int(words.take_number("the activation", 1, LAST_ACTIVATION));
    body.still_s = words.take_real<float>("the time at rest", FAR);
    return body;
}

CharacterSnapshot take_person(Words& words) {
    CharacterSnapshot person;
    take_numbers(words, "the place", FAR, person.middle);
    take_numbers(words, "the velocity", FAR, person.velocity);
    take_numbers(words, "the wish", FAR, person.wish);
    person.eye_height_m = words.take_real<float>("the eye's height", ANGLE_LIMIT_RAD);
    person.rise_m_s = words.take_real<float>("the speed of the rise", FAR);
    person.rise_m = words.take_real<float>("the rise", FAR);
    person.is_crouching = take_flag(words, "crouching");
    person.was_on_ground = take_flag(words, "on the ground");
    person.was_jumping = take_flag(words, "jumping");
    return person;
}

class SaveReader {
  public:
    // `text`: all before the sum.
    SaveFile read(const std::string& text) {
        save_.play.snapshot.balls.assign(std::size_t(BALL_LIMIT), {});
        std::istringstream stream(text);
        for (std::string line; std::getline(stream, line);) {
            ++line_;
            Words words(line);
            const std::string kind = words.take("a word");
            if (line_ == 1) {
                words.take_number("the version", SAVE_VERSION, SAVE_VERSION);
            } else {
                read_line(kind, words);
            }
            words.end();
        }
        for (const char* kind : {"scene", "level", "play", "person", "next"}) {
            if (!seen_.contains(kind)) throw Error(fmt::format("the line '{}' is missing", kind));
        }
        return std::move(save_);
    }
    int line() const { return line_; }

  private:
    void read_line(const std::string& kind, Words& words) {
        Snapshot& snapshot = save_.play.snapshot;
        const bool is_many = kind == "ball" || kind == "crate" || kind == "lantern" || kind == "step";
        if (!is_many && !seen_.insert(kind).second) throw Error(fmt::format("'{}' is there twice", kind));
        if (kind == "scene") {
            save_.scene = words.take_rest("the scene");
        } else if (kind == "level") {
            save_.level_hash = words.take_hash("the level's hash");
        } else if (kind == "play") {
            read_play(words);
        } else if (kind == "person") {
            snapshot.character = take_person(words);
        } else if (kind == "next") {
            snapshot.next_ball = int(words.take_number("the next ball", 0, BALL_LIMIT - 1));
        } else if (kind == "ball") {
            read_ball(words);
        } else if (kind == "crate") {
            limit(snapshot.crates.size(), "crates");
            snapshot.crates.push_back(take_body(words));
        } else if (kind == "lantern") {
            read_lantern(words);
        } else if (kind == "step") {
            read_step(words);
        } else {
            throw Error(fmt::format("'{}' begins no line of a save", kind));
        }
    }

    static void limit(std::size_t count, const char* things) {
        if (count >= THING_LIMIT) throw Error(fmt::format("there are more than {} {}", THING_LIMIT, things));
    }

    void read_play(Words& words) {
        Snapshot& snapshot = save_.play.snapshot;
        snapshot.step = std::uint64_t(words.take_number("the step", 0, LONG_STEPS));
        if (snapshot.step % SNAPSHOT_STEPS != 0)
            throw Error(fmt::format("the step is {}, no multiple of {}", snapshot.step, SNAPSHOT_STEPS));
        snapshot.yaw_rad = words.take_real<double>("the yaw", ANGLE_LIMIT_RAD);
        snapshot.pitch_rad = words.take_real<double>("the pitch", ANGLE_LIMIT_RAD);
        snapshot.aimed_lantern = int(words.take_number("the lantern aimed at", -1, THING_LIMIT));
        snapshot.next_color = int(words.take_number("the next colour", 0, PLAY_COLORS - 1));
        snapshot.finished_step = std::uint64_t(words.take_number("the step of the end", 0, LONG_STEPS));
        snapshot.torch = take_flag(words, "the torch");
    }

    void read_ball(Words& words) {
        const auto index = std::size_t(words.take_number("the ball", 0, BALL_LIMIT - 1));
        BallSnapshot& ball = save_.play.snapshot.balls[index];
        ball.color = int(words.take_number("the colour", 0, PLAY_COLORS - 1));
        ball.is_alive = words.has_more();
        if (ball.is_alive) ball.body = take_body(words);
    }

    void read_lantern(Words& words) {
        constexpr double BRIGHTNESS_LIMIT = 100.0;
        std::vector<LanternState>& lanterns = save_.play.snapshot.lanterns;
        limit(lanterns.size(), "lanterns");
        LanternState lantern;
        lantern.is_lit = take_flag(words, "whether it is lit");
        lantern.color = int(words.take_number("the colour", -1, PLAY_COLORS - 1));
        lantern.brightness = words.take_real<double>("the brightness", BRIGHTNESS_LIMIT);
        if (lantern.brightness < 0.0) throw Error("the brightness is below 0");
        lanterns.push_back(lantern);
    }

    void read_step(Words& words) {
        std::vector<StepInput>& since = save_.play.since;
        const StepRun run = read_step_line(words, std::size_t(SNAPSHOT_STEPS) - 1 - since.size());
        if (run.input.restart) throw Error("a restart is no step of a save");
        since.insert(since.end(), run.count, run.input);
    }

    SaveFile save_;
    std::set<std::string> seen_;
    int line_ = 0;
};

// All before the last line, whose sum it must have. Names of things: for people whose file is no save at all.
std::string check_sum(const std::string& text) {
    if (!text.starts_with(SAVE_TITLE)) throw Error("this is no save of tarn-sandbox");
    const std::string version = fmt::format("{} {}\n", SAVE_TITLE, SAVE_VERSION);
    if (!text.starts_with(version)) {
        Words words(text.substr(0, text.find('\n')));
        words.take("the title");
        throw Error(
            fmt::format("its version is {}, this program reads {}", words.take("the version"), SAVE_VERSION));
    }
    const std::size_t last = text.rfind("\nsum ");
    if (last == std::string::npos) throw Error("it is cut off: its sum is missing");
    const std::string body = text.substr(0, last + 1);
    if (text.substr(last + 1) != fmt::format("sum {:016x}\n", compute_sum(body)))
        throw Error("it is damaged: its sum is another than that of its text");
    return body;
}

}  // namespace

std::string describe_save(const SaveFile& save) {
    std::string text = fmt::format("{} {}\nscene {}\nlevel {:016x}\n", SAVE_TITLE, SAVE_VERSION, save.scene,
                                   save.level_hash);
    text += describe_snapshot(save.play.snapshot) + describe_since(save.play.since);
    return text + fmt::format("sum {:016x}\n", compute_sum(text));
}

SaveFile load_save(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file))
        throw Error(fmt::format("{}: the save cannot be read", file.string()));
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    std::string body;
    try {
        body = check_sum(text);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", file.string(), error.what()));
    }
    SaveReader reader;
    try {
        return reader.read(body);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: line {}: {}", file.string(), reader.line(), error.what()));
    }
}

}  // namespace game
