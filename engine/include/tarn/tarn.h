// Tarn as a library: load a scene, look at it, get pictures. content/examples has two short programs.
//
// Everything is declared in tarn::api; this header makes it known as tarn::Engine and so on. Radiance is
// linear, Rec. 709, W sr^-1 m^-2; lengths are metres, angles radians where a name does not say otherwise;
// spaces are right-handed with +Y up. Row 0 of a picture is its top row.
//
// Whatever fails throws tarn::Error with a message of one line. Objects are not thread-safe: use an engine,
// its views and their scenes from one thread. Rendering itself uses all cores.
#pragma once

#include "tarn/camera.h"
#include "tarn/display.h"
#include "tarn/engine.h"
#include "tarn/error.h"
#include "tarn/picture.h"
#include "tarn/scene.h"
#include "tarn/settings.h"
#include "tarn/values.h"
#include "tarn/version.h"

namespace tarn {
using namespace api;
}
