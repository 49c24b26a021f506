// Direct light: lib/reuse/initial_visibility.glsl.
#include "shared/interface/constants/initial_visibility.h"
#include "lib/frame.glsl"
#include "shared/math/light_sample.h"

#define SAMPLE_ROWS LIGHT_SAMPLE_ROWS
#include "lib/pixel_group.glsl"

#include "lib/reuse/initial_visibility.glsl"
