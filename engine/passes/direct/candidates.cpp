#include "passes/direct/candidates.h"

#include "shared/interface/bindings.h"
#include "shared/interface/records.h"
#include "shared/math/reservoir.h"

namespace tarn {
namespace {

const char* selection_define(LightSelection selection) {
    switch (selection) {
        case LightSelection::UNIFORM:
            return "TARN_SELECT_UNIFORM";
        case LightSelection::POWER:
            return "TARN_SELECT_POWER";
        case LightSelection::TILES:
            return "TARN_SELECT_TILES";
        case LightSelection::TREE:
            return "TARN_SELECT_TREE";
    }
    return "";
}

}  // namespace

DirectCandidatesPass::DirectCandidatesPass(ProgramLibrary& programs, int width_px, int height_px)
    : programs_(programs),
      width_px_(width_px),
      height_px_(height_px),
      reservoirs_(make_pixel_rows("direct/fresh", width_px, height_px, RESERVOIR_ROWS, BufferUse::DEVICE)),
      rays_(make_pixel_rows("direct/fresh_rays", width_px, height_px, RAY_ROWS, BufferUse::SHARED)) {}

Candidates DirectCandidatesPass::record(const DirectFrame& direct, const CandidateSources& sources) {
    std::vector<std::string> defines = direct.defines;
    defines.emplace_back(selection_define(direct.settings.selection()));
    if (sources.brdf_hits != nullptr) defines.emplace_back("TARN_BRDF_CANDIDATE");
    const Program& program = programs_.compute("direct/candidates", defines);
    program.set("candidate_count", unsigned(direct.settings.resamples() ? direct.settings.candidates : 1));
    program.set("sample_index", direct.sample);
    program.set("target_weights", direct.target_weights);
    PassRecorder pass = direct.frame.pass("direct/candidates");
    if (sources.tiles != nullptr) pass.read(UNIT_PASS_A, *sources.tiles);
    if (sources.brdf_hits != nullptr) pass.read(UNIT_PASS_B, *sources.brdf_hits);
    // Uploaded by the CPU, as the scene's other tables.
    if (sources.tree != nullptr) sources.tree->texture().bind(UNIT_PASS_C);
    read_gbuffer(pass, direct.gbuffer)
        .write(0, reservoirs_)
        .write(1, rays_)
        .count(BLOCK_COUNTERS, direct.counters)
        .dispatch(program, width_px_, height_px_);
    return {reservoirs_, rays_.buffer()};
}

InitialVisibilityPass::InitialVisibilityPass(ProgramLibrary& programs, int width_px, int height_px)
    : programs_(programs), width_px_(width_px), height_px_(height_px) {}

void InitialVisibilityPass::record(const DirectFrame& direct, const Candidates& candidates,
                                   const RowBuffer& answers) {
    const Program& program = programs_.compute("direct/initial_visibility", direct.defines);
    const DirectSettings& settings = direct.settings;
    program.set("discard_occluded", settings.discard_occluded || settings.traces_in_mis() ? 1u : 0u);
    direct.frame.pass("direct/initial_visibility")
        .read(UNIT_PASS_A, answers)
        .write(0, candidates.reservoirs)
        .dispatch(program, width_px_, height_px_);
}

}  // namespace tarn
