// Where a user's data and settings lie, and files that are written whole or not at all.
#pragma once

#include <filesystem>
#include <string>

namespace game {

// $XDG_DATA_HOME/tarn, or ~/.local/share/tarn. Error where neither is set. The folder may not be there yet.
std::filesystem::path find_data_folder();

// $XDG_CONFIG_HOME/tarn, or ~/.config/tarn; as above.
std::filesystem::path find_settings_folder();

// Makes the folder where it is missing, writes a file beside the old one and then takes its place. Error that
// names the file.
void write_whole(const std::filesystem::path& file, const std::string& text);

// Renames a file to one that is not there yet, FILE.ending or FILE.ending.2 and so on; its new name. Error
// that names it.
std::filesystem::path put_aside(const std::filesystem::path& file, const std::string& ending);

}  // namespace game
