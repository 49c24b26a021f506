// How a picture is rendered: the same presets and settings as the command line's.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace tarn::api {

// One setting: what it does and what it may be.
struct SettingInfo {
    std::string name;      // "candidates"
    std::string unit;      // "px", or "" where there is none
    std::string sentence;  // what it does
    double minimum = 0.0;  // of a number
    double maximum = 0.0;
    bool is_whole = true;              // a number without fraction
    std::vector<std::string> choices;  // of a choice; empty: it is a number
};

// A named set of settings.
struct PresetInfo {
    std::string name;      // "fast"
    std::string sentence;  // what it is for, and its bias
};

// A value for each setting. Cheap to copy.
class Settings {
  public:
    // Each at its default.
    Settings();
    Settings(const Settings& other);
    Settings(Settings&& other) noexcept;
    Settings& operator=(const Settings& other);
    Settings& operator=(Settings&& other) noexcept;
    ~Settings();

    // As a preset has them. Error for an unknown name, with those that exist.
    static Settings preset(const std::string& name);

    // The same light by an unbiased estimate that is fresh in every frame, without reuse or denoiser: for
    // means that converge (Frame::average).
    Settings fresh() const;

    static std::vector<SettingInfo> list();
    static std::vector<PresetInfo> list_presets();

    // Sets one, as a user writes it: a number or one of its choices. Error that names the setting and what it
    // accepts.
    void set(const std::string& name, const std::string& value);
    // As a user would write it. Error for an unknown name.
    std::string get(const std::string& name) const;

    // The same for widgets: a number as it is, a choice as its place in SettingInfo::choices. Error for an
    // unknown name, and for what the setting does not accept.
    void set_number(const std::string& name, double value);
    double number(const std::string& name) const;
    // Whether it changes anything beside the others. Error for an unknown name.
    bool applies(const std::string& name) const;

  private:
    friend struct SettingsAccess;
    struct Values;
    std::unique_ptr<Values> values_;
};

}  // namespace tarn::api
