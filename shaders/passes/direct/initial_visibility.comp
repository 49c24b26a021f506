// Direct light: lib/reuse/initial_visibility.glsl.
#include "shared/interface/constants/initial_visibility.h"
#include "lib/frame.glsl"
#include "shared/math/light_sample.h"

#define SAMPLE_ROWS LIGHT_SAMPLE_ROWS

layout(local_size_x = 8, local_size_y = 8) in;

#include "lib/reuse/initial_visibility.glsl"
