#include "core/data_files.h"

#include <cstdlib>

#include "core/error.h"

namespace tarn {
namespace {

std::filesystem::path& data_root() {
    static std::filesystem::path root;
    return root;
}

// The folder of the running program; empty where the system does not tell.
std::filesystem::path program_folder() {
    std::error_code failure;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failure);
    return failure ? std::filesystem::path() : program.parent_path();
}

}  // namespace

std::vector<std::filesystem::path> list_data_places(const DataFolder& folder) {
    const char* chosen = std::getenv(folder.variable);
    if (chosen != nullptr && *chosen != '\0') return {chosen};
    std::vector<std::filesystem::path> places;
    if (const std::filesystem::path beside = program_folder(); !beside.empty()) {
        places.push_back(beside / folder.name);
        places.push_back(beside.parent_path() / "share" / "tarn" / folder.name);
    }
    if (!data_root().empty()) places.push_back(data_root() / folder.name);
    places.emplace_back(folder.built);
    return places;
}

std::optional<std::filesystem::path> find_data_file(const DataFolder& folder, const std::string& file) {
    std::error_code ignored;
    for (const std::filesystem::path& place : list_data_places(folder)) {
        if (std::filesystem::exists(place / file, ignored)) return place / file;
    }
    return std::nullopt;
}

std::filesystem::path locate_data_file(const DataFolder& folder, const std::string& file) {
    if (const auto found = find_data_file(folder, file)) return *found;
    throw Error("{} is not in Tarn's {}: {}", file, folder.name, describe_data_places(folder));
}

std::string describe_data_places(const DataFolder& folder) {
    std::string places;
    for (const std::filesystem::path& place : list_data_places(folder)) {
        places += (places.empty() ? "" : ", ") + place.string();
    }
    return fmt::format("looked in {}; {} names another place", places, folder.variable);
}

void set_data_root(const std::filesystem::path& share_folder) {
    data_root() = share_folder;
}

}  // namespace tarn
