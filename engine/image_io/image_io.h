// Pictures on disk: OpenEXR and Radiance HDR for radiance, PNG for the eye.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/image.h"

namespace tarn {

// A named plane of an EXR file, such as "R" or "variance.G": width * height floats, row 0 on top.
struct ExrChannel {
    std::string name;
    std::vector<float> values;
};

// What a file says of its picture besides the pixels: names and texts, attributes of the header.
using PictureNotes = std::vector<std::pair<std::string, std::string>>;

// Writes 32-bit float channels, ZIP-compressed. Whole or not at all: written to a temporary name, then
// renamed. Throws Error naming the file.
void write_exr(const std::filesystem::path& path, int width, int height,
               const std::vector<ExrChannel>& channels, const PictureNotes& notes = {});

// Writes a 3-channel image as R, G, B.
void write_exr(const std::filesystem::path& path, const Image& image, const PictureNotes& notes = {});

// The notes of an EXR file, in the order of their names. Throws Error naming the file.
PictureNotes read_exr_notes(const std::filesystem::path& path);

// Reads R, G, B (or Y) of an EXR file, or of a Radiance .hdr file, as 3 channels of linear radiance.
Image read_radiance(const std::filesystem::path& path);

// Reads all channels of an EXR file by name (half and float alike). Sets `width` and `height`.
std::vector<ExrChannel> read_exr_channels(const std::filesystem::path& path, int& width, int& height);

// Writes 8-bit RGB from values in [0, 1] that are already display-encoded (sRGB); others are clamped. Whole
// or not at all.
void write_png(const std::filesystem::path& path, const Image& display_rgb);

// Reads a PNG as 3 channels of display-encoded values in [0, 1].
Image read_png(const std::filesystem::path& path);

}  // namespace tarn
