// Shader sources, programs and their library: includes, line numbers, errors, caching, reload.
#include <gtest/gtest.h>

#include <vector>

#include "core/error.h"
#include "gl/buffer.h"
#include "gl/program_library.h"
#include "gl/shader_source.h"
#include "gpu/shader_folder.h"
#include "platform/context.h"
#include "platform/environment.h"
#include "support/on_context.h"

namespace tarn {
namespace {

using Files = std::vector<std::string>;

ShaderSource load(const ShaderFolder& folder, const std::string& file,
                  const std::vector<std::string>& defines = {}) {
    return load_shader_source(folder.root(), file, defines);
}

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(ShaderSource, BeginsWithTheVersionAndTheDefinesThatItNames) {
    const ShaderFolder folder;
    folder.write("a.comp", "int a = ONE + TWO + TARN_GLSL;  // UNSAID\n");
    EXPECT_EQ(load(folder, "a.comp", {"ONE", "TWO=2 * THREE", "THREE=3", "UNSAID", "ON"}).text,
              "#version 450 core\n#define TARN_GLSL 1\n#define ONE 1\n#define TWO 2 * THREE\n"
              "#define THREE 3\nint a = ONE + TWO + TARN_GLSL;  // UNSAID\n");
}

// The text without the version.
std::string load_body(const std::string& text, const std::vector<std::string>& defines) {
    const ShaderFolder folder;
    folder.write("a.comp", text);
    const std::string loaded = load(folder, "a.comp", defines).text;
    return loaded.substr(loaded.find('\n') + 1);
}

TEST(ShaderSource, LeavesOutWhatIsSwitchedOff) {
    const std::string text =
        "#ifdef A\na\n#ifndef B\nnot b\n#else  // B\nb\n#endif\n#else\nnot a\n#endif\nend\n";
    EXPECT_EQ(load_body(text, {}), "not a\nend\n");
    EXPECT_EQ(load_body(text, {"A"}), "a\nnot b\nend\n");
    EXPECT_EQ(load_body(text, {"A", "B"}), "a\nb\nend\n");
    EXPECT_EQ(load_body(text, {"B"}), load_body(text, {"C"})) << "what changes nothing must not show";
}

TEST(ShaderSource, LeavesConditionsToTheDriver) {
    const std::string text =
        "#if defined(A) && B == 1\n#define C\nx\n#elif 1\ny\n#else\nz\n#endif\n"
        "#ifdef C\nc\n#else\nno c\n#endif\n";
    EXPECT_EQ(load_body(text, {"B=1", "D"}), "#define B 1\n" + text);
    EXPECT_EQ(load_body("#ifdef A\n" + text + "#endif\n", {}), "");
}

TEST(ShaderSource, FollowsDefinesOfTheText) {
    EXPECT_EQ(load_body("#define A\n#ifdef A\na\n#endif\n#undef A\n#ifndef A\nnone\n#endif\n", {}),
              "#define A\na\n#undef A\nnone\n");
    EXPECT_EQ(load_body("#ifdef B\n#define A\n#endif\n#ifdef A\na\n#endif\n", {}), "");
}

TEST(ShaderSource, ElifAfterIfdefIsDecidedByWhatCameBefore) {
    const std::string text = "#ifdef A\na\n#elif B > 1\nb\n#else\nc\n#endif\n";
    EXPECT_EQ(load_body(text, {"A"}), "a\n");
    EXPECT_EQ(load_body(text, {"B=2"}), "#define B 2\n#if B > 1\nb\n#else\nc\n#endif\n");
    EXPECT_EQ(load_body("#ifdef D\n" + text + "#endif\n", {"B=2"}), "");
}

TEST(ShaderSource, AStrayEndifIsTheDriversError) {
    const ShaderFolder folder;
    folder.write("b.h", "#endif\n");
    folder.write("a.comp", "#ifdef A\n#include \"b.h\"\na\n#endif\n");
    EXPECT_EQ(load(folder, "a.comp", {"A"}).text, "#version 450 core\n#endif\na\n");
}

TEST(ShaderSource, TakesEachIncludeOnceAndDropsPragmaOnce) {
    const ShaderFolder folder;
    folder.write("shared/low.h", "#pragma once\nint low;\n");
    folder.write("shared/high.h", "#pragma once\n#include \"shared/low.h\"\nint high;\n");
    folder.write("a.comp", "#include \"shared/high.h\"\n#include \"shared/low.h\"\nint main_file;\n");
    const ShaderSource source = load(folder, "a.comp");
    EXPECT_EQ(source.files, (Files{"<defines>", "a.comp", "shared/high.h", "shared/low.h"}));
    EXPECT_EQ(source.text, "#version 450 core\nint low;\nint high;\nint main_file;\n");
    ASSERT_EQ(source.lines.size(), 4u);
    EXPECT_EQ(translate_shader_log(source, "0:2(1): x\n0:3(1): x\n0:4(1): x\n"),
              "shared/low.h:2:1: x; shared/high.h:3:1: x; a.comp:3:1: x");
}

TEST(ShaderSource, SkipsIncludesOfBranchesThatAreSwitchedOff) {
    const ShaderFolder folder;
    folder.write("used.h", "int used;\n");
    folder.write("other.h", "int other;\n");
    folder.write("a.comp",
                 "#ifndef TARN_GLSL\n#include <vector>\n#include \"core/not_there.h\"\n#else\n#include "
                 "\"used.h\"\n#endif\n"
                 "#ifdef OTHER\n#include \"other.h\"\n#endif\n");
    EXPECT_EQ(load(folder, "a.comp").files, (Files{"<defines>", "a.comp", "used.h"}));
    EXPECT_EQ(load(folder, "a.comp", {"OTHER"}).files, (Files{"<defines>", "a.comp", "used.h", "other.h"}));
}

TEST(ShaderSource, AMissingIncludeNamesTheIncludingFileAndLine) {
    const ShaderFolder folder;
    folder.write("b.h", "\n\n#include \"gone.h\"\n");
    folder.write("a.comp", "#include \"b.h\"\n");
    const std::string message = catch_message<Error>([&] { load(folder, "a.comp"); });
    EXPECT_TRUE(message.starts_with("b.h:3: shader file 'gone.h' is not in ")) << message;
}

TEST(ShaderSource, AMissingFileIsAnError) {
    const ShaderFolder folder;
    const std::string message = catch_message<Error>([&] { load(folder, "gone.comp"); });
    EXPECT_TRUE(message.starts_with("shader file 'gone.comp' is not in ")) << message;
}

TEST(ShaderSource, ACycleIsAnErrorThatShowsIt) {
    const ShaderFolder folder;
    folder.write("a.comp", "#include \"b.h\"\n");
    folder.write("b.h", "#include \"c.h\"\n");
    folder.write("c.h", "\n#include \"b.h\"\n");
    const std::string message = catch_message<Error>([&] { load(folder, "a.comp"); });
    EXPECT_EQ(message, "c.h:2: 'b.h' includes itself: b.h -> c.h -> b.h");
}

TEST(ShaderSource, LogsOfMesaAndNvidiaAreTranslated) {
    const ShaderSource source{"", {"<defines>", "a.comp", "b.h"}, {{0, 1}, {2, 14}, {1, 3}}};
    EXPECT_EQ(translate_shader_log(source, "0:2(7): error: `x' undeclared\n0:3(1): warning: unused\n\n"),
              "b.h:14:7: error: `x' undeclared; a.comp:3:1: warning: unused");
    EXPECT_EQ(translate_shader_log(source, "0(2) : error C1503: undefined variable \"x\"\n"),
              "b.h:14: error C1503: undefined variable \"x\"");
    EXPECT_EQ(translate_shader_log(source, "error: linking failed\n"), "error: linking failed");
    EXPECT_EQ(translate_shader_log(source, "0:99(1): error\n"), "line 99:1: error");
    EXPECT_EQ(translate_shader_log(source, "0:0(0): error\n"), "line 0:0: error");
}

TEST(ShaderSource, LongLogsAreCut) {
    std::string log;
    for (int i = 0; i < 20; ++i) log += "0:1(1): error\n";
    const std::string text = translate_shader_log({"", {"a.comp"}, {{0, 1}}}, log);
    EXPECT_EQ(count(text, "a.comp:1:1: error"), 8);
    EXPECT_TRUE(text.ends_with("; and 12 more")) << text;
}

TEST(ShaderSource, TheRootComesFromTheEnvironment) {
    const ShaderFolder folder;
    EXPECT_TRUE(std::filesystem::is_directory(get_shader_root()));
    const ScopedEnvironment choice("TARN_SHADER_DIR", folder.root().string());
    EXPECT_THROW(get_shader_root(), Error) << "it holds no shaders";
    folder.write("passes/a.comp", "layout(local_size_x = 1) in;\nvoid main() {}\n");
    EXPECT_EQ(get_shader_root(), folder.root());
    const auto context = create_context({});
    EXPECT_EQ(ProgramLibrary().compute("a").name(), "a");
}

class Programs : public test::OnDebugContext<> {
  protected:
    void SetUp() override { take_debug_errors(); }

