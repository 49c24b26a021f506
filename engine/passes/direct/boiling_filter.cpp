#include "passes/direct/boiling_filter.h"

#include "shared/interface/bindings.h"

namespace tarn {

BoilingFilterPass::BoilingFilterPass(ProgramLibrary& programs, int width_px, int height_px)
    : programs_(programs), width_px_(width_px), height_px_(height_px) {}

void BoilingFilterPass::record(const DirectFrame& direct, const RowBuffer& reservoirs) {
    const Program& program = programs_.compute("direct/boiling_filter", direct.defines);
    program.set("limit", float(direct.settings.boiling_filter));
    direct.frame.pass("direct/boiling_filter")
        .read(UNIT_PASS_A, reservoirs)
        .write(0, reservoirs)
        .dispatch(program, width_px_, height_px_);
}

}  // namespace tarn
