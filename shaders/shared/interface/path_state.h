// Rows a pixel that hold a path on its way; what they are: shaders/lib/indirect/path_state.glsl.
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

CONSTANT uint PATH_STATE_ROWS = 8u;

SHARED_END
