// What somebody did in the sandbox, step by step, as a text file.
//
//     tarn-sandbox-replay 1
//     scene NAME                     a file, or a scene of the project
//     level HASH                     of what is solid: 16 hexadecimal digits
//     size WIDTH HEIGHT              of the pictures, pixels
//     seed NUMBER                    of all random numbers
//     set NAME VALUE                 a setting; once for each
//     step COUNT RIGHT FORWARD KEYS LOOK_RIGHT LOOK_DOWN WHEEL
//     end STEPS HASH                 how many steps those were, and the state after them
//
// COUNT steps had the same input. KEYS: those letters of "rcjtux" that were down (run, crouch, jump, throw,
// use, restart), "-" for none.
#pragma once

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
    std::vector<std::pair<std::string, std::string>> settings;  // name, value
    std::vector<StepInput> steps;
    std::uint64_t state_hash = 0;

    bool operator==(const Replay&) const = default;
};

// Error that names the file and the line, and what is wrong with it.
Replay load_replay(const std::filesystem::path& file);

// The file is written whole or not at all. Error that names it.
void save_replay(const std::filesystem::path& file, const Replay& replay);

}  // namespace game
