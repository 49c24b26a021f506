#include "passes/glare.h"

#include <vector>

#include "shared/interface/bindings.h"
#include "shared/math/glare.h"

namespace tarn {
namespace {

Picture take_glare(const FrameContext& frame, const glm::ivec2& size_px) {
    return frame.recorder.take_picture("glare", size_px, GL_RGBA32F);
}

glm::ivec2 size_of(const Picture& picture) {
    return {picture->width_px(), picture->height_px()};
}

// From wide to narrow; the picture itself is not among them.
std::vector<Picture> build_pyramid(const FrameContext& frame, const Picture& radiance,
                                   const Exposure& exposure) {
    std::vector<Picture> levels;
    Picture large = radiance;
    const int count = count_glare_levels(radiance->width_px(), radiance->height_px());
    for (int level = 0; level < count; ++level) {
        const glm::ivec2 size_px(halve_size(large->width_px()), halve_size(large->height_px()));
        levels.push_back(take_glare(frame, size_px));
        const bool is_first = level == 0;
        PassRecorder pass = frame.pass("glare/down");
        pass.read(UNIT_PASS_A, large).write_image(0, *levels.back());
        if (is_first) pass.read(UNIT_PASS_B, exposure);
        pass.dispatch(frame.compute(GlareDownVariant{is_first}), size_px);
        large = levels.back();
    }
    return levels;
}

}  // namespace

Picture spread_glare(const FrameContext& frame, const Picture& radiance, const Exposure& exposure) {
    const std::vector<Picture> levels = build_pyramid(frame, radiance, exposure);
    Picture sum = levels.back();
    for (std::size_t level = levels.size() - 1; level-- > 0;) {
        const Picture wider = sum;
        sum = take_glare(frame, size_of(levels[level]));
        frame.pass("glare/up")
            .read(UNIT_PASS_A, levels[level])
            .read(UNIT_PASS_B, wider)
            .write_image(0, *sum)
            .dispatch(frame.compute(GlareUpVariant{}), size_of(sum));
    }
    return sum;
}

}  // namespace tarn
