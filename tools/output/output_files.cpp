#include "output/output_files.h"

#include <fstream>

#include "core/error.h"
#include "core/version.h"
#include "image_io/file.h"

namespace tarn {

void create_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw Error("{}: the folder cannot be made: {}", folder.string(), error.message());
}

void check_output_folder(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!file.empty() && !std::filesystem::is_directory(folder)) {
        throw Error("{}: the folder {} does not exist", file.string(), folder.string());
    }
}

void write_file(const std::filesystem::path& file, std::string_view bytes) {
    write_whole(file, [&](const std::string& temporary) {
        std::ofstream stream(temporary, std::ios::binary);
        stream << bytes;
        if (!stream.flush()) throw Error("{}: cannot be written", file.string());
    });
}

nlohmann::ordered_json describe_build() {
    return {{"version", VERSION}, {"commit", COMMIT}, {"build_type", BUILD_TYPE}};
}

void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json) {
    nlohmann::ordered_json complete = json;
    if (complete.is_object() && !complete.contains("tarn")) complete["tarn"] = describe_build();
    write_file(file, complete.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace tarn
