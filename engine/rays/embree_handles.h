// Owners of Embree's objects, and its errors as exceptions.
#pragma once

#include <memory>
#include <type_traits>

#include "core/error.h"
#include "rays/embree_api.h"

namespace tarn {

struct EmbreeRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

template <class Handle>
using EmbreeHandle = std::unique_ptr<std::remove_pointer_t<Handle>, EmbreeRelease>;

using EmbreeDevice = EmbreeHandle<RTCDevice>;
using EmbreeScene = EmbreeHandle<RTCScene>;
using EmbreeGeometry = EmbreeHandle<RTCGeometry>;

// Throws Error when Embree has reported one since the last call. `what` names the work that was done.
inline void check_embree(RTCDevice device, const char* what) {
    const RTCError code = rtcGetDeviceError(device);
    if (code != RTC_ERROR_NONE) throw Error("Embree failed with error {} while {}", int(code), what);
}

}  // namespace tarn
