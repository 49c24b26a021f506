#include "compare_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <map>
#include <set>

#include "compare_pair.h"
#include "core/error.h"

namespace tarn {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& letter : extension) letter = char(std::tolower(static_cast<unsigned char>(letter)));
    return extension == ".exr" || extension == ".hdr" || extension == ".png";
}

// The pictures below a folder, by their paths in it. A link that leads nowhere is one too: it shall not go
// unseen.
std::set<std::string> list_pictures(const fs::path& folder) {
    std::error_code failure;
    std::set<std::string> names;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::follow_directory_symlink, failure);
    for (; !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure)) {
        std::error_code ignored;
        if (is_picture(entry->path()) && !entry->is_directory(ignored))
            names.insert(entry->path().lexically_relative(folder).generic_string());
    }
    if (failure) throw Error("{}: the folder cannot be read: {}", folder.string(), failure.message());
    if (names.empty()) throw Error("{}: holds no picture (.exr, .hdr, .png)", folder.string());
    return names;
}

std::string without_extension(const std::string& name) {
    return fs::path(name).replace_extension().generic_string();
}

// Of pictures that have no golden of their own name: the first of each name without its ending.
std::map<std::string, std::string> find_unmatched(const std::set<std::string>& goldens,
                                                  const std::set<std::string>& actual) {
    std::map<std::string, std::string> unmatched;
    for (const std::string& name : actual) {
        if (!goldens.contains(name)) unmatched.emplace(without_extension(name), name);
    }
    return unmatched;
}

// A limit that a picture cannot have would be a failure that nobody can mend.
void check_limits_apply(const FolderOptions& options, const std::set<std::string>& goldens) {
    const auto png =
        std::find_if(goldens.begin(), goldens.end(), [](const auto& name) { return is_png(name); });
    if (png == goldens.end()) return;
    for (const Limit& limit : options.limits) {
        if (limit.key != "flip_hdr") continue;
        throw Error("flip_hdr has a limit and is not measured for PNGs such as {}: flip is for both kinds",
                    (options.goldens / *png).string());
    }
}

// Returns what went wrong, or nothing.
std::string try_to_load(const fs::path& path, SeenPicture& seen) {
    try {
        seen.is_radiance = !is_png(path);
        seen.image = load_picture(path);
        return "";
    } catch (const Error& error) {
        return error.what();
    } catch (const std::exception& error) {  // such as memory too short for what a header claims
        return fmt::format("{}: {}", path.string(), error.what());
    }
}

std::string join_breaches(const std::vector<Breach>& breaches) {
    std::vector<std::string> texts;
    for (const Breach& breach : breaches) texts.push_back(describe_breach(breach));
    return fmt::format("{}", fmt::join(texts, "; "));
}

void measure(const FolderOptions& options, SeenPictures& seen, PictureResult& result) {
    try {
        Pair pair = prepare_pair(seen.expected.image, seen.actual.image, seen.expected.is_radiance,
                                 options.exposure_ev);
        Comparison comparison = compare_pair(pair);
        seen.flip_map = std::move(comparison.flip_map);
        result.measured = describe_comparison(pair, comparison);
        result.breaches = find_breaches(result.measured, options.limits);
        if (result.breaches.empty()) return;
        result.message = join_breaches(result.breaches);
    } catch (const std::exception& error) {
        result.message = error.what();
    }
    result.verdict = Verdict::FAILED;
}

void judge_contents(const FolderOptions& options, const std::string& expected_error,
                    const std::string& actual_error, SeenPictures& seen, PictureResult& result) {
    const Image& expected = seen.expected.image;
    const Image& actual = seen.actual.image;
    if (!expected_error.empty() || !actual_error.empty()) {
        result.verdict = Verdict::UNREADABLE;
        result.message = !expected_error.empty() ? expected_error : actual_error;
    } else if (expected.width != actual.width || expected.height != actual.height) {
        result.verdict = Verdict::OTHER_SIZE;
        result.message = fmt::format("{} x {} pixels, expected are {} x {}", actual.width, actual.height,
                                     expected.width, expected.height);
    } else {
        measure(options, seen, result);
    }
}

}  // namespace

const char* verdict_name(Verdict verdict) {
    static constexpr const char* NAMES[] = {"passed",     "failed",     "missing",   "extra",
                                            "other size", "other kind", "unreadable"};
    return NAMES[std::size_t(verdict)];
}

const std::vector<Limit>& default_limits() {
    static const std::vector<Limit> limits = {
        {"flip", 0.01, true}, {"flip_tile", 0.1, true}, {"non_finite", 0.0, true}};
    return limits;
}

void check_folders(const FolderOptions& options) {
    const auto is_within = [](const fs::path& inner, const fs::path& outer) {
        const auto at = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first;
        return at == outer.end();
    };
    const fs::path goldens = fs::canonical(options.goldens), actual = fs::canonical(options.actual);
    if (goldens == actual) throw Error("{}: is compared with itself", options.goldens.string());
    if (!is_within(goldens, actual) && !is_within(actual, goldens)) return;
    throw Error("{} and {}: one folder lies within the other", options.goldens.string(),
                options.actual.string());
}

std::vector<PictureCase> find_cases(const FolderOptions& options) {
    const std::set<std::string> goldens = list_pictures(options.goldens);
    const std::set<std::string> actual = list_pictures(options.actual);
    check_limits_apply(options, goldens);
    const auto unmatched = find_unmatched(goldens, actual);
    std::map<std::string, PictureCase> cases;
    std::set<std::string> taken;
    for (const std::string& name : goldens) {
        const auto other = unmatched.find(without_extension(name));
        if (actual.contains(name)) {
            cases[name] = {name, name, Verdict::PASSED};
        } else if (other != unmatched.end() && taken.insert(other->second).second) {
            cases[name] = {name, other->second, Verdict::OTHER_KIND};
        } else {
            cases[name] = {name, "", Verdict::MISSING};
        }
    }
    for (const std::string& name : actual) {
        if (!goldens.contains(name) && !taken.contains(name)) cases[name] = {name, name, Verdict::EXTRA};
    }
    std::vector<PictureCase> sorted;
    for (auto& [name, picture] : cases) sorted.push_back(std::move(picture));
    return sorted;
}

PictureResult judge_case(const FolderOptions& options, const PictureCase& picture, SeenPictures& seen) {
    const auto start = std::chrono::steady_clock::now();
    PictureResult result;
    result.name = picture.name;
    result.verdict = picture.verdict;
    std::string expected_error, actual_error;
    if (picture.verdict != Verdict::EXTRA)
        expected_error = try_to_load(options.goldens / picture.name, seen.expected);
    if (picture.verdict != Verdict::MISSING)
        actual_error = try_to_load(options.actual / picture.actual_name, seen.actual);
    switch (picture.verdict) {
        case Verdict::MISSING:
            result.message = fmt::format("{}: no such picture", (options.actual / picture.name).string());
            break;
        case Verdict::EXTRA:
            result.message = fmt::format("{}: no such golden", (options.goldens / picture.name).string());
            break;
        case Verdict::OTHER_KIND:
            result.message = fmt::format("there is {} instead", picture.actual_name);
            break;
        default:
            judge_contents(options, expected_error, actual_error, seen, result);
    }
    result.time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace tarn
