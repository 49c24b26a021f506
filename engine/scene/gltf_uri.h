// Where a glTF file's bytes come from: data URIs, files beside it, percent-encoding.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tarn {

// The bytes of a regular file of at most `limit_bytes`. Throws Error where there is none or it is larger.
std::vector<std::uint8_t> read_file_bytes(const std::filesystem::path& path, std::uint64_t limit_bytes);

// "%20" becomes " ". Throws Error for a broken escape.
std::string decode_percent(std::string_view text);

// True for "data:...".
bool is_data_uri(std::string_view uri);

// The bytes of a data URI, base64 or percent-encoded (RFC 2397). Throws Error for anything malformed.
std::vector<std::uint8_t> decode_data_uri(std::string_view uri);

// True where `uri` is a relative path at which there is nothing.
bool is_missing_file(const std::string& uri, const std::filesystem::path& folder);

// The bytes that `uri` names: a data URI, or a path relative to `folder`. Throws Error for any other scheme.
std::vector<std::uint8_t> load_uri(const std::string& uri, const std::filesystem::path& folder,
                                   std::uint64_t limit_bytes);

}  // namespace tarn
