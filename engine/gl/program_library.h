// All programs of a run, compiled at first use, found by path and defines, reloaded when their files change.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gl/program.h"

namespace tarn {

class ProgramLibrary {
  public:
    // Shaders are files under `root / "passes"`; includes are relative to `root`.
    explicit ProgramLibrary(std::filesystem::path root = get_shader_root());

    // passes/PATH.comp with `defines` ("NAME" or "NAME=VALUE"), compiled at the first call. The reference
    // stays valid as long as the library, through reloads too (uniforms are back at their defaults then).
    // Error: see Program.
    const Program& compute(const std::string& path, const std::vector<std::string>& defines = {});

    // passes/PATH.vert with passes/PATH.frag; else as compute().
    const Program& graphics(const std::string& path, const std::vector<std::string>& defines = {});

    // Recompiles the programs whose files (or includes) changed. One that fails keeps its old program;
    // returns the messages of all that failed, one per line, empty when all is well.
    std::string reload();

    std::size_t program_count() const { return entries_.size(); }

  private:
    struct Entry {
        std::string name;
        std::vector<GLenum> types;
        std::vector<std::string> files;
        std::vector<std::string> defines;
        std::vector<ShaderStage> stages;
        std::unique_ptr<Program> program;
    };

    const Program& find_or_compile(const std::string& path, std::vector<GLenum> types,
                                   const std::vector<std::string>& defines);
    std::vector<ShaderStage> load_stages(const Entry& entry) const;
    void reload_entry(Entry& entry) const;

    std::filesystem::path root_;
    std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace tarn
