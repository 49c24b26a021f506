// The sandbox in a window: a person plays, and what they do may be recorded.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "../play/replay_recorder.h"
#include "../recent_timings.h"
#include "../widgets.h"
#include "controls.h"
#include "governor.h"
#include "sandbox_panel.h"
#include "saves.h"
#include "stage_source.h"

namespace game {

struct SandboxOptions {
    StageSource source;  // of the stage
    Settings settings;
    std::string preset;
    std::uint32_t seed = 0;
    int threads = 0;               // as for EngineOptions
    double frame_ms = 0.0;         // what a frame may take (Governor); 0: as long as it does
    std::filesystem::path record;  // written while it is played; empty: nothing
    std::filesystem::path saves;   // the folder of saves; empty: nothing is saved
    KeyMap keys;
    bool continues = false;      // begins where the automatic save is, if there is one
    std::function<bool()> stop;  // asked before each frame; true: quit. Empty: never
};

class Sandbox {
  public:
    // Draws in the window, which must outlive it. Error where its OpenGL does not do, or the record cannot be
    // written.
    Sandbox(Window& window, std::unique_ptr<Stage> stage, const SandboxOptions& options);

    // Until the user quits. Error where the record, or the automatic save at the end, cannot be written.
    void run();

    // For those whom SandboxOptions::stop asks.
    const Stage& stage() const { return *stage_; }
    const StageSource& source() const { return source_; }
    const std::string& message() const { return facts_.message; }

  private:
    using Clock = std::chrono::steady_clock;

    void follow_window_size();
    void show_frame(double dt_s);
    void handle_controls(const Controls& controls);
    void play(const Controls& controls, double dt_s);
    void step(const StepInput& input);
    void draw(double dt_s);
    Settings govern(double dt_s);
    void update_title();
    void save_screenshot(bool as_radiance);
    void report(const std::string& message);
    void open(const std::string& file);
    void start_record();
    void end_record(std::uint64_t state_hash);
    void find_saves();
    void save();
    void load(SaveKind kind);
    void save_when_due();

    SandboxOptions options_;
    Window& window_;
    Engine engine_;
    StageSource source_;
    std::unique_ptr<Stage> stage_;
    ControlReader controls_;  // before the widgets, which pass on what they get
    Widgets widgets_;
    std::unique_ptr<View> view_;

    SandboxSettings look_;
    SandboxFacts facts_;
    RecentTimings timings_;
    Governor governor_;
    std::unique_ptr<ReplayRecorder> recorder_;  // null: nothing is recorded
    std::unique_ptr<Saves> saves_;              // of this level; null: nothing is saved
    std::uint64_t saved_step_ = 0;              // of the last automatic save
    Clock::time_point saved_at_;
    StepInput waiting_;      // pressed, and no step has come since
    double behind_s_ = 0.0;  // of the simulation
    double loop_s_ = 0.0;    // from frame to frame, smoothed
    std::uint32_t frame_ = 0;
    bool has_focus_ = false;
    Size wanted_size_;  // and since when
    Clock::time_point wanted_since_;
    Clock::time_point reported_at_;
};

}  // namespace game
