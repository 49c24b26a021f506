#include "passes/enlarge.h"

#include "shared/interface/bindings.h"

namespace tarn {

Picture enlarge(const FrameContext& frame, const Picture& picture) {
    if (frame.output_px == frame.size_px) return picture;
    const Picture large = frame.recorder.take_picture("enlarge", frame.output_px, GL_RGBA32F);
    frame.pass("enlarge")
        .read(UNIT_PASS_A, picture)
        .write_image(0, *large)
        .dispatch(frame.compute(EnlargeVariant{}), frame.output_px);
    return large;
}

}  // namespace tarn
