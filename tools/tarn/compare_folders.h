// Pictures of a folder judged by the goldens of another one.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "verdict.h"

namespace tarn {

enum class Verdict { PASSED, FAILED, MISSING, EXTRA, OTHER_SIZE, OTHER_KIND, UNREADABLE };

// "passed", "failed", "missing", "extra", "other size", "other kind", "unreadable"
const char* verdict_name(Verdict verdict);

struct FolderOptions {
    std::filesystem::path goldens;
    std::filesystem::path actual;
    std::optional<float> exposure_ev;  // for radiance
    std::vector<Limit> limits;
};

// A picture of either folder, by its path in it.
struct PictureCase {
    std::string name;                   // of the golden; of the other picture where there is no golden
    std::string actual_name;            // another one where its kind differs
    Verdict verdict = Verdict::PASSED;  // as far as names alone decide
};

struct PictureResult {
    std::string name;
    Verdict verdict = Verdict::PASSED;
    std::string message;              // one line that says why; empty where it passed
    std::vector<Breach> breaches;     // where it failed
    nlohmann::ordered_json measured;  // describe_comparison, or null
    double time_s = 0.0;
};

// A picture as it was read; empty where there is none or it cannot be read.
struct SeenPicture {
    Image image;
    bool is_radiance = false;
};

struct SeenPictures {
    SeenPicture expected;
    SeenPicture actual;
    Image flip_map;  // empty where they were not compared
};

// What holds where the user sets no limit.
const std::vector<Limit>& default_limits();

// Throws Error where the folders are one, or one lies in the other: a picture would be golden and actual at
// once.
void check_folders(const FolderOptions& options);

// All pictures of both folders, sorted by name. Throws Error where a folder cannot be read or holds no
// picture, and where a limit is for a value that PNGs do not have and a golden is a PNG.
std::vector<PictureCase> find_cases(const FolderOptions& options);

// Reads and compares what there is. Nothing that is wrong with a picture is thrown.
PictureResult judge_case(const FolderOptions& options, const PictureCase& picture, SeenPictures& seen);

}  // namespace tarn
