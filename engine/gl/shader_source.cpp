// Resolving includes and translating the driver's line numbers.
#include "gl/shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "core/data_files.h"
#include "core/error.h"

namespace tarn {
namespace {

std::string trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return "";
    return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

// "#  ifdef NAME // why" -> {"ifdef", "NAME"}; an empty keyword where the line is no directive.
struct Directive {
    std::string keyword;
    std::string argument;
};

Directive parse_directive(const std::string& line) {
    const std::string text = trim(line);
    if (text.empty() || text[0] != '#') return {};
    const std::string body = trim(std::string_view(text).substr(1));
    const std::size_t end = body.find_first_of(" \t\"<(");
    if (end == std::string::npos) return {body, ""};
    return {body.substr(0, end), trim(std::string_view(body).substr(end))};
}

std::string first_word(const std::string& text) {
    return text.substr(0, text.find_first_of(" \t(=/"));
}

// A branch of a conditional: active or not, or (not known) an expression that only the driver evaluates.
struct Branch {
    bool is_active;
    bool is_known;
};

class SourceJoiner {
  public:
    SourceJoiner(const std::filesystem::path& root, std::span<const std::string> defines) : root_(root) {
        source_.files.push_back("<defines>");
        append_line("#version 450 core", 0, 1);
        append_line("#define TARN_GLSL 1", 0, 2);
        defined_.insert("TARN_GLSL");
        for (const std::string& define : defines) add_define(define);
    }

    ShaderSource join(const std::string& file) && {
        add_file(file, "");
        return std::move(source_);
    }

  private:
    void add_define(const std::string& define) {
        const std::size_t equals = define.find('=');
        const std::string name = define.substr(0, equals);
        const std::string value = equals == std::string::npos ? "1" : define.substr(equals + 1);
        append_line("#define " + name + " " + value, 0, int(source_.lines.size()) + 1);
        defined_.insert(name);
    }

    // `includer` is "file:line: ", or empty for the first file.
    void add_file(const std::string& file, const std::string& includer) {
        std::ifstream stream(root_ / file);
        if (!stream || std::filesystem::is_directory(root_ / file))
            throw Error("{}shader file '{}' is not in {}", includer, file, root_.string());
        const std::size_t number = source_.files.size();
        source_.files.push_back(file);
        open_files_.push_back(file);
        std::vector<Branch> outer_branches = std::exchange(branches_, {});
        int line_number = 0;
        for (std::string line; std::getline(stream, line);) add_line(line, file, number, ++line_number);
        branches_ = std::move(outer_branches);
        open_files_.pop_back();
    }

    void add_line(const std::string& line, const std::string& file, std::size_t number, int line_number) {
        const Directive directive = parse_directive(line);
        follow_branches(directive);
        if (directive.keyword == "include" && directive.argument.starts_with('"')) {
            if (is_active()) add_include(directive.argument, fmt::format("{}:{}: ", file, line_number));
        } else if (directive.keyword != "pragma" || directive.argument != "once") {
            append_line(line, number, line_number);
        }
    }

    void append_line(const std::string& line, std::size_t file, int line_number) {
        source_.text += line + "\n";
        source_.lines.push_back({file, line_number});
    }

    // Knows #ifdef and #ifndef; the branches of an #if are all taken for active.
    void follow_branches(const Directive& directive) {
        const std::string& keyword = directive.keyword;
        if (keyword == "ifdef" || keyword == "ifndef") {
            const bool defined = defined_.contains(first_word(directive.argument));
            branches_.push_back({defined == (keyword == "ifdef"), true});
        } else if (keyword == "if") {
            branches_.push_back({true, false});
        } else if (keyword == "define" && is_active()) {
            defined_.insert(first_word(directive.argument));
        } else if (!branches_.empty()) {
            Branch& branch = branches_.back();
            if (keyword == "else" && branch.is_known) branch.is_active = !branch.is_active;
            if (keyword == "elif") branch = {true, false};
            if (keyword == "endif") branches_.pop_back();
        }
    }

    bool is_active() const {
        return std::all_of(branches_.begin(), branches_.end(), [](const Branch& b) { return b.is_active; });
    }

    void add_include(const std::string& argument, const std::string& includer) {
        const std::size_t end = argument.find('"', 1);
        if (end == std::string::npos) throw Error("{}#include {} has no closing quote", includer, argument);
        const std::string file =
            std::filesystem::path(argument.substr(1, end - 1)).lexically_normal().string();
        if (std::find(open_files_.begin(), open_files_.end(), file) != open_files_.end())
            throw Error("{}'{}' includes itself: {}", includer, file, describe_cycle(file));
        const auto& files = source_.files;
        if (std::find(files.begin(), files.end(), file) == files.end()) add_file(file, includer);
    }

    std::string describe_cycle(const std::string& file) const {
        std::string text;
        for (auto open = std::find(open_files_.begin(), open_files_.end(), file); open != open_files_.end();
             ++open)
            text += *open + " -> ";
        return text + file;
    }

    std::filesystem::path root_;
    ShaderSource source_;
    std::vector<std::string> open_files_;  // from the first file down to the one being read
    std::vector<Branch> branches_;         // enclosing conditionals of the line being read, in its own file
    std::set<std::string> defined_;
};

std::string describe_line(const ShaderSource& source, const std::string& number) {
    const std::size_t index = std::strtoul(number.c_str(), nullptr, 10) - 1;
    if (index >= source.lines.size()) return "line " + number;
    const ShaderSource::Line& line = source.lines[index];
    return fmt::format("{}:{}", source.files[line.file], line.number);
}

std::string translate_line(const ShaderSource& source, const std::string& line) {
    static const std::regex MESA(R"(^\d+:(\d+)\((\d+)\): *)");
    static const std::regex NVIDIA(R"(^\d+\((\d+)\) *: *)");
    std::smatch match;
    if (std::regex_search(line, match, MESA))
        return fmt::format("{}:{}: {}", describe_line(source, match[1]), match[2].str(),
                           match.suffix().str());
    if (std::regex_search(line, match, NVIDIA))
        return fmt::format("{}: {}", describe_line(source, match[1]), match.suffix().str());
    return line;
}

}  // namespace

ShaderSource load_shader_source(const std::filesystem::path& root, const std::string& file,
                                std::span<const std::string> defines) {
    return SourceJoiner(root, defines).join(file);
}

std::string translate_shader_log(const ShaderSource& source, std::string_view log) {
    constexpr int MAX_MESSAGES = 8;
    std::istringstream stream{std::string(log)};
    std::string text;
    int count = 0;
    for (std::string line; std::getline(stream, line);) {
        line = trim(line.substr(0, line.find('\0')));
        if (line.empty() || ++count > MAX_MESSAGES) continue;
        if (!text.empty()) text += "; ";
        text += translate_line(source, line);
    }
    if (count > MAX_MESSAGES) text += fmt::format("; and {} more", count - MAX_MESSAGES);
    return text;
}

std::filesystem::path get_shader_root() {
    constexpr DataFolder SHADERS = {"shaders", "TARN_SHADER_DIR", TARN_SHADER_DIR};
    // A folder that somebody else calls so does not count.
    return locate_data_file(SHADERS, "passes").parent_path();
}

}  // namespace tarn
