// Makes rows of the settings table for the settings of one stage.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "settings/settings.h"

namespace tarn {

// `Part` finds the stage's struct in RenderSettings, const or not. Rows are added to `table` in the order of
// the calls; the names of a stage that has siblings begin with `prefix`.
template <class Part>
class SettingRows {
  public:
    using Stage = std::remove_reference_t<std::invoke_result_t<Part, RenderSettings&>>;
    using Applies = std::function<bool(const RenderSettings&)>;

    SettingRows(std::vector<Setting>& table, std::string prefix)
        : table_(table), prefix_(std::move(prefix)) {}

    // The following rows change something where `applies` holds of the stage; null: always.
    SettingRows& where(bool (Stage::*applies)() const) {
        applies_ = [applies](const RenderSettings& s) { return (Part()(s).*applies)(); };
        return *this;
    }
    SettingRows& where(Applies applies) {
        applies_ = std::move(applies);
        return *this;
    }

    // A choice: `member` is an enumeration whose values count `choices`, or a bool for off and on.
    template <class T>
    SettingRows& choose(const std::string& name, std::string sentence, T Stage::*member,
                        std::vector<std::string> choices) {
        const double last = double(choices.size() - 1);
        table_.push_back({prefix_ + name, "", std::move(sentence), 0.0, last, std::move(choices), true,
                          [member](const RenderSettings& s) { return double(Part()(s).*member); },
                          [member](RenderSettings& s, double v) { Part()(s).*member = T(int(v)); },
                          applies_});
        return *this;
    }

    SettingRows& toggle(const std::string& name, std::string sentence, bool Stage::*member) {
        return choose(name, std::move(sentence), member, {"off", "on"});
    }

    // A number of type T, whole where T is.
    template <class T>
    SettingRows& number(const std::string& name, std::string unit, std::string sentence, T Stage::*member,
                        double minimum, double maximum) {
        table_.push_back({prefix_ + name,
                          std::move(unit),
                          std::move(sentence),
                          minimum,
                          maximum,
                          {},
                          std::is_integral_v<T>,
                          [member](const RenderSettings& s) { return double(Part()(s).*member); },
                          [member](RenderSettings& s, double v) { Part()(s).*member = T(v); },
                          applies_});
        return *this;
    }

  private:
    std::vector<Setting>& table_;
    std::string prefix_;
    Applies applies_;
};

}  // namespace tarn
