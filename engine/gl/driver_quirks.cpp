#include "gl/driver_quirks.h"

#include <cstdlib>
#include <sstream>
#include <string>

#include "core/error.h"

namespace tarn {

DriverQuirks find_driver_quirks(const DeviceInfo& device) {
    DriverQuirks quirks;
    quirks.timestamps_at_submission = device.is_software;
    const char* overrides = std::getenv("TARN_QUIRKS");
    std::istringstream list(overrides != nullptr ? overrides : "");
    for (std::string word; std::getline(list, word, ',');) {
        const bool value = word.empty() || word[0] != '-';
        const std::string name = value ? word : word.substr(1);
        if (name != "timestamps_at_submission") throw Error("TARN_QUIRKS: '{}' is no quirk", name);
        quirks.timestamps_at_submission = value;
    }
    return quirks;
}

}  // namespace tarn
