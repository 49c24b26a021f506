// What a comparison of folders came to, for machines: JUnit XML for CI services, JSON for anything else.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare_folders.h"

namespace tarn {

// "5 pictures: 3 passed, 1 failed, 1 missing"
std::string summarize(const std::vector<PictureResult>& results);

std::size_t count_failures(const std::vector<PictureResult>& results);

// One test suite with one test case a picture; whatever did not pass has a <failure>.
std::string make_junit(const FolderOptions& options, const std::vector<PictureResult>& results);

nlohmann::ordered_json make_folder_json(const FolderOptions& options,
                                        const std::vector<PictureResult>& results);

}  // namespace tarn
