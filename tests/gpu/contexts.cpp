// Every kind of context starts, computes, coexists with the others, and says clearly why it cannot start.
#include "platform/context.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "core/error.h"
#include "gl/buffer.h"
#include "gl/fence.h"
#include "gl/program_library.h"
#include "gpu/shader_folder.h"
#include "platform/environment.h"

namespace tarn {
namespace {

bool has_display() {
    return get_environment("DISPLAY").has_value();
}

std::unique_ptr<Context> create(ContextKind kind, int gl_threads = 0) {
    ContextOptions options;
    options.kind = kind;
    options.gl_threads = gl_threads;
    options.debug = true;
    return create_context(options);
}

// Squares of 0..999 plus `offset`, by a compute shader on the current context.
std::vector<std::uint32_t> compute_squares(unsigned offset) {
    const ShaderFolder folder;
    folder.write("passes/square.comp", R"(
        layout(local_size_x = 64) in;
        layout(std430, binding = 0) writeonly buffer Squares { uint squares[]; };
        uniform uint offset;
        void main() {
            uint i = gl_GlobalInvocationID.x;
            if (i < squares.length()) squares[i] = i * i + offset;
        })");
    ProgramLibrary library(folder.root());
    const Buffer squares("squares", 1000 * sizeof(std::uint32_t), BufferUse::SHARED);
    const Program& program = library.compute("square");
    program.set("offset", offset);
    program.use();
    squares.bind_storage(0);
    glDispatchCompute(16, 1, 1);
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    Fence().wait();
    const auto mapped = squares.mapped<std::uint32_t>();
    return {mapped.begin(), mapped.end()};
}

void expect_computes(unsigned offset) {
    std::vector<std::uint32_t> expected;
    for (unsigned i = 0; i < 1000; ++i) expected.push_back(i * i + offset);
    EXPECT_EQ(compute_squares(offset), expected);
    EXPECT_EQ(take_debug_errors(), std::vector<std::string>());
}

int count_threads_named(const std::string& prefix) {
    int count = 0;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
        std::string name;
        std::getline(std::ifstream(task.path() / "comm"), name);
        count += name.starts_with(prefix);
    }
    return count;
}

TEST(Contexts, EglComputes) {
    const auto context = create(ContextKind::EGL);
    EXPECT_EQ(context->kind(), ContextKind::EGL);
    expect_computes(1);
}

TEST(Contexts, OsmesaComputesOnLlvmpipe) {
    const auto context = create(ContextKind::OSMESA);
    EXPECT_NE(context->device_info().renderer.find("llvmpipe"), std::string::npos)
        << context->device_info().renderer;
    EXPECT_TRUE(context->device_info().is_software);
    EXPECT_NE(context->device_info().mesa_version, "");
    expect_computes(2);
}

TEST(Contexts, WindowComputes) {
    if (!has_display()) GTEST_SKIP() << "no DISPLAY: the test contexts_in_xvfb brings its own";
    const auto context = create(ContextKind::GLFW);
    EXPECT_EQ(context->kind(), ContextKind::GLFW);
    expect_computes(3);
}

TEST(Contexts, WindowAndEglLiveSideBySide) {
    if (!has_display()) GTEST_SKIP() << "no DISPLAY: the test contexts_in_xvfb brings its own";
    const auto window = create(ContextKind::GLFW);
    const auto egl = create(ContextKind::EGL);
    expect_computes(4);
    window->make_current();
    expect_computes(5);
}

TEST(Contexts, OneAfterTheOther) {
    for (const ContextKind kind : {ContextKind::EGL, ContextKind::OSMESA, ContextKind::EGL}) {
        const auto context = create(kind);
        expect_computes(6);
    }
}

TEST(Contexts, TwoAliveTakeTurns) {
    const auto egl = create(ContextKind::EGL);
    auto osmesa = create(ContextKind::OSMESA);
    expect_computes(7);
    egl->make_current();
    expect_computes(8);
    osmesa->make_current();
    expect_computes(9);
    osmesa.reset();
    egl->make_current();
    expect_computes(10);
}

TEST(Contexts, TheFirstOfTwoEglContextsMayDieFirst) {
    auto first = create(ContextKind::EGL);
    const auto second = create(ContextKind::EGL);
    first.reset();
    second->make_current();
    expect_computes(11);
}

// Threads name themselves once they run: waits for up to two seconds.
void expect_threads_named(const std::string& prefix, int expected) {
    for (int i = 0; i < 200 && count_threads_named(prefix) != expected; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(count_threads_named(prefix), expected);
}

TEST(Contexts, GlThreadsLimitsTheWorkersOfLlvmpipe) {
    const int before = count_threads_named("llvmpipe-");
    for (const int gl_threads : {1, 2, 3}) {
        const auto context = create(ContextKind::EGL, gl_threads);
        if (context->device_info().renderer.find("llvmpipe") == std::string::npos)
            GTEST_SKIP() << "not llvmpipe: " << context->device_info().renderer;
        expect_threads_named("llvmpipe-", before + gl_threads);
        expect_computes(12);
    }
}

TEST(Contexts, GlThreadsLeavesTheEnvironmentAsItWas) {
    const ScopedEnvironment before("LP_NUM_THREADS", "2");
    const auto context = create(ContextKind::EGL, 1);
    EXPECT_EQ(get_environment("LP_NUM_THREADS"), "2");
}

TEST(Contexts, NoDisplayIsAnErrorThatNamesTheWayOut) {
    const ScopedEnvironment no_display("DISPLAY", "");
    const ScopedEnvironment no_wayland("WAYLAND_DISPLAY", "");
    const std::string message = catch_message<Error>([] { create(ContextKind::GLFW); });
    EXPECT_NE(message.find("set DISPLAY or use --context egl"), std::string::npos) << message;
}

// In a process of its own, because drivers read their environment once: exits with 1 and the message on an
// Error.
[[noreturn]] void create_and_exit(ContextKind kind, const char* variable, const char* value) {
    setenv(variable, value, 1);
    try {
        create(kind);
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        std::exit(1);
    }
    std::exit(0);
}

TEST(ContextsDeathTest, NoEglDriverIsAnError) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(create_and_exit(ContextKind::EGL, "__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent"),
                testing::ExitedWithCode(1), "EGL has no OpenGL 4.5 core context: .+");
}

TEST(ContextsDeathTest, AnOlderGlIsRefusedWithItsVersion) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    if (create(ContextKind::EGL)->device_info().mesa_version.empty()) GTEST_SKIP() << "only Mesa can pretend";
    for (const ContextKind kind : {ContextKind::EGL, ContextKind::OSMESA})
        EXPECT_EXIT(create_and_exit(kind, "MESA_GL_VERSION_OVERRIDE", "3.3"), testing::ExitedWithCode(1),
                    "Tarn needs OpenGL 4.5 core, the .+ context offers OpenGL 3.3 ");
}

