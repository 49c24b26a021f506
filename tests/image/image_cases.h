// Which pictures have goldens: generated scenes, cameras, modes, frames, exposures and tolerances.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "image/image_compare.h"
#include "settings/settings.h"

namespace tarn::test {

constexpr int GOLDEN_WIDTH_PX = 160;
constexpr int GOLDEN_HEIGHT_PX = 90;

// Frames of one scene, camera and method, rendered one after the other from frame 0; some of them have
// goldens.
struct ImageSequence {
    std::string scene;
    std::string camera;
    std::string method;        // a choice of --direct or a preset; "reference": the path tracer, all bounces
    float exposure_ev = 0.0f;  // fixed, so that a picture that is too bright as a whole differs too
    std::vector<int> frames;   // 1 is the first; frame N is rendered after the N - 1 before it
    ImageTolerance tolerance;

    // "cornell_main_ris"; the goldens add "_frame16".
    std::string name() const;
    bool is_reference() const { return method == "reference"; }
    std::string golden_name(int frame) const;
};

const std::vector<ImageSequence>& image_sequences();

// The goldens of the checkout: tests/image/goldens/NAME.png.
std::filesystem::path golden_file(const std::string& golden_name);

// Receives each picture that has a golden, display-encoded.
using ImageSink = std::function<void(const std::string& golden_name, const Image& display)>;

// Renders a sequence; needs a current GL context. `planted`: defines of planted bugs.
void render_sequence(const ImageSequence& sequence, const ImageSink& sink,
                     const std::vector<std::string>& planted = {});

}  // namespace tarn::test
