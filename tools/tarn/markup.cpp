#include "markup.h"

#include <fmt/format.h>

#include <cstdint>

namespace tarn {
namespace {

constexpr std::string_view REPLACEMENT = "\xEF\xBF\xBD";  // U+FFFD

// How many bytes a character of UTF-8 has by its first one; 0: none begins so.
std::size_t sequence_length(unsigned char first) {
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first < 0xE0) return 2;
    if (first >= 0xE0 && first < 0xF0) return 3;
    if (first >= 0xF0 && first < 0xF5) return 4;
    return 0;
}

// The character of 2 to 4 bytes, or 0 where they are no UTF-8.
std::uint32_t decode_sequence(std::string_view bytes) {
    static constexpr std::uint32_t LEAST[] = {0, 0, 0x80, 0x800, 0x10000};
    std::uint32_t character = static_cast<unsigned char>(bytes[0]) & (0xFFu >> (bytes.size() + 1));
    for (const char byte : bytes.substr(1)) {
        if ((static_cast<unsigned char>(byte) & 0xC0u) != 0x80u) return 0;
        character = character << 6 | (static_cast<unsigned char>(byte) & 0x3Fu);
    }
    const bool is_surrogate = character >= 0xD800 && character < 0xE000;
    const bool is_no_character = character == 0xFFFE || character == 0xFFFF;
    const bool is_in_range = character >= LEAST[bytes.size()] && character <= 0x10FFFF;
    return is_in_range && !is_surrogate && !is_no_character ? character : 0;
}

std::string escape_ascii(char character) {
    switch (character) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&#39;";
        case '\t':
            return "&#9;";
        case '\n':
            return "&#10;";
        case '\r':
            return "&#13;";
        default:
            return std::string(character < ' ' ? REPLACEMENT : std::string_view(&character, 1));
    }
}

bool is_plain_in_url(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-._~/").find(c) != std::string_view::npos;
}

}  // namespace

std::string escape_markup(std::string_view text) {
    std::string escaped;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = sequence_length(static_cast<unsigned char>(text[i]));
        if (length == 1) {
            escaped += escape_ascii(text[i++]);
            continue;
        }
        const bool is_whole =
            length != 0 && i + length <= text.size() && decode_sequence(text.substr(i, length));
        escaped += is_whole ? text.substr(i, length) : REPLACEMENT;
        i += is_whole ? length : 1;
    }
    return escaped;
}

std::string escape_url(std::string_view path) {
    std::string escaped;
    for (const char c : path) {
        escaped +=
            is_plain_in_url(c) ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return escaped;
}

}  // namespace tarn
