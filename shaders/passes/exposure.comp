// Automatic exposure: the EV that maps the picture's log-average luminance to middle grey, over pixels that are finite
// and not black, without the darkest and the brightest 1 %; then part of the way there from the last frame's.
//
// One group looks at 64 x 64 places spread evenly over the picture. It counts them in a histogram by stops, in whole
// numbers: the order of the threads changes no bit. The rule is that of core/display.h.
#include "shared/interface/constants/exposure.h"
#include "shared/interface/bindings.h"
#include "shared/dialect.h"
#include "shared/math/colour.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = UNIT_PASS_A) uniform sampler2D radiance;
layout(binding = UNIT_PASS_B) uniform usamplerBuffer previous_exposure;
layout(std430, binding = 0) writeonly buffer Exposure { uvec4 out_exposure; };

const int GRID = 64;
const int BINS = 256;
const float STOPS_BELOW_ONE =
    64.0f;  // the first bin begins there; darker counts in it, as brighter in the last
const float BINS_PER_STOP = 2.0f;
const float FRACTION = 4096.0f;  // of a stop: the histogram's sums are whole numbers of it

shared uint bin_count[BINS];
shared int bin_sum[BINS];  // of log2 luminance

void count_place(ivec2 place) {
    ivec2 size_px = textureSize(radiance, 0);
    float light = luminance(texelFetch(radiance, place * size_px / GRID, 0).xyz);
    if (!(light > 0.0f) || !is_finite(light)) return;
    float stops = clamp(log2(light), -STOPS_BELOW_ONE, STOPS_BELOW_ONE - 0.01f);
    int bin = clamp(int((stops + STOPS_BELOW_ONE) * BINS_PER_STOP), 0, BINS - 1);
    atomicAdd(bin_count[bin], 1u);
    atomicAdd(bin_sum[bin], int(round(stops * FRACTION)));
}

// Mean of log2 luminance without `left_out` places at either end: of a bin that is partly left out, its own mean stays.
float find_mean_stops(uint total, uint left_out) {
    float sum = 0.0f;
    uint before = 0u;
    for (int bin = 0; bin < BINS; ++bin) {
        uint count = bin_count[bin];
        if (count == 0u) continue;
        uint from = max(before, left_out);
        uint to = min(before + count, total - left_out);
        float mean = float(bin_sum[bin]) / (FRACTION * float(count));
        if (to > from) sum += mean * float(to - from);
        before += count;
    }
    return sum / float(total - 2u * left_out);
}

float find_exposure_ev() {
    const float MIDDLE_GREY = 0.18f;
    const float LIMIT_EV = 20.0f;
    uint total = 0u;
    for (int bin = 0; bin < BINS; ++bin) total += bin_count[bin];
    if (total == 0u) return 0.0f;
    return clamp(log2(MIDDLE_GREY) - find_mean_stops(total, total / 100u), -LIMIT_EV, LIMIT_EV);
}

void main() {
    int lane = int(gl_LocalInvocationIndex);
    for (int bin = lane; bin < BINS; bin += GRID) {
        bin_count[bin] = 0u;
        bin_sum[bin] = 0;
    }
    barrier();
    for (int row = 0; row < GRID; ++row) count_place(ivec2(lane, row));
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
