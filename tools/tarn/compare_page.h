// What a comparison of folders came to, for people: a page that shows each picture that did not pass.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare_folders.h"

namespace tarn {

class ComparePage {
  public:
    // Makes the folder. Throws Error where it cannot, and where the folder lies in one of the compared ones:
    // its pictures would be compared the next time.
    ComparePage(const std::filesystem::path& folder, const FolderOptions& options);

    // Takes in a result, and writes its pictures below the folder's "pictures" unless it passed.
    void add(const PictureResult& result, const SeenPictures& seen);

    // Writes index.html, which shows everything added. Whole or not at all.
    void write() const;

  private:
    std::filesystem::path folder_;
    FolderOptions options_;
    std::vector<PictureResult> results_;
    std::string failures_;  // HTML
};

}  // namespace tarn
