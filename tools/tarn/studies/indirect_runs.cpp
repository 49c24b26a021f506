#include "studies/indirect_runs.h"

#include <algorithm>

#include "find_truth.h"

namespace tarn {
namespace {

struct Frames {
    std::vector<Image> radiance;
    double indirect_ms = std::numeric_limits<double>::infinity();
};

Frames render_frames(Renderer& renderer, const StudySequence& sequence) {
    Frames result;
    render_sequence(renderer, sequence, [&](int, const FrameOutput& output, RenderSettings&) {
        double ms = 0.0;
        for (const PassTiming& pass : output.timings.passes) {
            if (pass.name.starts_with("indirect/")) ms += pass.ms;
        }
        result.indirect_ms = std::min(result.indirect_ms, ms);
        result.radiance.push_back(renderer.read_radiance(output.radiance));
    });
    return result;
}

}  // namespace

Image subtract(Image a, const Image& b) {
    for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] -= b.values[i];
    return a;
}

double mean_of(const Image& image) {
    return mean_value({image, image}, 0);
}

IndirectRun render_indirect_run(Renderer& renderer, const StudySequence& sequence) {
    StudySequence direct_sequence = sequence;
    direct_sequence.settings.indirect.mode = IndirectMode::OFF;
    const Frames direct = render_frames(renderer, direct_sequence);
    Frames both = render_frames(renderer, sequence);
    IndirectRun run;
    run.indirect_ms = both.indirect_ms;
    for (std::size_t i = 0; i < both.radiance.size(); ++i) {
        run.frames.push_back(subtract(std::move(both.radiance[i]), direct.radiance[i]));
    }
    return run;
}

IndirectReferences::IndirectReferences(RenderSession& session, const SceneOptions& scene, int spp)
    : session_(session), scene_(scene), spp_(spp), direct_(render(1)) {}

Image IndirectReferences::render(int bounces) {
    const CameraRecord camera = choose_camera(scene_, session_.loaded().scene, session_.loaded().world);
    return find_reference(session_, truth_settings(scene_.width, scene_.height, camera, spp_, bounces))
        .radiance;
}

}  // namespace tarn
