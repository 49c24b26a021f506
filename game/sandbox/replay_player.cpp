#include "replay_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <utility>
#include <vector>

#include "../session.h"

namespace game {
namespace {

void make_folder(const std::filesystem::path& folder) {
    std::error_code failure;
    if (!folder.empty()) std::filesystem::create_directories(folder, failure);
    if (failure)
        throw Error(fmt::format("{}: the folder cannot be made: {}", folder.string(), failure.message()));
}

// False once the user has closed the window.
bool present(View& view, Window& window) {
    window.poll_events();
    const Size size = window.framebuffer_size();
    if (size.width_px > 0 && size.height_px > 0) view.present(size.width_px, size.height_px);
    window.swap();
    return !window.should_close();
}

// The first frames find nothing to reuse, and build what later ones keep.
void print_times(std::vector<double> frame_ms) {
    constexpr std::size_t FIRST = 4;
    if (frame_ms.size() > FIRST) frame_ms.erase(frame_ms.begin(), frame_ms.begin() + FIRST);
    const auto middle = frame_ms.begin() + std::ptrdiff_t(frame_ms.size() / 2);
    std::nth_element(frame_ms.begin(), middle, frame_ms.end());
    fmt::print("median of {} frames: {:.1f} ms\n", frame_ms.size(), *middle);
}

void check_end(const Stage& stage, const Replay& replay, const std::filesystem::path& file) {
    if (!replay.is_complete) {
        fmt::print(
            stderr,
            "{}: cut off after {} steps: the state in which it ended is missing, nothing was verified\n",
            file.string(), replay.steps.size());
        return;
    }
    const std::uint64_t hash = compute_hash(stage.state());
    if (hash == replay.state_hash) return;
    throw Error(fmt::format("{}: the play ended in the state {:016x}, recorded was {:016x}", file.string(),
                            hash, replay.state_hash));
}

}  // namespace

StageLook make_look(const Replay& replay, const std::filesystem::path& file) {
    StageLook look;
    look.seed = replay.seed;
    try {
        for (const auto& [name, value] : replay.settings) look.settings.set(name, value);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", file.string(), error.what()));
    }
    return look;
}

void play_replay(Stage& stage, const Replay& replay, const ReplayOptions& options, Window* window) {
    const StageLook look = make_look(replay, options.file);
    if (stage.level_hash() != replay.level_hash) {
        throw Error(fmt::format("{}: recorded in the level {:016x}, the scene '{}' has {:016x}",
                                options.file.string(), replay.level_hash, replay.scene, stage.level_hash()));
    }
    make_folder(options.folder);
    const Engine engine = open_engine(window, options.threads);
    View view(engine, stage.scene(), replay.width_px, replay.height_px);
    const std::size_t every = std::size_t(options.every);
    std::uint32_t frame = 0;
    std::vector<double> frame_ms;
    for (std::size_t step = 0;; ++step) {
        if (step % every == 0) {
            if (options.stop && options.stop()) return;
            // All that a frame costs: moving the scene to the step, updating what the view keeps of it,
            // drawing.
            const auto start = std::chrono::steady_clock::now();
            stage.show();
            view.draw(stage.make_frame(look, frame, STEP_S * options.every));
            frame_ms.push_back(
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
            if (!options.folder.empty())
                view.write_png(options.folder / fmt::format("frame_{:06}.png", frame));
            if (window != nullptr && !present(view, *window)) return;
            ++frame;
        }
        if (step == replay.steps.size()) break;
        stage.step(replay.steps[step]);
    }
    if (options.prints_times) print_times(std::move(frame_ms));
    check_end(stage, replay, options.file);
}

}  // namespace game
