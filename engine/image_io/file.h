// Files read whole and written whole or not at all: what the picture formats share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tarn {

// The most pixels that a picture may have: a header that claims more is taken for a lie.
constexpr std::int64_t MAX_PIXEL_COUNT = std::int64_t(1) << 28;

// Throws Error naming `path` where width or height is below 1 or the picture exceeds MAX_PIXEL_COUNT.
void check_picture_size(const std::filesystem::path& path, std::int64_t width, std::int64_t height);

// Returns the bytes of a regular file. Throws Error naming the file where it is missing, a folder or
// unreadable.
std::vector<unsigned char> load_file(const std::filesystem::path& path);

// Calls `write` with a temporary name in the folder of `path`, flushes that file to disk and renames it to
// `path`. Whatever fails (folder missing or read-only, disk full), the temporary file is removed and Error
// names `path`.
void write_whole(const std::filesystem::path& path, const std::function<void(const std::string&)>& write);

}  // namespace tarn