TEST(Contexts, AnEglDeviceThatDoesNotExistIsAnError) {
    const ScopedEnvironment choice("TARN_EGL_DEVICE", "12345");
    const std::string message = catch_message<Error>([] { create(ContextKind::EGL); });
    EXPECT_NE(message.find("TARN_EGL_DEVICE is '12345'"), std::string::npos) << message;
}

TEST(Contexts, KindsHaveNames) {
    for (const ContextKind kind : {ContextKind::EGL, ContextKind::GLFW, ContextKind::OSMESA})
        EXPECT_EQ(parse_context_kind(context_kind_name(kind)), kind);
    EXPECT_THROW(parse_context_kind("vulkan"), Error);
}

TEST(Contexts, LimitsAreAtLeastWhatTheDesignCountsOn) {
    const auto context = create(ContextKind::EGL);
    const DeviceLimits& limits = context->device_info().limits;
    EXPECT_GE(limits.workgroup_invocations, 1024);
    EXPECT_GE(limits.workgroup_shared_bytes, 32 * 1024);
    EXPECT_GE(limits.storage_block_bytes, 128 << 20);
    EXPECT_GE(limits.texture_side_px, 16384);
    EXPECT_GE(limits.workgroup_count[0], 65535);
}

}  // namespace
}  // namespace tarn