    // A program that stores `expression`, after `head`.
    void write_store(const std::string& expression, const std::string& head = "") const {
        folder_.write("passes/store.comp", head +
                                               "layout(local_size_x = 1) in;\n"
                                               "layout(std430, binding = 0) buffer Result { uint result; };\n"
                                               "void main() { result = " +
                                               expression + "; }\n");
    }

    static std::uint32_t run(const Program& program) {
        const Buffer result("result", 16, BufferUse::DEVICE);
        result.bind_storage(0);
        program.use();
        glDispatchCompute(1, 1, 1);
        return result.download<std::uint32_t>()[0];
    }

    ShaderFolder folder_;
};

TEST_F(Programs, DefinesReachTheShaderAndTheName) {
    write_store("VALUE + uint(TARN_GLSL)");
    ProgramLibrary library(folder_.root());
    EXPECT_EQ(run(library.compute("store", {"VALUE=41u"})), 42u);
    EXPECT_EQ(library.compute("store", {"VALUE=41u"}).name(), "store [VALUE=41u]");
}

TEST_F(Programs, EachVariantIsCompiledOnce) {
    write_store("7u");
    ProgramLibrary library(folder_.root());
    const Program& plain = library.compute("store");
    EXPECT_EQ(&plain, &library.compute("store"));
    EXPECT_NE(&plain, &library.compute("store", {"VARIANT"}));
    EXPECT_EQ(library.program_count(), 2u);
}

TEST_F(Programs, AnErrorInsideAnIncludeIsReportedAtItsFileAndLine) {
    folder_.write("shared/wrong.h", "#pragma once\n\n\nuint wrong() { return missing_name; }\n");
    write_store("wrong()", "#include \"shared/wrong.h\"\n");
    ProgramLibrary library(folder_.root());
    const std::string message = catch_message<Error>([&] { library.compute("store", {"A", "B"}); });
    EXPECT_NE(message.find("shader store [A B] does not compile"), std::string::npos) << message;
    EXPECT_NE(message.find("shared/wrong.h:4:"), std::string::npos) << message;
    EXPECT_NE(message.find("missing_name"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(library.program_count(), 0u);
}

TEST_F(Programs, AnErrorAfterAnIncludeIsReportedAtItsOwnLine) {
    folder_.write("shared/right.h", "#pragma once\nuint right() { return 1u; }\n\n\n\n");
    write_store("right() + missing_name", "#include \"shared/right.h\"\n");
    ProgramLibrary library(folder_.root());
    const std::string message = catch_message<Error>([&] { library.compute("store"); });
    EXPECT_NE(message.find("passes/store.comp:4:"), std::string::npos) << message;
}

TEST_F(Programs, ALinkErrorIsReported) {
    folder_.write("passes/draw.vert", "out vec2 uv;\nvoid main() { uv = vec2(0); gl_Position = vec4(0); }\n");
    folder_.write("passes/draw.frag", "in vec3 uv;\nout vec4 colour;\nvoid main() { colour = uv.xyzz; }\n");
    ProgramLibrary library(folder_.root());
    const std::string message = catch_message<Error>([&] { library.graphics("draw"); });
    EXPECT_TRUE(message.starts_with("shader draw does not link: ")) << message;
    EXPECT_NE(message.find("uv"), std::string::npos) << message;
}

TEST_F(Programs, AnUnknownUniformIsAnErrorWhereAssertionsAreOn) {
    write_store("uint(known)", "uniform int known;\n");
    ProgramLibrary library(folder_.root());
    const Program& program = library.compute("store");
    program.set("known", 5);
#ifdef TARN_ASSERTIONS
    const std::string message = catch_message<Error>([&] { program.set("unknown", 6); });
    EXPECT_EQ(message, "shader store has no uniform 'unknown'");
#else
    program.set("unknown", 6);
#endif
    EXPECT_TRUE(program.has_uniform("known"));
    EXPECT_FALSE(program.has_uniform("unknown"));
    EXPECT_EQ(run(program), 5u);
    EXPECT_EQ(take_debug_errors(), std::vector<std::string>());
}

TEST_F(Programs, ReloadReplacesAProgramInPlace) {
    folder_.write("shared/value.h", "#define SHARED_VALUE 1u\n");
    write_store("SHARED_VALUE", "#include \"shared/value.h\"\n");
    ProgramLibrary library(folder_.root());
    const Program& program = library.compute("store");
    EXPECT_EQ(run(program), 1u);
    const GLuint old_id = program.id();
    EXPECT_EQ(library.reload(), "");
    EXPECT_EQ(program.id(), old_id) << "unchanged files must not be compiled again";
    folder_.write("shared/value.h", "#define SHARED_VALUE 2u\n");
    EXPECT_EQ(library.reload(), "");
    EXPECT_EQ(run(program), 2u);
}

TEST_F(Programs, ReloadKeepsTheOldProgramWhenTheNewOneIsBroken) {
    write_store("1u");
    ProgramLibrary library(folder_.root());
    const Program& program = library.compute("store");
    write_store("broken(");
    const std::string message = library.reload();
    EXPECT_NE(message.find("passes/store.comp:3:"), std::string::npos) << message;
    EXPECT_EQ(run(program), 1u);
    write_store("3u");
    EXPECT_EQ(library.reload(), "");
    EXPECT_EQ(run(program), 3u);
}

TEST_F(Programs, AMissingShaderFolderIsAnError) {
    EXPECT_THROW(ProgramLibrary(folder_.root() / "gone"), Error);
}

}  // namespace
}  // namespace tarn
