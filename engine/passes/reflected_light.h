// The light of a stage: what it reflects towards the viewer, base and layer apart.
#pragma once

#include <string>

#include "passes/frame_context.h"

namespace tarn {

// RGBA32F, W sr^-1 m^-2, of the size of the surfaces.
struct ReflectedLight {
    Picture diffuse;   // of the base, not yet multiplied by its albedo
    Picture specular;  // of the layer

    explicit operator bool() const { return bool(diffuse); }
};

// Memory for the light of stage `name`.
inline ReflectedLight take_reflected_light(const FrameContext& frame, const std::string& name) {
    return {frame.recorder.take_picture(name + "/diffuse", frame.size_px, GL_RGBA32F),
            frame.recorder.take_picture(name + "/specular", frame.size_px, GL_RGBA32F)};
}

}  // namespace tarn
