// What somebody did in the sandbox, step by step, as a text file.
//
//     tarn-sandbox-replay 4
//     scene NAME                     a file, or a scene of the project
//     level HASH                     of what is solid: 16 hexadecimal digits
//     size WIDTH HEIGHT              of the pictures, pixels
//     seed NUMBER                    of all random numbers
//     fireflies NUMBER               that were wished for
//     set NAME VALUE                 a setting; once for each
//     step COUNT RIGHT ...           as in step_line.h
//     end STEPS HASH                 how many steps those were, and the state after them
//
// A file that is cut off, as by a program that was killed, holds what was done until then: the lines that are
// whole. It has no state to hold its end against.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "step_input.h"

namespace game {

struct Replay {
    std::string scene;
    std::uint64_t level_hash = 0;
    int width_px = 0;
    int height_px = 0;
    std::uint32_t seed = 0;
    int fireflies = 0;
    std::vector<std::pair<std::string, std::string>> settings;  // name, value
    std::vector<StepInput> steps;
    std::uint64_t state_hash = 0;  // after the last step
    bool is_complete = true;  // else the file is cut off: there may have been more, and no state is known

    bool operator==(const Replay&) const = default;
};

// Error that names the file and the line, and what is wrong with it; also for a file without any whole step.
Replay load_replay(const std::filesystem::path& file);

// Lines of such a file: all before the first step, and the end.
std::string describe_head(const Replay& replay);
std::string describe_end(std::size_t steps, std::uint64_t state_hash);

}  // namespace game
