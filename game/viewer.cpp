#include "viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "session.h"

namespace game {
namespace {

constexpr double LONGEST_STEP_S = 0.5;  // a stall (a shader that compiles) is no leap
constexpr auto RESIZE_DELAY = std::chrono::milliseconds(250);
constexpr auto MESSAGE_TIME = std::chrono::seconds(5);
constexpr auto TITLE_INTERVAL = std::chrono::milliseconds(100);

double aspect_of(const Size& size) {
    return double(std::max(1, size.width_px)) / std::max(1, size.height_px);
}

std::string describe_extent(const Box& bounds) {
    const bool is_empty = bounds.lower.x > bounds.upper.x;
    const Vec3 extent = is_empty ? Vec3() : bounds.upper - bounds.lower;
    return fmt::format("{:.4g} x {:.4g} x {:.4g} m", extent.x, extent.y, extent.z);
}

}  // namespace

Viewer::Viewer(Window& window, Scene scene, const ViewerOptions& options)
    : options_(options),
      window_(window),
      engine_(open_engine(&window, options.threads)),
      scene_(std::move(scene)),
      overlay_(window) {
    state_.settings = options.settings;
    state_.preset = options.preset;
    state_.view = options.view;
    state_.auto_exposure = !options.exposure_ev;
    state_.exposure_ev = options.exposure_ev.value_or(0.0f);
    state_.tone = options.tone;
    state_.glare_strength = float(options.glare_strength);
    state_.seed = options.seed;
    state_.playing = scene_.duration_s() > 0.0 && options.time_s < 0.0;
    state_.time_s = std::max(0.0, options.time_s);
    posed_time_s_ = options.time_s;
    const Camera start =
        options.camera ? *options.camera : scene_.default_camera(aspect_of(window.framebuffer_size()));
    camera_ = start_flying(start, default_speed_m_s(scene_.bounds()));
    state_.fly_speed_m_s = float(camera_.speed_m_s);
    if (!options.camera && scene_.camera_count() > 0) facts_.followed_camera = 0;
    collect_scene_facts();
    window_.set_vsync(true);
}

void Viewer::collect_scene_facts() {
    facts_.scene_name = options_.scene_name;
    facts_.animation_duration_s = scene_.duration_s();
    for (std::size_t i = 0; i < scene_.camera_count(); ++i) {
        const std::string name = scene_.camera_name(i);
        facts_.camera_names.push_back(name.empty() ? fmt::format("camera {}", i) : name);
    }
    const SceneFacts facts = scene_.facts();
    facts_.scene_facts = {
        {"triangles", fmt::format("{}", facts.triangles)},
        {"instances", fmt::format("{}", facts.instances)},
        {"materials", fmt::format("{}", facts.materials)},
        {"textures", fmt::format("{}", facts.textures)},
        {"lights", fmt::format("{} punctual, {} triangles", facts.punctual_lights, facts.light_triangles)},
        {"sky",
         facts.sky_width_px == 0 ? "none" : fmt::format("{}x{}", facts.sky_width_px, facts.sky_height_px)},
        {"extent", describe_extent(scene_.bounds())},
        {"driver", engine_.device_name()},
    };
}

void Viewer::run() {
    Clock::time_point last = Clock::now();
    while (!window_.should_close() && !(options_.stop && options_.stop())) {
        window_.poll_events();
        if (window_.is_minimized()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            last = Clock::now();
            continue;
        }
        const Clock::time_point now = Clock::now();
        const double dt_s = std::chrono::duration<double>(now - last).count();
        last = now;
        follow_window_size();
        show_frame(dt_s);
        if (options_.frames > 0 && frame_ >= std::uint32_t(options_.frames)) break;
    }
    if (!options_.screenshot.empty() && has_picture_) view_->write_png(options_.screenshot);
}

void Viewer::make_view(const Size& size) {
    // The old one lives until the new one works.
    view_ = std::make_unique<View>(engine_, scene_, size.width_px, size.height_px);
    has_picture_ = false;
    timings_.clear();
}

void Viewer::follow_window_size() {
    const Size window = window_.framebuffer_size();
    const Size size = {std::max(1, window.width_px), std::max(1, window.height_px)};
    if (!view_) return make_view(size);
    if (size != wanted_size_) {
        wanted_size_ = size;
        wanted_since_ = Clock::now();
    }
    const bool fits = size == Size{view_->width_px(), view_->height_px()};
    // While the user drags the border the size changes with every frame.
    if (fits || size == failed_size_ || Clock::now() - wanted_since_ < RESIZE_DELAY) return;
    try {
        make_view(size);
    } catch (const Error& error) {
        failed_size_ = size;
        report(error.what(), true);
    }
}

void Viewer::show_frame(double dt_s) {
    const double step_s = std::min(dt_s, LONGEST_STEP_S);
    handle_input(overlay_.begin(), step_s);
    move_scene(step_s);
    collect_facts(draw_frame(dt_s), dt_s);
    apply_panel();
    const Size window = window_.framebuffer_size();
    view_->present(window.width_px, window.height_px);
    overlay_.end();
    window_.swap();
    update_title();
    ++frame_;
}

void Viewer::handle_input(const ViewerInput& input, double dt_s) {
    if (input.close) window_.request_close();
    if (input.toggle_panel) state_.panel_visible = !state_.panel_visible;
    if (input.toggle_animation) state_.playing = !state_.playing;
    if (input.reload_shaders) reload_shaders();
    if (input.screenshot) save_screenshot();
    camera_.speed_m_s = state_.fly_speed_m_s;
    camera_ = fly(camera_, input.fly, dt_s);
    state_.fly_speed_m_s = float(camera_.speed_m_s);
    if (input.fly.moves_camera()) facts_.followed_camera.reset();
}

void Viewer::move_scene(double dt_s) {
    if (facts_.animation_duration_s <= 0.0) return;
    if (state_.playing) {
        state_.time_s = std::fmod(state_.time_s + dt_s * state_.animation_speed, facts_.animation_duration_s);
    }
    const bool moved = state_.playing || state_.time_s != std::max(0.0, posed_time_s_);
    if (!moved) return;
    posed_time_s_ = state_.time_s;
    scene_.move_to(posed_time_s_);
    if (facts_.followed_camera) follow_camera(*facts_.followed_camera);
}

void Viewer::follow_camera(std::size_t index) {
    camera_ = start_flying(scene_.camera(index), camera_.speed_m_s);
    facts_.followed_camera = index;
}

FrameReport Viewer::draw_frame(double dt_s) {
    Frame frame;
    frame.camera = to_camera(camera_);
    frame.number = frame_;
    frame.seed = state_.seed;
    frame.settings = state_.settings;
    frame.display.view = state_.view;
    frame.display.tone = state_.tone;
    frame.display.glare_strength = state_.glare_strength;
    const Size size{view_->width_px(), view_->height_px()};
    const bool rests = rest_.is_at_rest({camera_, state_.settings, state_.seed, state_.time_s, size});
    if (rests && state_.converge) {
        frame.average = true;
        frame.settings = state_.settings.fresh();
    }
    if (!state_.auto_exposure) frame.display.exposure_ev = state_.exposure_ev;
    frame.display.elapsed_s = dt_s;
    FrameReport report = view_->draw(frame);
    state_.exposure_ev = view_->exposure_ev();
    has_picture_ = true;
    return report;
}

void Viewer::collect_facts(FrameReport report, double dt_s) {
    timings_.add(report);
    facts_.report = std::move(report);
    facts_.cost = timings_.compute_medians();
    // The first frame has none before it.
    if (frame_ > 0) loop_s_ = loop_s_ == 0.0 ? dt_s : 0.9 * loop_s_ + 0.1 * dt_s;
    facts_.frames_per_s = loop_s_ > 0.0 ? 1.0 / loop_s_ : 0.0;
    facts_.width_px = view_->width_px();
    facts_.height_px = view_->height_px();
    const double tracing_s = 1e-3 * facts_.cost.compute_tracing_ms();
    const std::uint64_t rays =
        facts_.report.shadow_rays + facts_.report.closest_rays + facts_.report.camera_rays;
    facts_.rays_per_s = tracing_s > 0.0 ? double(rays) / tracing_s : 0.0;
    facts_.camera_position_ws = camera_.position_ws;
    // Errors stay until the next message.
    if (!facts_.message_is_error && Clock::now() - reported_at_ > MESSAGE_TIME) facts_.message.clear();
}

void Viewer::apply_panel() {
    const PanelActions actions = draw_panel(state_, facts_);
    if (actions.camera) follow_camera(*actions.camera);
    if (actions.screenshot) save_screenshot();
    if (actions.reload_shaders) reload_shaders();
}

void Viewer::update_title() {
    if (Clock::now() - titled_at_ < TITLE_INTERVAL) return;
    titled_at_ = Clock::now();
    std::string title = fmt::format("Tarn: {} {}x{}", facts_.scene_name, facts_.width_px, facts_.height_px);
    for (const SettingInfo& row : facts_.settings) {
        title += fmt::format(" {}={}", row.name, state_.settings.get(row.name));
    }
    window_.set_title(title + fmt::format(" view={} frame={}", state_.view, frame_));
}

void Viewer::reload_shaders() {
    const std::string errors = view_->reload_shaders();
    report(errors.empty() ? "shaders are up to date" : errors, !errors.empty());
}

void Viewer::save_screenshot() {
    if (!has_picture_) return;
    try {
        const std::filesystem::path file = state_.screenshot_file.empty()
                                               ? find_new_picture("screenshot")
                                               : std::filesystem::path(state_.screenshot_file);
        view_->write_png(file);
        report("wrote " + file.string(), false);
    } catch (const Error& error) {
        report(error.what(), true);
    }
}

void Viewer::report(const std::string& message, bool is_error) {
    facts_.message = message;
    facts_.message_is_error = is_error;
    reported_at_ = Clock::now();
}

}  // namespace game
