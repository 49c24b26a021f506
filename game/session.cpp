#include "session.h"

#include <fmt/format.h>

#include <system_error>

namespace game {

Engine open_engine(const Window* window, int threads) {
    EngineOptions options;
    if (window != nullptr) options.gl_loader = window->gl_loader();
    options.threads = threads;
    return Engine(options);
}

std::filesystem::path find_new_picture(const std::string& stem, const std::string& ending) {
    const std::filesystem::path folder = "out";
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure)
        throw Error(fmt::format("{}: the folder cannot be made: {}", folder.string(), failure.message()));
    for (int i = 1;; ++i) {
        const std::filesystem::path file = folder / fmt::format("{}_{:04}.{}", stem, i, ending);
        if (!std::filesystem::exists(file)) return file;
    }
}

}  // namespace game
