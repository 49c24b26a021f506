// The engine's own settings behind the public ones.
#pragma once

#include "settings/settings.h"
#include "tarn/settings.h"

namespace tarn::api {

struct SettingsAccess {
    static const RenderSettings& values(const Settings& settings);
};

}  // namespace tarn::api
