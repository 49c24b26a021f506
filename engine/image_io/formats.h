// One reader per file format, behind read_radiance.
#pragma once

#include <filesystem>

#include "core/image.h"

namespace tarn {

// Reads R, G, B (or Y) of an OpenEXR file. Throws Error naming the file.
Image read_exr_radiance(const std::filesystem::path& path);

// Throws Error naming the file where it is missing, a folder or unreadable.
void check_readable(const std::filesystem::path& path);

}  // namespace tarn
