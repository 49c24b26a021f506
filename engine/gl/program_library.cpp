// Finding, compiling and reloading programs.
#include "gl/program_library.h"

#include "core/error.h"

namespace tarn {
namespace {

const char* file_extension(GLenum type) {
    switch (type) {
        case GL_COMPUTE_SHADER:
            return ".comp";
        case GL_VERTEX_SHADER:
            return ".vert";
        default:
            return ".frag";
    }
}

// "direct/candidates [TARN_MODE_RIS]": also the label of the GL object.
std::string make_name(const std::string& path, const std::vector<std::string>& defines) {
    if (defines.empty()) return path;
    return fmt::format("{} [{}]", path, fmt::join(defines, " "));
}

bool has_same_text(const std::vector<ShaderStage>& a, const std::vector<ShaderStage>& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].source.text != b[i].source.text) return false;
    return true;
}

}  // namespace

ProgramLibrary::ProgramLibrary(std::filesystem::path root) : root_(std::move(root)) {
    if (!std::filesystem::is_directory(root_)) throw Error("shader folder {} does not exist", root_.string());
}

const Program& ProgramLibrary::compute(const std::string& path, const std::vector<std::string>& defines) {
    return find_or_compile(path, {GL_COMPUTE_SHADER}, defines);
}

const Program& ProgramLibrary::graphics(const std::string& path, const std::vector<std::string>& defines) {
    return find_or_compile(path, {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER}, defines);
}

const Program& ProgramLibrary::find_or_compile(const std::string& path, std::vector<GLenum> types,
                                               const std::vector<std::string>& defines) {
    const std::string name = make_name(path, defines);
    const std::string key = file_extension(types.front()) + name;
    const auto found = entries_.find(key);
    if (found != entries_.end()) return *found->second.program;

    Entry entry{name, std::move(types), {}, defines, {}, nullptr};
    for (const GLenum type : entry.types) entry.files.push_back("passes/" + path + file_extension(type));
    entry.stages = load_stages(entry);
    entry.program = std::make_unique<Program>(entry.name, entry.stages);
    return *entries_.emplace(key, std::move(entry)).first->second.program;
}

std::vector<ShaderStage> ProgramLibrary::load_stages(const Entry& entry) const {
    std::vector<ShaderStage> stages;
    for (std::size_t i = 0; i < entry.files.size(); ++i)
        stages.push_back({entry.types[i], load_shader_source(root_, entry.files[i], entry.defines)});
    return stages;
}

std::string ProgramLibrary::reload() {
    std::string messages;
    for (auto& [key, entry] : entries_) {
        try {
            reload_entry(entry);
        } catch (const Error& error) {
            messages += std::string(messages.empty() ? "" : "\n") + error.what();
        }
    }
    return messages;
}

void ProgramLibrary::reload_entry(Entry& entry) const {
    std::vector<ShaderStage> stages = load_stages(entry);
    if (has_same_text(stages, entry.stages)) return;
    Program program(entry.name, stages);
    // Assigned in place: whoever holds a reference to the program sees the new one.
    *entry.program = std::move(program);
    entry.stages = std::move(stages);
}

}  // namespace tarn
