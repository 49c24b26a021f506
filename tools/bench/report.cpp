#include "bench/report.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "bench/results.h"
#include "bench/work_folder.h"
#include "core/data_files.h"
#include "core/error.h"
#include "image_io/file.h"
#include "image_io/image_io.h"

namespace tarn {
namespace {

using Json = nlohmann::ordered_json;

std::string load_text(const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = load_file(file);
    return {bytes.begin(), bytes.end()};
}

std::string encode_base64(const std::vector<unsigned char>& bytes) {
    static constexpr char DIGITS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? DIGITS[bits >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

// Half floats, little-endian, as the page reads them: a tenth of a per cent is enough for a readout.
std::string encode_radiance(const Image& image) {
    std::vector<unsigned char> bytes;
    bytes.reserve(2 * image.values.size());
    for (const float value : image.values) {
        const std::uint16_t half = glm::packHalf1x16(value);
        bytes.push_back(static_cast<unsigned char>(half & 0xffu));
        bytes.push_back(static_cast<unsigned char>(half >> 8));
    }
    return encode_base64(bytes);
}

std::string encode_picture(const std::filesystem::path& file) {
    if (file.extension() == ".exr") return encode_radiance(read_radiance(file));
    const std::string type = file.extension() == ".mp4" ? "video/mp4" : "image/png";
    return "data:" + type + ";base64," + encode_base64(load_file(file));
}

// Adds every file that an object "pictures" names, wherever it stands.
void collect_pictures(const Json& json, const std::filesystem::path& folder, const std::string& prefix,
                      Json& pictures) {
    if (json.is_array()) {
        for (const Json& item : json) collect_pictures(item, folder, prefix, pictures);
        return;
    }
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items()) {
        if (key != "pictures") {
            collect_pictures(value, folder, prefix, pictures);
            continue;
        }
        for (const Json& name : value) {
            const std::string file = name.get<std::string>();
            pictures[prefix + file] = encode_picture(folder / file);
        }
    }
}

// JSON inside of <script>: no tag may end it.
std::string embed(const Json& json) {
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
    for (const char c : text) safe += c == '<' ? "\\u003c" : std::string(1, c);
    return safe;
}

std::filesystem::path find_parts() {
    constexpr DataFolder REPORT = {"report", "TARN_REPORT_DIR", TARN_REPORT_DIR};
    return locate_data_file(REPORT, "page.html").parent_path();
}

// The library that draws the plots: an installed Tarn has a copy of its own.
std::filesystem::path find_chart_library(const std::filesystem::path& parts) {
    const std::filesystem::path own = parts / "lib" / "chart.min.js";
    return std::filesystem::exists(own) ? own : TARN_CHART_JS;
}

std::string join_scripts(const std::filesystem::path& parts) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(parts)) {
        if (entry.path().extension() == ".js") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::string text;
    for (const std::filesystem::path& file : files) text += load_text(file);
    return text;
}

// Replaces the one "@NAME@" of the page.
void fill(std::string& page, const std::string& name, const std::string& text) {
    const std::string place = "@" + name + "@";
    const std::size_t at = page.find(place);
    if (at == std::string::npos) throw Error("the report's page.html has no {}", place);
    page.replace(at, place.size(), text);
}

}  // namespace

ReportInput load_results(const std::filesystem::path& file_or_folder) {
    const bool is_folder = std::filesystem::is_directory(file_or_folder);
    const std::filesystem::path file = is_folder ? file_or_folder / "results.json" : file_or_folder;
    ReportInput input{Json::parse(load_text(file), nullptr, false), file.parent_path()};
    const Json& results = input.results;
    if (!results.is_object() || results.value("format", "") != RESULTS_FORMAT) {
        throw Error("{}: is not a results.json of tarn", file.string());
    }
    const int version = results.value("version", 0);
    if (version != RESULTS_VERSION) {
        throw Error("{}: has version {}, this program reads version {}", file.string(), version,
                    RESULTS_VERSION);
    }
    return input;
}

void write_report(const std::filesystem::path& file, const std::vector<ReportInput>& inputs) {
    const std::filesystem::path parts = find_parts();
    Json documents = Json::array(), pictures = Json::object();
    for (const ReportInput& input : inputs) {
        collect_pictures(input.results, input.folder, fmt::format("{}/", documents.size()), pictures);
        documents.push_back(input.results);
    }
    std::string page = load_text(parts / "page.html");
    // From the end of the page to its beginning: what was filled in is never searched.
    fill(page, "PAGE_JS", join_scripts(parts));
    fill(page, "CHART_JS", load_text(find_chart_library(parts)));
    fill(page, "PICTURES_JSON", embed(pictures));
    fill(page, "RESULTS_JSON", embed(documents));
    fill(page, "PAGE_CSS", load_text(parts / "page.css"));
    write_file(file, page);
}

std::string load_page_part(const std::string& name) {
    return load_text(find_parts() / name);
}

}  // namespace tarn
