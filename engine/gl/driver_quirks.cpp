#include "gl/driver_quirks.h"

#include <cstdlib>
#include <map>
#include <sstream>
#include <string>

#include "core/error.h"

namespace tarn {

DriverQuirks find_driver_quirks(const DeviceInfo& device) {
    DriverQuirks quirks{device.is_software, device.is_software, device.is_software};
    const std::map<std::string, bool*> by_name = {
        {"timestamps_at_submission", &quirks.timestamps_at_submission},
        {"groups_are_rows", &quirks.groups_are_rows},
        {"slow_triangles", &quirks.slow_triangles},
    };
    const char* overrides = std::getenv("TARN_QUIRKS");
    std::istringstream list(overrides != nullptr ? overrides : "");
    for (std::string word; std::getline(list, word, ',');) {
        const bool value = word.empty() || word[0] != '-';
        const auto found = by_name.find(value ? word : word.substr(1));
        if (found == by_name.end()) throw Error("TARN_QUIRKS: '{}' is no quirk", word);
        *found->second = value;
    }
    return quirks;
}

}  // namespace tarn
