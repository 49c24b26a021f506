#include "user_folders.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <system_error>

#include "tarn_names.h"

namespace game {
namespace {

std::filesystem::path find_user_folder(const char* variable, const char* below_home) {
    // The specification says that relative paths are to be ignored.
    const char* named = std::getenv(variable);
    if (named != nullptr && std::filesystem::path(named).is_absolute())
        return std::filesystem::path(named) / "tarn";
    const char* home = std::getenv("HOME");
    if (home != nullptr && std::filesystem::path(home).is_absolute())
        return std::filesystem::path(home) / below_home / "tarn";
    throw Error(fmt::format("neither {} nor HOME names a folder", variable));
}

}  // namespace

std::filesystem::path find_data_folder() {
    return find_user_folder("XDG_DATA_HOME", ".local/share");
}

std::filesystem::path find_settings_folder() {
    return find_user_folder("XDG_CONFIG_HOME", ".config");
}

void write_whole(const std::filesystem::path& file, const std::string& text) {
    std::error_code failure;
    std::filesystem::create_directories(file.parent_path(), failure);
    if (failure)
        throw Error(
            fmt::format("{}: the folder cannot be made: {}", file.parent_path().string(), failure.message()));
    const std::filesystem::path part = file.string() + ".part";
    std::ofstream stream(part, std::ios::binary | std::ios::trunc);
    stream << text;
    stream.close();
    if (stream) std::filesystem::rename(part, file, failure);
    if (stream && !failure) return;
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw Error(fmt::format("{}: the file cannot be written", file.string()));
}

std::filesystem::path put_aside(const std::filesystem::path& file, const std::string& ending) {
    std::filesystem::path aside = file.string() + "." + ending;
    for (int i = 2; std::filesystem::exists(aside); ++i)
        aside = fmt::format("{}.{}.{}", file.string(), ending, i);
    std::error_code failure;
    std::filesystem::rename(file, aside, failure);
    if (failure) throw Error(fmt::format("{}: cannot be renamed: {}", file.string(), failure.message()));
    return aside;
}

}  // namespace game
