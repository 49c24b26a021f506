// GLSL files and what they include, joined into one text that still knows its files and lines.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tarn {

// The text for glShaderSource and where its lines come from. A table, because #line is not enough: Mesa 22.3
// names source string 0 in most messages, whatever #line said.
struct ShaderSource {
    // Line `number` (from 1) of files[file].
    struct Line {
        std::size_t file;
        int number;
    };

    std::string text;
    std::vector<std::string> files;  // files[0] is "<defines>": the version and the defines
    std::vector<Line> lines;         // of each line of `text`
};

// The file `root / file` after "#version 450 core" and those of TARN_GLSL and `defines` ("NAME" or
// "NAME=VALUE") that it names. What #ifdef and #ifndef switch off is left out, so that defines that change
// nothing in a shader leave its text as it is: drivers keep compiled programs by their text. #if is the
// driver's to decide. #include "a/b.h" is relative to `root`; each file is taken once, at its first include
// that is not switched off; #pragma once is dropped. Error for missing files and cycles, with the including
// file and line.
ShaderSource load_shader_source(const std::filesystem::path& root, const std::string& file,
                                std::span<const std::string> defines);

// The driver's log on one line, its "0:LINE(COLUMN)" (Mesa) and "0(LINE)" (NVIDIA) turned into "file:line";
// messages beyond the eighth are counted.
std::string translate_shader_log(const ShaderSource& source, std::string_view log);

// The folder of shaders: what the environment variable TARN_SHADER_DIR says, else beside the program, under
// ../share/tarn, or where it was built (core/data_files.h). Error that lists where it looked.
std::filesystem::path get_shader_root();

}  // namespace tarn
