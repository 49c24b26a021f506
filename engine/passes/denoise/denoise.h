// The denoiser: between the light of all stages and the picture. Shaders: passes/denoise.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "frame/history.h"
#include "passes/gbuffer.h"
#include "passes/reflected_light.h"

namespace tarn {

// What the denoiser keeps for the next frame, RGBA32F. Layers: shaders/lib/denoise/pictures.glsl.
struct DenoiseImages {
    explicit DenoiseImages(const glm::ivec2& size_px);

    TextureArray stack;
    std::vector<Texture2D> layers;
};

// By which rules: light of other rules is no history.
struct DenoiseMeaning {
    DenoiseMode mode = DenoiseMode::OFF;
    bool indirect = false;

    bool operator==(const DenoiseMeaning&) const = default;
};

struct KeptLight {
    std::shared_ptr<DenoiseImages> images;
    DenoiseMeaning meaning;
};

struct NoisyLight {
    ReflectedLight direct;
    ReflectedLight indirect;
    Picture changes;
};

class Denoiser {
  public:
    // The light of both stages as one, denoised: diffuse without its albedo, specular as it is. `indirect`:
    // none where the plan has none. `changes`: find_light_changes, or none. `previous`: what the last frame
    // kept. Fills `kept`, what the next one finds.
    ReflectedLight record(const FrameContext& frame, const GBuffer& gbuffer, const NoisyLight& noisy,
                          const std::optional<Previous<KeptLight>>& previous, KeptLight& kept);

  private:
    Pool<DenoiseImages> images_;
};

DenoiseMeaning denoise_meaning(const FramePlan& plan);

}  // namespace tarn
