// A moment of play as a text file.
//
//     tarn-sandbox-save 1
//     scene NAME            a file, or a scene of the project
//     level HASH            of what is solid: 16 hexadecimal digits
//     play STEP YAW PITCH AIMED COLOR FINISHED TORCH
//     person ...            numbers of CharacterSnapshot
//     next NUMBER           whose of the balls turn is next
//     ball NUMBER COLOR BODY      once for each that is there: numbers of BodySnapshot
//     ball NUMBER COLOR           and for each that is not
//     crate BODY
//     lantern LIT COLOR BRIGHTNESS
//     step COUNT RIGHT ...  what was done since, as in step_line.h
//     sum HASH              of all bytes before this line
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "snapshot.h"

namespace game {

struct SaveFile {
    std::string scene;
    std::uint64_t level_hash = 0;
    SavedPlay play;

    bool operator==(const SaveFile&) const = default;
};

// The whole text.
std::string describe_save(const SaveFile& save);

// Error that names the file and, where it is one line's fault, the line. A file that is not as it was written
// is never taken for one that is.
SaveFile load_save(const std::filesystem::path& file);

}  // namespace game
