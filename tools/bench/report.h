// results.json and its pictures as one HTML file that needs nothing else.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tarn {

struct ReportInput {
    nlohmann::ordered_json results;
    std::filesystem::path folder;  // where the pictures lie that the results name
};

// Reads DIR/results.json, or the file itself. Throws Error where it is missing, damaged, of another format or
// of a newer version.
ReportInput load_results(const std::filesystem::path& file_or_folder);

// Writes the page, whole or not at all. Throws Error naming the file where a picture or a part of the page
// cannot be read, or the page cannot be written.
void write_report(const std::filesystem::path& file, const std::vector<ReportInput>& inputs);

// A file of the pages' parts, such as "page.css". Throws Error naming it where it cannot be read.
std::string load_page_part(const std::string& name);

}  // namespace tarn
