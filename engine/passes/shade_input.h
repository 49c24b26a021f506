// What the last step of a stage of light turns into light, alike for direct and indirect light.
#pragma once

#include "passes/reflected_light.h"
#include "passes/reuse/samples.h"
#include "passes/trace_rays.h"
#include "shared/interface/bindings.h"

namespace tarn {

// One of the first two with its visibility, or the sum that the last step of reuse made.
struct ShadeInput {
    const Samples* samples = nullptr;
    Answers answers;  // one a pixel, where the samples were traced after all reuse; null: what the reservoirs
                      // know
    ReflectedLight summed;
};

inline ShadeSource source_of(const ShadeInput& input) {
    if (input.summed) return ShadeSource::SUMMED;
    return input.answers ? ShadeSource::TRACED : ShadeSource::RESERVOIR;
}

inline void read_shade_input(PassRecorder& pass, const ShadeInput& input) {
    if (input.summed) {
        pass.read(UNIT_PASS_A, input.summed.diffuse).read(UNIT_PASS_B, input.summed.specular);
    } else {
        pass.read(UNIT_PASS_A, input.samples->reservoirs);
    }
    if (input.answers) pass.read(UNIT_PASS_B, input.answers);
}

// `adds`: to what is there already.
inline void write_light(PassRecorder& pass, const ReflectedLight& light, bool adds) {
    if (adds) {
        pass.read_write_image(0, *light.diffuse).read_write_image(1, *light.specular);
    } else {
        pass.write_image(0, *light.diffuse).write_image(1, *light.specular);
    }
}

}  // namespace tarn
