// Opens a report in a headless browser and reads the page's own verdict.
#pragma once

#include <optional>
#include <string>

#include "support/process.h"

namespace tarn::test {

// The first browser that is installed.
inline std::optional<std::string> find_browser() {
    for (const char* name : {"chromium-headless-shell", "chromium"}) {
        if (run_process({"sh", "-c", std::string("command -v ") + name}).status == 0) return name;
    }
    return std::nullopt;
}

inline std::vector<std::string> browser_arguments(const std::string& browser, int width_px) {
    std::vector<std::string> arguments = {browser,
                                          "--no-sandbox",
                                          "--disable-gpu",
                                          "--hide-scrollbars",
                                          "--virtual-time-budget=60000",
                                          "--window-size=" + std::to_string(width_px) + ",2400"};
    if (browser == "chromium") arguments.push_back("--headless");
    return arguments;
}

// "passed", or "failed: ..." as the page says with ?selftest; "silent" where it says nothing.
inline std::string run_page_selftest(const std::string& browser, const std::filesystem::path& page,
                                     int width_px) {
    auto arguments = browser_arguments(browser, width_px);
    arguments.insert(arguments.end(), {"--dump-dom", "file://" + page.string() + "?selftest"});
    const std::string dom = run_process(arguments).out, mark = "data-selftest=\"";
    const std::size_t at = dom.find(mark);
    if (at == std::string::npos) return "silent";
    return dom.substr(at + mark.size(), dom.find('"', at + mark.size()) - at - mark.size());
}

// A picture of the page, to be looked at by a person.
inline void take_screenshot(const std::string& browser, const std::filesystem::path& page, int width_px,
                            const std::filesystem::path& picture) {
    auto arguments = browser_arguments(browser, width_px);
    arguments.insert(arguments.end(), {"--screenshot=" + picture.string(), "file://" + page.string()});
    run_process(arguments);
}

}  // namespace tarn::test
