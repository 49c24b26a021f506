// Resolving includes and translating the driver's line numbers.
#include "gl/shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
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

// "defined(A) && B > 2 // why" -> A, B and defined.
void collect_names(const std::string& line, std::set<std::string>& names) {
    const std::string code = line.substr(0, line.find("//"));
    const auto is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (auto at = code.begin(); at != code.end();) {
        const auto begin = std::find_if(at, code.end(), is_of_name);
        at = std::find_if_not(begin, code.end(), is_of_name);
        if (begin != at) names.emplace(begin, at);
    }
}

// A branch of a conditional. One that only the driver can decide (#if, or a name whose definition it decides)
// counts as active; of the others no directive is written, and no line of those that are not active.
struct Branch {
    bool is_active;
    bool is_known;
    bool was_active;  // or a branch before it, of the same conditional
};

class SourceJoiner {
  public:
    SourceJoiner(const std::filesystem::path& root, std::span<const std::string> defines) : root_(root) {
        add_define("TARN_GLSL");
        for (const std::string& define : defines) add_define(define);
    }

    ShaderSource join(const std::string& file) && {
        source_.files.push_back("<defines>");
        add_file(file, "");
        ShaderSource whole = write_head();
        whole.text += source_.text;
        whole.files = std::move(source_.files);
        whole.lines.insert(whole.lines.end(), source_.lines.begin(), source_.lines.end());
        return whole;
    }

  private:
    void add_define(const std::string& define) {
        const std::size_t equals = define.find('=');
        const std::string name = define.substr(0, equals);
        defines_.emplace_back(name, equals == std::string::npos ? "1" : define.substr(equals + 1));
        defined_.insert(name);
    }

    // The version and those defines that the text names.
    ShaderSource write_head() const {
        std::set<std::string> names;
        std::istringstream text(source_.text);
        for (std::string line; std::getline(text, line);) collect_names(line, names);
        for (const auto& [name, value] : defines_) collect_names(value, names);

        ShaderSource head;
        append_line(head, "#version 450 core", 0, 1);
        for (const auto& [name, value] : defines_)
            if (names.contains(name))
                append_line(head, "#define " + name + " " + value, 0, int(head.lines.size()) + 1);
        return head;
    }

    // `includer` is "file:line: ", or empty for the first file.
    void add_file(const std::string& file, const std::string& includer) {
        std::ifstream stream(root_ / file);
        if (!stream || std::filesystem::is_directory(root_ / file))
            throw Error("{}shader file '{}' is not in {}", includer, file, root_.string());
        const std::size_t number = source_.files.size();
        source_.files.push_back(file);
        open_files_.push_back(file);
        const std::size_t outer_base = std::exchange(base_, branches_.size());
        int line_number = 0;
        for (std::string line; std::getline(stream, line);) add_line(line, file, number, ++line_number);
        branches_.resize(base_);
        base_ = outer_base;
        open_files_.pop_back();
    }

    void add_line(const std::string& line, const std::string& file, std::size_t number, int line_number) {
        const Directive directive = parse_directive(line);
        if (is_conditional(directive.keyword)) {
            const std::string written = follow_branches(directive, line);
            if (!written.empty()) append_line(source_, written, number, line_number);
            return;
        }
        if (!is_active()) return;
        follow_defines(directive);
        if (directive.keyword == "include" && directive.argument.starts_with('"')) {
            add_include(directive.argument, fmt::format("{}:{}: ", file, line_number));
        } else if (directive.keyword != "pragma" || directive.argument != "once") {
            append_line(source_, line, number, line_number);
        }
    }

    static void append_line(ShaderSource& source, const std::string& line, std::size_t file,
                            int line_number) {
        source.text += line + "\n";
        source.lines.push_back({file, line_number});
    }

    static bool is_conditional(const std::string& keyword) {
        return keyword.starts_with("if") || keyword == "elif" || keyword == "else" || keyword == "endif";
    }

    // Returns what the driver must see of the directive.
    std::string follow_branches(const Directive& directive, const std::string& line) {
        const std::string& keyword = directive.keyword;
        const bool was_active = is_active();
        if (keyword.starts_with("if")) {
            const std::string name = first_word(directive.argument);
            const bool is_known = !was_active || (keyword != "if" && !perhaps_defined_.contains(name));
            const bool is_taken = !is_known || defined_.contains(name) == (keyword == "ifdef");
            branches_.push_back({is_taken, is_known, is_taken});
            return is_known ? "" : line;
        }
        if (branches_.size() == base_) return line;  // the driver's error
        Branch& branch = branches_.back();
        const bool is_known = branch.is_known;
        if (keyword == "endif") branches_.pop_back();
        if (!is_known) return line;
        if (keyword == "endif") return "";
        // The #elif of a branch that was not taken begins a conditional for the driver.
        const bool begins = keyword == "elif" && !branch.was_active && is_active_outside();
        branch = {!branch.was_active, !begins, true};
        return begins ? "#if " + directive.argument : "";
    }

    void follow_defines(const Directive& directive) {
        if (directive.keyword != "define" && directive.keyword != "undef") return;
        const std::string name = first_word(directive.argument);
        if (!is_known())
            perhaps_defined_.insert(name);
        else if (directive.keyword == "define")
            defined_.insert(name);
        else
            defined_.erase(name);
    }

    bool is_active() const {
        return std::all_of(branches_.begin(), branches_.end(), [](const Branch& b) { return b.is_active; });
    }

    // But for the innermost conditional.
    bool is_active_outside() const {
        return std::all_of(branches_.begin(), branches_.end() - 1,
                           [](const Branch& b) { return b.is_active; });
    }

    bool is_known() const {
        return std::all_of(branches_.begin(), branches_.end(), [](const Branch& b) { return b.is_known; });
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
    ShaderSource source_;  // without its head
    std::vector<std::pair<std::string, std::string>> defines_;
    std::vector<std::string> open_files_;  // from the first file down to the one being read
    std::vector<Branch> branches_;         // enclosing conditionals of the line being read
    std::size_t base_ = 0;                 // how many of them began in other files
    std::set<std::string> defined_;
    std::set<std::string> perhaps_defined_;  // as the driver decides
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
