#include "step_line.h"

namespace game {
namespace {

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

}  // namespace

std::string describe_steps(std::size_t count, const StepInput& input) {
    return fmt::format("step {} {} {} {} {} {} {}\n", count, input.right, input.forward, describe_keys(input),
                       input.look_right, input.look_down, input.wheel);
}

StepRun read_step_line(Words& words, std::size_t most) {
    constexpr int MOUSE_LIMIT = 1000000;
    StepRun run;
    StepInput& input = run.input;
    run.count = std::size_t(words.take_number("the count", 1, (long long)most));
    input.right = int(words.take_number("right", -FULL_SPEED, FULL_SPEED));
    input.forward = int(words.take_number("forward", -FULL_SPEED, FULL_SPEED));
    read_keys(words.take("the keys"), input);
    input.look_right = int(words.take_number("look right", -MOUSE_LIMIT, MOUSE_LIMIT));
    input.look_down = int(words.take_number("look down", -MOUSE_LIMIT, MOUSE_LIMIT));
    input.wheel = int(words.take_number("the wheel", -1000, 1000));
    return run;
}

}  // namespace game
