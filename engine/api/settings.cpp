// The table of settings, by name.
#include "tarn/settings.h"

#include <algorithm>
#include <cmath>

#include "api/guard.h"
#include "api/settings_access.h"
#include "core/error.h"

namespace tarn::api {

struct Settings::Values {
    RenderSettings settings;
};

namespace {

const Setting& find_row(const std::string& name) {
    const std::vector<Setting>& table = setting_table();
    const auto row =
        std::find_if(table.begin(), table.end(), [&](const Setting& s) { return s.name == name; });
    if (row == table.end()) throw tarn::Error("there is no setting '{}'", name);
    return *row;
}

// Messages of the engine name settings as the command line does.
std::string without_dashes(const std::string& message) {
    return message.starts_with("--") ? message.substr(2) : message;
}

}  // namespace

const RenderSettings& SettingsAccess::values(const Settings& settings) {
    return settings.values_->settings;
}

Settings::Settings() : values_(std::make_unique<Values>()) {}
Settings::Settings(const Settings& other) : values_(std::make_unique<Values>(*other.values_)) {}
Settings::Settings(Settings&& other) noexcept = default;
Settings& Settings::operator=(const Settings& other) {
    *this = Settings(other);
    return *this;
}
Settings& Settings::operator=(Settings&& other) noexcept = default;
Settings::~Settings() = default;

Settings Settings::preset(const std::string& name) {
    try {
        Settings result;
        result.values_->settings = find_preset(name).settings;
        return result;
    } catch (const tarn::Error& error) {
        throw Error(without_dashes(error.what()));
    }
}

Settings Settings::fresh() const {
    Settings result;
    result.values_->settings = fresh_settings(values_->settings);
    return result;
}

std::vector<SettingInfo> Settings::list() {
    std::vector<SettingInfo> list;
    for (const Setting& row : setting_table()) {
        list.push_back(
            {row.name, row.unit, row.sentence, row.minimum, row.maximum, row.is_whole, row.choices});
    }
    return list;
}

std::vector<PresetInfo> Settings::list_presets() {
    std::vector<PresetInfo> list;
    for (const Preset& preset : preset_table()) list.push_back({preset.name, preset.describe()});
    return list;
}

void Settings::set(const std::string& name, const std::string& value) {
    try {
        find_row(name).parse(values_->settings, value);
    } catch (const tarn::Error& error) {
        throw Error(without_dashes(error.what()));
    }
}

std::string Settings::get(const std::string& name) const {
    return guard([&] { return find_row(name).format(values_->settings); });
}

void Settings::set_number(const std::string& name, double value) {
    guard([&] {
        const Setting& row = find_row(name);
        if (!(value >= row.minimum && value <= row.maximum) || (row.is_whole && value != std::floor(value))) {
            throw tarn::Error("{}: {} is not a {}number from {} to {}", name, value,
                              row.is_whole ? "whole " : "", row.minimum, row.maximum);
        }
        row.set(values_->settings, value);
    });
}

double Settings::number(const std::string& name) const {
    return guard([&] { return find_row(name).get(values_->settings); });
}

bool Settings::applies(const std::string& name) const {
    return guard([&] {
        const Setting& row = find_row(name);
        return !row.applies || row.applies(values_->settings);
    });
}

}  // namespace tarn::api
