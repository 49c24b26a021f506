// Names of files made from names of scenes, cameras and methods.
#pragma once

#include <string>

namespace tarn {

// `text` with all but letters, digits, dots and dashes turned into underscores.
inline std::string file_stem(std::string text) {
    const auto is_plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
               c == '-';
    };
    for (char& c : text) {
        if (!is_plain(c)) c = '_';
    }
    return text;
}

}  // namespace tarn
