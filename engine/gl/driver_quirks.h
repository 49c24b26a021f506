// What drivers do differently from what one would expect: each quirk named, dated, explained, and switchable.
#pragma once

#include "gl/device_info.h"

namespace tarn {

struct DriverQuirks {
    // Mesa llvmpipe, 22.3.6 (November 2026): a timestamp query answers when the command is queued, not when
    // the work before it is done, so that one pass shows the time of all. Passes are then timed by the wall
    // clock between two fences, at 20-80 us a wait.
    bool timestamps_at_submission = false;
    // Mesa llvmpipe, 22.3.6 (November 2026): a work group runs on one core, eight pixels at a time, through
    // ordinary caches. A group of 8 x 8 pixels walks down eight rows of each picture, which lie in as many
    // pages; a row of 64 pixels lies in one or two. At 640 x 360 filters take half the time, a whole frame
    // 0.8.
    bool groups_are_rows = false;
    // Mesa llvmpipe, 22.3.6 (November 2026): the CPU rasterizes, and takes all vertices and triangles through
    // a single thread, 0.1 to 0.2 microseconds a triangle. Where there are many for the pixels, a ray for
    // each pixel on all cores costs less.
    bool slow_triangles = false;
};

// The quirks of a device. Environment variable TARN_QUIRKS overrides: a list of NAME or -NAME, separated by
// commas. Error for a name that is none.
DriverQuirks find_driver_quirks(const DeviceInfo& device);

}  // namespace tarn
