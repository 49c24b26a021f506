// The saves of a level: one that the user asks for and one that is written by itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "stage.h"

namespace game {

enum class SaveKind { ASKED_FOR, AUTOMATIC };

class Saves {
  public:
    // In a folder that may not be there yet. `scene`: as in StageSource.
    Saves(const std::filesystem::path& folder, const std::string& scene, std::uint64_t level_hash);

    // FOLDER/NAME-HASH.save or .autosave; two levels never have the same.
    std::filesystem::path file(SaveKind kind) const;
    // Error that names the file; what was there before stays then.
    void write(SaveKind kind, const Stage& stage) const;
    // False where there is none. Where it is damaged, or of another level, the stage stays as it is and the
    // file is put aside; the Error says so in one line.
    bool load(SaveKind kind, Stage& stage) const;

  private:
    std::filesystem::path folder_;
    std::string scene_;
    std::uint64_t level_hash_;
};

}  // namespace game
