// Finished sequences on disk, so that a run that was killed goes on where it was.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bench/sequence.h"
#include "output/output_files.h"

namespace tarn {

// A folder that belongs to one run. `key` is all that decides the run's outcome: a folder that holds another
// run's work is refused, never mixed.
class WorkFolder {
  public:
    // Opens or makes the folder. Throws Error where it cannot be made or belongs to a run with another key.
    WorkFolder(std::filesystem::path folder, const nlohmann::json& key);

    // Whether an earlier run left anything here.
    bool is_resumed() const { return resumed_; }

    // Keeps a sequence under `name`, whole or not at all. Throws Error that names the file.
    void save(const std::string& name, const MeasuredSequence& sequence) const;

    // The sequence under `name`, if it is there and whole; what is damaged is warned about and made anew.
    std::optional<SequenceMeasure> load_measure(const std::string& name) const;

    // The pictures of a sequence that load_measure() found. Throws Error where they cannot be read.
    Image load_mean(const std::string& name) const;
    Image load_first(const std::string& name) const;

    // Small things besides: null where there is nothing.
    void save_note(const std::string& name, const nlohmann::json& note) const;
    nlohmann::json load_note(const std::string& name) const;

    // Removes the folder: the run is complete.
    void remove() const;

  private:
    std::filesystem::path file(const std::string& name, const char* ending) const;

    std::filesystem::path folder_;
    bool resumed_ = false;
};

}  // namespace tarn
