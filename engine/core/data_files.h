// Where the files lie that Tarn reads while it runs: shaders, its own scenes, camera paths, parts of the
// report.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tarn {

// One folder of such files.
struct DataFolder {
    const char* name;      // "shaders": its name beside the program and under share/tarn
    const char* variable;  // "TARN_SHADER_DIR": the environment variable that names another place
    const char* built;     // where it was when Tarn was built
};

// The places where `folder` may be, in the order of the search: what the variable says, and then nothing
// else; else beside the program, ../share/tarn from the program, the place given to set_data_root, the place
// of the build.
std::vector<std::filesystem::path> list_data_places(const DataFolder& folder);

// `file` of `folder` in the first place that holds it; nullopt where none does.
std::optional<std::filesystem::path> find_data_file(const DataFolder& folder, const std::string& file);

// The same. Throws Error that lists where it looked.
std::filesystem::path locate_data_file(const DataFolder& folder, const std::string& file);

// "looked in A, B; TARN_SHADER_DIR names another place", for messages.
std::string describe_data_places(const DataFolder& folder);

// Names the share/tarn folder of an installed Tarn, for programs that link it and lie elsewhere. Empty: none.
// To be called before the first look-up.
void set_data_root(const std::filesystem::path& share_folder);

}  // namespace tarn
