// What the commands write besides pictures: folders, bytes and JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

namespace tarn {

// Makes a folder and its parents. Throws Error that names it.
void create_folder(const std::filesystem::path& folder);

// Throws Error where the folder of `file` does not exist: to be found before the work is done, not after it.
// An empty name means that nothing is to be written.
void check_output_folder(const std::filesystem::path& file);

// Writes bytes whole or not at all. Throws Error that names the file.
void write_file(const std::filesystem::path& file, std::string_view bytes);

// Which Tarn this is: version, commit, build_type.
nlohmann::ordered_json describe_build();

// Writes `json` indented, in the order of its keys; bytes that are not UTF-8 (names of files) are replaced.
// An object gets the key "tarn", describe_build(), where it has none. Throws as write_file does.
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);

}  // namespace tarn
