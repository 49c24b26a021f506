// The exposure: by the rule of shared/math/exposure.h from the counts of exposure/count, then part of the way there
// from the last frame's; or a fixed one.
#include "shared/dialect.h"
#include "shared/interface/bindings.h"
#include "shared/interface/constants/exposure.h"
#include "shared/math/exposure.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_PASS_A) uniform usamplerBuffer counts;  // [group][bin]
layout(binding = UNIT_PASS_B) uniform usamplerBuffer previous_exposure;
layout(std430, binding = 0) writeonly buffer Exposure { uvec4 out_exposure; };

const int LANES = 64;

shared uint bin_count[EXPOSURE_BINS];

float find_middle(uint total) {
    float sum = 0.0f;
    float weights = 0.0f;
    uint before = 0u;
    for (int bin = 0; bin < EXPOSURE_BINS; ++bin) {
        uint count = bin_count[bin];
        if (count == 0u) continue;
        float weight = count_in_middle_half(before, count, total);
        sum += weight * exposure_bin_middle(bin);
        weights += weight;
        before += count;
    }
    return sum / weights;
}

uint count_from(float stops) {
    uint count = 0u;
    for (int bin = EXPOSURE_BINS - 1; bin >= 0; --bin) {
        if (bin_count[bin] > 0u && exposure_bin_stops(bin) >= stops) count += bin_count[bin];
    }
    return count;
}

// The lowest top of a bin that no more than `allowed` pixels exceed.
float find_white(uint allowed) {
    uint above = 0u;
    int bin = EXPOSURE_BINS - 1;
    while (bin > 0 && above + bin_count[bin] <= allowed) {
        above += bin_count[bin];
        --bin;
    }
    return exposure_bin_stops(bin + 1);
}

float find_exposure_ev() {
    uint total = 0u;
    for (int bin = 0; bin < EXPOSURE_BINS; ++bin) total += bin_count[bin];
    if (total == 0u) return 0.0f;
    uint allowed = uint(float(total) * EXPOSURE_CLIPPED_SHARE);
    ExposureLevels levels;
    levels.middle = find_middle(total);
    uint lamps = count_from(levels.middle + EXPOSURE_LAMP_STOPS);
    levels.bright_share = float(count_from(find_bright_stops(levels.middle, tone))) / float(total);
    levels.white = find_white(allowed);
    levels.white_lit = find_white(allowed + lamps);
    return choose_exposure_ev(levels, tone);
}

void main() {
    int lane = int(gl_LocalInvocationIndex);
    for (int bin = lane; bin < EXPOSURE_BINS; bin += LANES) {
        uint count = 0u;
        if (is_fixed == 0u) {
            for (int group = 0; group < EXPOSURE_GROUPS; ++group) {
                count += texelFetch(counts, group * EXPOSURE_BINS + bin).x;
            }
        }
        bin_count[bin] = count;
    }
    barrier();
    if (lane != 0) return;
    float ev = fixed_ev;
    float scale = fixed_scale;
    if (is_fixed == 0u) {
        ev = find_exposure_ev();
        if (has_previous != 0u) {
            float previous_ev = uintBitsToFloat(texelFetch(previous_exposure, 0).y);
            ev = previous_ev + step_share * (ev - previous_ev);
        }
        scale = exp2(ev);
    }
    out_exposure = uvec4(floatBitsToUint(scale), floatBitsToUint(ev), 0u, 0u);
}
