// Direct light: lib/reuse/boiling_filter.glsl.
#include "shared/interface/constants/boiling_filter.h"
#include "lib/frame.glsl"
#include "shared/math/light_sample.h"

#define SAMPLE_ROWS LIGHT_SAMPLE_ROWS

layout(local_size_x = 8, local_size_y = 8) in;

#include "lib/reuse/boiling_filter.glsl"
