// Data URIs, files beside the glTF file and percent-encoding.
#include "scene/gltf_uri.h"

#include <fstream>

#include "core/error.h"

namespace tarn {
namespace {

constexpr std::size_t SHOWN_URI_LENGTH = 60;

std::string shorten(std::string_view uri) {
    if (uri.size() <= SHOWN_URI_LENGTH) return std::string(uri);
    return std::string(uri.substr(0, SHOWN_URI_LENGTH)) + "...";
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

std::vector<std::uint8_t> decode_base64(std::string_view text) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) throw Error("data URI: base64 text of {} digits is cut off", text.size());
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int digit = base64_digit(text[i]);
        if (digit < 0) throw Error("data URI: byte {} is not a base64 digit", i);
        bits = (bits << 6) | std::uint32_t(digit);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(std::uint8_t(bits >> bit_count));
        }
    }
    return bytes;
}

bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string_view::npos && uri.find('/') > colon;
}

std::string relative_path(const std::string& uri) {
    if (uri.empty()) throw Error("URI is empty");
    const std::string relative = decode_percent(uri);
    if (relative.find('\0') != std::string::npos) throw Error("URI '{}' holds a zero byte", shorten(uri));
    return relative;
}

}  // namespace

std::vector<std::uint8_t> read_file_bytes(const std::filesystem::path& path, std::uint64_t limit_bytes) {
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status)) throw Error("'{}' does not exist", path.string());
    if (!std::filesystem::is_regular_file(status)) throw Error("'{}' is not a file", path.string());
    const std::uint64_t size = std::filesystem::file_size(path, code);
    if (code) throw Error("'{}' has no size: {}", path.string(), code.message());
    if (size > limit_bytes) {
        throw Error("'{}' has {} bytes, the limit is {}", path.string(), size, limit_bytes);
    }
    std::vector<std::uint8_t> bytes(size);
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size))) {
        throw Error("'{}' cannot be read", path.string());
    }
    return bytes;
}

std::string decode_percent(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded.push_back(text[i]);
            continue;
        }
        const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
        if (high < 0 || low < 0) throw Error("URI '{}' has a broken % escape", shorten(text));
        decoded.push_back(char(high * 16 + low));
        i += 2;
    }
    return decoded;
}

bool is_data_uri(std::string_view uri) {
    return uri.starts_with("data:");
}

std::vector<std::uint8_t> decode_data_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) throw Error("data URI '{}' has no comma", shorten(uri));
    const std::string_view payload = uri.substr(comma + 1);
    if (uri.substr(0, comma).ends_with(";base64")) return decode_base64(payload);
    const std::string text = decode_percent(payload);
    return {text.begin(), text.end()};
}

bool is_missing_file(const std::string& uri, const std::filesystem::path& folder) {
    if (is_data_uri(uri) || has_scheme(uri)) return false;
    std::error_code code;
    return std::filesystem::status(folder / relative_path(uri), code).type() ==
           std::filesystem::file_type::not_found;
}

std::vector<std::uint8_t> load_uri(const std::string& uri, const std::filesystem::path& folder,
                                   std::uint64_t limit_bytes) {
    if (is_data_uri(uri)) return decode_data_uri(uri);
    if (has_scheme(uri)) throw Error("URI '{}' is neither a data URI nor a relative path", shorten(uri));
    return read_file_bytes(folder / relative_path(uri), limit_bytes);
}

}  // namespace tarn
