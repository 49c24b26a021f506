// Settings whose frames are independent estimates.
#include "settings/settings.h"

namespace tarn {

RenderSettings fresh_settings(const RenderSettings& settings) {
    RenderSettings fresh = settings;
    fresh.denoise.mode = DenoiseMode::OFF;
    if (fresh.antialias.joins_frames()) fresh.antialias.mode = AntialiasMode::JITTER;
    if (fresh.direct.mode == DirectMode::RESTIR) {
        fresh.direct.mode = DirectMode::RIS;
        fresh.direct.brdf_candidate = true;
    }
    if (fresh.indirect.mode == IndirectMode::RESTIR) fresh.indirect.mode = IndirectMode::PATH;
    fresh.indirect.resolution = IndirectResolution::FULL;
    fresh.indirect.cache = IndirectCache::OFF;
    fresh.indirect.noise = NoiseKind::WHITE;
    return fresh;
}

}  // namespace tarn
