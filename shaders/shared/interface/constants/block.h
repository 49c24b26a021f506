// The constants of a pass: a uniform block of its own in GLSL, a plain struct in C++
// (PassRecorder::constants).
//
// std140 and C++ agree on the layout where four-component vectors stand first and scalars of four bytes
// follow; other types are not to be used. FrameRecorder refuses a block whose size is not the struct's.
#pragma once

#include "shared/dialect.h"
#include "shared/interface/bindings.h"

#ifdef TARN_GLSL
#define PASS_CONSTANTS(Name) layout(std140, binding = BLOCK_PASS) uniform Name
#else
#define PASS_CONSTANTS(Name) struct Name
#endif
