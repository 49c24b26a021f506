// Steps as a line of a text file, the same in replays and saves:
//
//     step COUNT RIGHT FORWARD KEYS LOOK_RIGHT LOOK_DOWN WHEEL
//
// COUNT steps had the same input. RIGHT and FORWARD: -100 to 100, percent of the speed. KEYS: those letters
// of "rcjtuxf" that were down (run, crouch, jump, throw, use, restart, torch), "-" for none.
#pragma once

#include <cstddef>
#include <string>

#include "step_input.h"
#include "words.h"

namespace game {

std::string describe_steps(std::size_t count, const StepInput& input);

struct StepRun {
    std::size_t count = 0;
    StepInput input;
};

// What follows the word "step". Error without file and line, also where COUNT is more than `most`.
StepRun read_step_line(Words& words, std::size_t most);

}  // namespace game
