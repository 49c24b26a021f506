#include "find_truth.h"

#include "bench/reference_cache.h"
#include "core/error.h"
#include "interrupt.h"
#include "silhouettes.h"

namespace tarn {
namespace {

// Far from the seeds that methods get: the reference must share no random numbers with what it judges.
constexpr std::uint32_t REFERENCE_SEED = 0x5eed0001u;

}  // namespace

ReferenceSettings truth_settings(int width_px, int height_px, const CameraRecord& camera, int spp,
                                 int bounces) {
    ReferenceSettings settings;
    settings.width = width_px;
    settings.height = height_px;
    settings.camera = camera;
    settings.bounces = bounces;
    settings.light_tree = true;
    settings.spp = std::uint64_t(spp);
    settings.seed = REFERENCE_SEED;
    settings.cancel = &interrupt_flag();
    return settings;
}

ReferenceResult find_reference(RenderSession& session, const ReferenceSettings& settings) {
    return ReferenceCache(default_cache_folder()).get(session.loaded().world, session.tracer(), settings);
}

Truth find_truth(RenderSession& session, const RenderOptions& options, const ReferenceSettings& settings) {
    const ReferenceResult reference = find_reference(session, settings);
    if (reference.cancelled) throw Error("interrupted while the reference was rendered");
    FrameInput input;
    input.camera = settings.camera;
    return make_truth(reference, find_silhouettes(session.renderer(), session.tracer(), input),
                      options.exposure_ev);
}

}  // namespace tarn
