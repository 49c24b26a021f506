#include "sandbox.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <thread>
#include <utility>

#include "../session.h"

namespace game {
namespace {

constexpr double LONGEST_FRAME_S = 0.25;  // on a slower machine time goes slower, not farther a frame
constexpr auto RESIZE_DELAY = std::chrono::milliseconds(250);
constexpr auto MESSAGE_TIME = std::chrono::seconds(5);
constexpr auto AUTOSAVE_TIME = std::chrono::seconds(30);

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Sandbox::Sandbox(Window& window, std::unique_ptr<Stage> stage, const SandboxOptions& options)
    : options_(options),
      window_(window),
      engine_(open_engine(&window, options.threads)),
      source_(options.source),
      stage_(std::move(stage)),
      controls_(window, options.keys),
      widgets_(window) {
    look_.settings = options.settings;
    look_.preset = options.preset;
    look_.frame_ms = float(options.frame_ms);
    look_.fireflies = int(stage_->state().fireflies.size());
    facts_.shows_help = true;
    facts_.help = list_help(options.keys);
    if (!options.record.empty()) start_record();
    find_saves();
    if (options.continues) load(SaveKind::AUTOMATIC);
    window_.set_vsync(true);
    controls_.capture_mouse(true);
}

void Sandbox::start_record() {
    const Size size = window_.framebuffer_size();
    Replay head;
    head.scene = source_.scene;
    head.level_hash = stage_->level_hash();
    head.width_px = std::max(1, size.width_px);
    head.height_px = std::max(1, size.height_px);
    head.seed = options_.seed;
    head.fireflies = stage_->wished_fireflies();
    for (const SettingInfo& row : Settings::list())
        head.settings.emplace_back(row.name, options_.settings.get(row.name));
    recorder_ = std::make_unique<ReplayRecorder>(options_.record, head);
}

void Sandbox::run() {
    Clock::time_point last = Clock::now();
    while (!window_.should_close() && !(options_.stop && options_.stop())) {
        window_.poll_events();
        const double dt_s = seconds_since(last);
        last = Clock::now();
        if (recorder_) recorder_->flush_when_due();
        save_when_due();
        if (window_.is_minimized()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            continue;
        }
        follow_window_size();
        show_frame(dt_s);
    }
    end_record(compute_hash(stage_->state()));
    if (saves_ && stage_->state().step != saved_step_) saves_->write(SaveKind::AUTOMATIC, *stage_);
}

void Sandbox::find_saves() {
    if (!options_.saves.empty())
        saves_ = std::make_unique<Saves>(options_.saves, source_.scene, stage_->level_hash());
    saved_at_ = Clock::now();
}

void Sandbox::save() try {
    if (!saves_) return report("nothing can be saved: there is no folder for it");
    saves_->write(SaveKind::ASKED_FOR, *stage_);
    report("saved " + saves_->file(SaveKind::ASKED_FOR).string());
} catch (const Error& error) {
    report(error.what());
}

void Sandbox::load(SaveKind kind) try {
    const std::uint64_t before = compute_hash(stage_->state());
    if (!saves_ || !saves_->load(kind, *stage_))
        return report(kind == SaveKind::ASKED_FOR ? "nothing is saved in this level yet"
                                                  : "nothing to go on from in this level yet");
    // A record knows inputs alone.
    const std::string also = recorder_ ? "; the record has ended" : "";
    end_record(before);
    waiting_ = {};
    behind_s_ = 0.0;
    if (view_) view_->reset_history();
    report("loaded " + saves_->file(kind).string() + also);
} catch (const Error& error) {
    fmt::print(stderr, "tarn-sandbox: {}\n", error.what());
    report(error.what());
}

// What cannot be written now is said, and tried again later.
void Sandbox::save_when_due() try {
    if (!saves_ || Clock::now() - saved_at_ < AUTOSAVE_TIME) return;
    saved_at_ = Clock::now();
    if (std::exchange(saved_step_, stage_->state().step) == stage_->state().step) return;
    saves_->write(SaveKind::AUTOMATIC, *stage_);
} catch (const Error& error) {
    report(error.what());
}

void Sandbox::end_record(std::uint64_t state_hash) {
    if (recorder_) recorder_->end(state_hash);
    recorder_.reset();
}

// What cannot be opened leaves all as it is.
void Sandbox::open(const std::string& file) {
    try {
        const StageSource source = with_file(source_, file);
        std::unique_ptr<Stage> stage = load_stage(source);
        const Size size = window_.framebuffer_size();
        auto view = std::make_unique<View>(engine_, stage->scene(), std::max(1, size.width_px),
                                           std::max(1, size.height_px));
        // A record is of one level under one sky.
        const std::string also = recorder_ ? "; the record has ended" : "";
        end_record(compute_hash(stage_->state()));
        if (saves_) saves_->write(SaveKind::AUTOMATIC, *stage_);
        view_ = std::move(view);
        stage_ = std::move(stage);
        source_ = source;
        find_saves();
        look_.fireflies = int(stage_->state().fireflies.size());
        waiting_ = {};
        behind_s_ = 0.0;
        timings_.clear();
        report("opened " + file + also);
    } catch (const Error& error) {
        report(error.what());
    }
}

void Sandbox::follow_window_size() {
    const Size size = window_.framebuffer_size();
    if (size != wanted_size_) {
        wanted_size_ = size;
        wanted_since_ = Clock::now();
    }
    const bool fits = view_ && size == Size{view_->width_px(), view_->height_px()};
    // While the user drags the border the size changes with every frame.
    if (fits || (view_ && Clock::now() - wanted_since_ < RESIZE_DELAY)) return;
    view_ = std::make_unique<View>(engine_, stage_->scene(), std::max(1, size.width_px),
                                   std::max(1, size.height_px));
    timings_.clear();
}

void Sandbox::show_frame(double dt_s) {
    widgets_.begin();
    const Controls controls = controls_.read(dt_s);
    handle_controls(controls);
    play(controls, dt_s);
    draw(dt_s);
    draw_sandbox_panel(look_, facts_, stage_->state());
    const Size size = window_.framebuffer_size();
    view_->present(size.width_px, size.height_px);
    widgets_.end();
    window_.swap();
    update_title();
    ++frame_;
}

void Sandbox::handle_controls(const Controls& controls) {
    if (controls.leave && !controls_.has_mouse()) window_.request_close();
    const bool had_focus = std::exchange(has_focus_, window_.has_focus());
    if (controls.leave || (had_focus && !has_focus_)) controls_.capture_mouse(false);
    if (controls.pause) controls_.capture_mouse(!controls_.has_mouse());
    if (controls.panel) {
        facts_.shows_panel = !facts_.shows_panel;
        controls_.capture_mouse(!facts_.shows_panel);
    }
    // A click beside the panel goes on with the game.
    if (controls.click && !widgets_.wants_mouse()) controls_.capture_mouse(true);
    if (controls.help) facts_.shows_help = !facts_.shows_help;
    const bool begins = controls.play.forward != 0 || controls.play.right != 0;
    if (begins && stage_->state().step < 2 * STEPS_PER_S) facts_.shows_help = false;
    if (controls.fullscreen) window_.set_fullscreen(!window_.is_fullscreen());
    if (controls.screenshot || controls.radiance) save_screenshot(controls.radiance);
    if (controls.save) save();
    if (controls.load) load(SaveKind::ASKED_FOR);
    for (const std::string& file : controls.files) open(file);
    facts_.has_mouse = controls_.has_mouse();
}

void Sandbox::step(const StepInput& input) {
    stage_->step(input);
    if (recorder_) recorder_->add(input);
}

void Sandbox::play(const Controls& controls, double dt_s) {
    const Clock::time_point start = Clock::now();
    waiting_ = with_presses(controls.play, waiting_);
    if (controls_.has_mouse()) {
        behind_s_ += std::min(dt_s, LONGEST_FRAME_S);
    } else {
        behind_s_ = 0.0;
        waiting_ = {};
    }
    for (; behind_s_ >= STEP_S; behind_s_ -= STEP_S) step(std::exchange(waiting_, without_presses(waiting_)));
    facts_.step_ms = 1e3 * seconds_since(start);
    stage_->set_lit_fireflies(look_.fireflies);
    stage_->show();
}

// What is drawn with, which may be less than the user chose.
Settings Sandbox::govern(double dt_s) {
    const Ladder ladder(look_.settings);
    const int before = governor_.rung();
    // The first frame has none before it.
    const int rung = frame_ > 0 ? governor_.follow(1e3 * dt_s, look_.frame_ms, ladder.size()) : 0;
    if (rung != before) timings_.clear();
    facts_.rung = rung;
    facts_.rungs = ladder.size();
    facts_.rung_sentence = ladder.sentence(rung);
    return ladder.settings(rung);
}

void Sandbox::draw(double dt_s) {
    const StageLook look = {govern(dt_s), options_.seed, look_.glare_strength};
    facts_.report = view_->draw(stage_->make_frame(look, frame_, dt_s));
    timings_.add(facts_.report);
    facts_.cost = timings_.compute_medians();
    // The first frame has none before it.
    if (frame_ > 0) loop_s_ = loop_s_ == 0.0 ? dt_s : 0.9 * loop_s_ + 0.1 * dt_s;
    facts_.frames_per_s = loop_s_ > 0.0 ? 1.0 / loop_s_ : 0.0;
    facts_.width_px = view_->width_px();
    facts_.height_px = view_->height_px();
    if (Clock::now() - reported_at_ > MESSAGE_TIME) facts_.message.clear();
}

// For people, and for tests that look at it.
void Sandbox::update_title() {
    const PlayState& state = stage_->state();
    const Vec3& feet = state.player.feet;
    const auto balls = std::count_if(state.balls.begin(), state.balls.end(),
                                     [](const BallState& ball) { return ball.is_alive; });
    window_.set_title(
        fmt::format("Tarn sandbox: {} {}x{} x={:.2f} y={:.2f} z={:.2f} yaw={:.2f} balls={} lit={}/{} "
                    "fireflies={} {} "
                    "step={} rung={} frame={}",
                    source_.scene, facts_.width_px, facts_.height_px, feet.x, feet.y, feet.z,
                    state.player.yaw_rad, balls, state.relit_count, state.dead_count, look_.fireflies,
                    facts_.has_mouse ? "playing" : "paused", state.step, facts_.rung, frame_));
}

void Sandbox::save_screenshot(bool as_radiance) {
    if (frame_ == 0) return;
    try {
        const std::filesystem::path file = find_new_picture("sandbox", as_radiance ? "exr" : "png");
        if (as_radiance) {
            view_->read().write_exr(file);
        } else {
            view_->write_png(file);
        }
        report("wrote " + file.string());
    } catch (const Error& error) {
        report(error.what());
    }
}

void Sandbox::report(const std::string& message) {
    facts_.message = message;
    reported_at_ = Clock::now();
}

}  // namespace game
