#include "compare_junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "markup.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array ALL_VERDICTS = {Verdict::PASSED,    Verdict::FAILED,     Verdict::MISSING,
                                     Verdict::EXTRA,     Verdict::OTHER_SIZE, Verdict::OTHER_KIND,
                                     Verdict::UNREADABLE};

std::size_t count_verdicts(const std::vector<PictureResult>& results, Verdict verdict) {
    return std::size_t(std::count_if(results.begin(), results.end(),
                                     [&](const PictureResult& result) { return result.verdict == verdict; }));
}

double total_time_s(const std::vector<PictureResult>& results) {
    double sum = 0.0;
    for (const PictureResult& result : results) sum += result.time_s;
    return sum;
}

// All that was measured, a line each.
std::string list_values(const Json& measured) {
    std::string lines;
    if (!measured.is_object()) return lines;
    for (const auto& [key, value] : measured.items()) lines += fmt::format("\n{} {}", key, value.dump());
    return lines;
}

std::string make_test_case(const PictureResult& result) {
    const std::string head =
        fmt::format("    <testcase classname=\"tarn.compare\" name=\"{}\" time=\"{:.3f}\"",
                    escape_markup(result.name), result.time_s);
    if (result.verdict == Verdict::PASSED) return head + "/>\n";
    const std::string verdict = verdict_name(result.verdict);
    const std::string message = escape_markup(verdict + ": " + result.message);
    return fmt::format("{}>\n      <failure type=\"{}\" message=\"{}\">{}{}</failure>\n    </testcase>\n",
                       head, verdict, message, message, list_values(result.measured));
}

Json describe_breaches(const std::vector<Breach>& breaches) {
    Json json = Json::array();
    for (const Breach& breach : breaches) {
        json.push_back({{"key", breach.limit.key},
                        {"value", breach.value},
                        {breach.limit.is_greatest ? "max" : "min", breach.limit.value}});
    }
    return json;
}

}  // namespace

std::string summarize(const std::vector<PictureResult>& results) {
    std::string text = fmt::format("{} picture{}", results.size(), results.size() == 1 ? "" : "s");
    const char* separator = ": ";
    for (const Verdict verdict : ALL_VERDICTS) {
        const std::size_t count = count_verdicts(results, verdict);
        if (count == 0 && verdict != Verdict::PASSED) continue;
        text += fmt::format("{}{} {}", separator, count, verdict_name(verdict));
        separator = ", ";
    }
    return text;
}

std::size_t count_failures(const std::vector<PictureResult>& results) {
    return results.size() - count_verdicts(results, Verdict::PASSED);
}

std::string make_junit(const FolderOptions& options, const std::vector<PictureResult>& results) {
    const std::string counts =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\" time=\"{:.3f}\"", results.size(),
                    count_failures(results), total_time_s(results));
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    xml += fmt::format("<testsuites name=\"tarn compare\" {}>\n", counts);
    xml += fmt::format("  <testsuite name=\"{}\" {}>\n", escape_markup(options.goldens.string()), counts);
    for (const PictureResult& result : results) xml += make_test_case(result);
    return xml + "  </testsuite>\n</testsuites>\n";
}

Json make_folder_json(const FolderOptions& options, const std::vector<PictureResult>& results) {
    Json limits = Json::array();
    for (const Limit& limit : options.limits)
        limits.push_back({{"key", limit.key}, {limit.is_greatest ? "max" : "min", limit.value}});
    Json counts = Json::object();
    for (const Verdict verdict : ALL_VERDICTS)
        counts[verdict_name(verdict)] = count_verdicts(results, verdict);
    Json pictures = Json::array();
    for (const PictureResult& result : results) {
        pictures.push_back({{"name", result.name},
                            {"verdict", verdict_name(result.verdict)},
                            {"message", result.message},
                            {"beyond", describe_breaches(result.breaches)},
                            {"measured", result.measured}});
    }
    return {{"goldens", options.goldens.string()},
            {"actual", options.actual.string()},
            {"limits", limits},
            {"counts", counts},
            {"pictures", pictures}};
}

}  // namespace tarn
