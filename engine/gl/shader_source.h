// GLSL files and what they include, joined into one text that still knows its files and lines.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tarn {

// The text for glShaderSource. Source string number i of its #line directives is files[i]; 0 is the text that
// we put before the first file: the version and the defines.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files;
};

// The file `root / file` after "#version 450 core", TARN_GLSL and `defines` ("NAME" or "NAME=VALUE").
// #include "a/b.h" is relative to `root`; each file is taken once, at its first include that is not switched
// off by #ifdef / #ifndef of a define given here or above; #include <...> is left alone (C++ only); #pragma
// once is dropped. Error for missing files and cycles, with the including file and line.
ShaderSource load_shader_source(const std::filesystem::path& root, const std::string& file,
                                std::span<const std::string> defines);

// The driver's log on one line, its "S:LINE(COLUMN)" (Mesa) and "S(LINE)" (NVIDIA) turned into "file:line";
// messages beyond the eighth are counted.
std::string translate_shader_log(const ShaderSource& source, std::string_view log);

// The folder of shaders: the environment variable TARN_SHADER_DIR, else the one that was compiled in.
std::filesystem::path get_shader_root();

}  // namespace tarn
