// The engine's public surface, whose names this folder uses as its own. Its parts rather than tarn.h, so that
// programs which also see the engine's inside, as the command line does, may include this folder's headers.
#pragma once

#include <tarn/camera.h>
#include <tarn/engine.h>
#include <tarn/error.h>
#include <tarn/scene.h>
#include <tarn/settings.h>
#include <tarn/values.h>

namespace game {
using namespace tarn::api;
}
