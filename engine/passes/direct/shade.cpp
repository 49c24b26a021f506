#include "passes/direct/shade.h"

#include "shared/interface/bindings.h"

namespace tarn {

DirectShadePass::DirectShadePass(ProgramLibrary& programs, int width_px, int height_px)
    : programs_(programs),
      width_px_(width_px),
      height_px_(height_px),
      radiance_("direct/radiance", width_px, height_px, GL_RGBA32F) {}

const Program& DirectShadePass::prepare(const DirectFrame& direct, std::vector<std::string> defines,
                                        bool first) {
    defines.insert(defines.begin(), direct.defines.begin(), direct.defines.end());
    if (!first) defines.emplace_back("TARN_ADD");
    if (direct.settings.per_channel) defines.emplace_back("TARN_ONE_CHANNEL");
    if (direct.settings.debug_view == DebugView::VISIBILITY) defines.emplace_back("TARN_SHOW_VISIBILITY");
    if (direct.settings.debug_view == DebugView::UNSHADOWED) defines.emplace_back("TARN_SHOW_UNSHADOWED");
    if (direct.settings.debug_view == DebugView::SAMPLES) defines.emplace_back("TARN_SHOW_SAMPLES");
    const Program& program = programs_.compute("direct/shade", defines);
    program.set("target_weights", direct.target_weights);
    program.set("share", 1.0f / float(direct.settings.sample_count()));
    return program;
}

void DirectShadePass::record(const DirectFrame& direct, const RowBuffer& reservoirs, const RowBuffer* answers,
                             bool first) {
    std::vector<std::string> defines;
    if (answers == nullptr) defines.emplace_back("TARN_RESERVOIR_VISIBILITY");
    const Program& program = prepare(direct, std::move(defines), first);
    PassRecorder pass = direct.frame.pass("direct/shade");
    read_gbuffer(pass, direct.gbuffer).read(UNIT_PASS_A, reservoirs);
    if (answers != nullptr) pass.read(UNIT_PASS_B, *answers);
    pass.write_image(0, radiance_)
        .count(BLOCK_COUNTERS, direct.counters)
        .dispatch(program, width_px_, height_px_);
}

void DirectShadePass::record(const DirectFrame& direct, const Texture2D& light, bool first) {
    const Program& program = prepare(direct, {"TARN_SHADED"}, first);
    PassRecorder pass = direct.frame.pass("direct/shade");
    read_gbuffer(pass, direct.gbuffer)
        .read(UNIT_PASS_A, light)
        .write_image(0, radiance_)
        .count(BLOCK_COUNTERS, direct.counters)
        .dispatch(program, width_px_, height_px_);
}

}  // namespace tarn
