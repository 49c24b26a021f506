#include "viewer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include "core/display.h"
#include "core/error.h"
#include "image_io/image_io.h"
#include "interrupt.h"

namespace tarn {
namespace {

constexpr double LONGEST_STEP_S = 0.5;  // a stall (a shader that compiles) is no leap
constexpr auto RESIZE_DELAY = std::chrono::milliseconds(250);
constexpr auto MESSAGE_TIME = std::chrono::seconds(5);
constexpr auto TITLE_INTERVAL = std::chrono::milliseconds(100);

std::unique_ptr<Context> open_window(const RenderOptions& options) {
    if (options.context != "glfw") {
        throw Error(
            "tarn view shows a window: --context is '{}', it must be glfw; without a window use 'tarn "
            "render' "
            "or 'tarn flythrough'",
            options.context);
    }
    ContextOptions context;
    context.kind = ContextKind::GLFW;
    context.gl_threads = options.scene.threads;
    context.window_title = "Tarn";
    context.window_width_px = options.scene.width;
    context.window_height_px = options.scene.height;
    context.window_visible = true;
    try {
        return create_context(context);
    } catch (const Error& error) {
        throw Error("{}; 'tarn render' and 'tarn flythrough' need no display", error.what());
    }
}

double longest_animation_s(const Scene& scene) {
    double duration_s = 0.0;
    for (const Animation& animation : scene.animations)
        duration_s = std::max(duration_s, animation.duration_s);
    return duration_s;
}

std::filesystem::path find_new_name() {
    const std::filesystem::path folder = "out";
    create_folder(folder);
    for (int i = 1;; ++i) {
        const std::filesystem::path file = folder / fmt::format("screenshot_{:04}.png", i);
        if (!std::filesystem::exists(file)) return file;
    }
}

// Rays of all kinds over the time of the passes that trace them.
double count_rays_per_s(const FrameOutput& output, const FrameTimings& timings) {
    double ms = 0.0;
    for (const PassTiming& pass : timings.passes) {
        if (pass.is_on_cpu && pass.name != "lights/tree") ms += pass.ms;
    }
    return ms > 0.0 ? double(output.shadow_rays.traced + output.closest_rays) / (ms * 1e-3) : 0.0;
}

}  // namespace

Viewer::Viewer(const ViewOptions& options)
    : options_(options),
      workers_(options.render.scene.threads),
      loaded_(load_scene(options.render.scene)),
      context_(open_window(options.render)),
      window_(*context_->window()),
      tracer_(create_embree_tracer(loaded_.world)),
      overlay_(window_) {
    const SceneOptions& scene_options = options.render.scene;
    state_.settings = options.render.settings;
    state_.view = options.view;
    state_.auto_exposure = !options.render.exposure_ev;
    state_.exposure_ev = options.render.exposure_ev.value_or(0.0f);
    state_.seed = scene_options.seed;
    state_.resolution_percent = options.resolution_percent;
    state_.playing = longest_animation_s(loaded_.scene) > 0.0 && scene_options.time_s < 0.0;
    state_.time_s = std::max(0.0, scene_options.time_s);
    posed_time_s_ = scene_options.time_s;
    tracer_->update(loaded_.world);
    camera_ = start_flying(choose_camera(scene_options, loaded_.scene, loaded_.world), loaded_.world);
    state_.fly_speed_m_s = float(camera_.speed_m_s);
    if (scene_options.camera.empty() && !loaded_.scene.cameras.empty()) facts_.followed_camera = 0;
    collect_scene_facts();
    window_.set_vsync(true);
}

void Viewer::collect_scene_facts() {
    const Scene& scene = loaded_.scene;
    const World& world = loaded_.world;
    facts_.scene_name = options_.render.scene.scene.stem().string();
    facts_.animation_duration_s = longest_animation_s(scene);
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const std::string& name = scene.cameras[i].name;
        facts_.camera_names.push_back(name.empty() ? fmt::format("camera {}", i) : name);
    }
    std::uint64_t triangles = 0;
    for (const WorldInstance& instance : world.instances)
        triangles += world.meshes[instance.mesh].triangle_count;
    const glm::dvec3 extent = world.bounds.empty() ? glm::dvec3(0.0) : world.bounds.extent();
    facts_.scene_facts = {
        {"triangles", fmt::format("{}", triangles)},
        {"instances", fmt::format("{}", world.instances.size())},
        {"materials", fmt::format("{}", scene.materials.size())},
        {"textures", fmt::format("{}", scene.images.size())},
        {"lights", fmt::format("{} punctual, {} triangles", world.lights.punctual_count,
                               world.lights.count - world.lights.punctual_count)},
        {"sky", world.environment.width == 0
                    ? "none"
                    : fmt::format("{}x{}", world.environment.width, world.environment.height)},
        {"extent", fmt::format("{:.4g} x {:.4g} x {:.4g} m", extent.x, extent.y, extent.z)},
        {"driver", context_->device_info().renderer},
    };
}

void Viewer::run() {
    const std::atomic<bool>& interrupted = interrupt_flag();
    Clock::time_point last = Clock::now();
    while (!window_.should_close() && !interrupted) {
        window_.poll_events();
        if (overlay_.is_minimized()) {
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
    if (!options_.screenshot.empty() && picture_ != nullptr) write_picture(options_.screenshot);
}

void Viewer::make_renderer(const glm::ivec2& size_px) {
    // The old one lives until the new one works.
    auto renderer = std::make_unique<Renderer>(loaded_.world, *tracer_, size_px.x, size_px.y);
    renderer_ = std::move(renderer);
    picture_ = nullptr;
    timings_.clear();
}

void Viewer::follow_window_size() {
    const glm::ivec2 window_px = window_.framebuffer_size_px();
    const glm::ivec2 size_px = glm::max(glm::ivec2(1), window_px * state_.resolution_percent / 100);
    if (!renderer_) return make_renderer(size_px);
    if (size_px != wanted_size_px_) {
        wanted_size_px_ = size_px;
        wanted_since_ = Clock::now();
    }
    const bool fits = size_px == glm::ivec2(renderer_->width_px(), renderer_->height_px());
    // While the user drags the border the size changes with every frame.
    if (fits || size_px == failed_size_px_ || Clock::now() - wanted_since_ < RESIZE_DELAY) return;
    try {
        make_renderer(size_px);
    } catch (const Error& error) {
        failed_size_px_ = size_px;
        report(error.what(), true);
    }
}

void Viewer::show_frame(double dt_s) {
    const double step_s = std::min(dt_s, LONGEST_STEP_S);
    handle_input(overlay_.begin(), step_s);
    move_scene(step_s);
    const FrameOutput output = render_frame(dt_s);
    picture_ = output.display;
    if (state_.auto_exposure) state_.exposure_ev = renderer_->read_exposure_ev();
    collect_facts(output, dt_s);
    apply_panel();
    present(*picture_, window_.framebuffer_size_px());
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
    const FlyInput fly_input{input.move, input.fast, input.look_px, input.wheel_steps};
    camera_.speed_m_s = state_.fly_speed_m_s;
    camera_ = fly(camera_, fly_input, dt_s);
    state_.fly_speed_m_s = float(camera_.speed_m_s);
    if (fly_input.moves_camera()) facts_.followed_camera.reset();
}

void Viewer::move_scene(double dt_s) {
    if (facts_.animation_duration_s <= 0.0) return;
    if (state_.playing) {
        state_.time_s = std::fmod(state_.time_s + dt_s * state_.animation_speed, facts_.animation_duration_s);
    }
    const bool moved = state_.playing || state_.time_s != std::max(0.0, posed_time_s_);
    if (!moved) return;
    posed_time_s_ = state_.time_s;
    update_world(loaded_.world, loaded_.scene, posed_time_s_);
    tracer_->update(loaded_.world);
    renderer_->update();
    if (facts_.followed_camera) follow_camera(*facts_.followed_camera);
}

void Viewer::follow_camera(std::size_t index) {
    const double aspect = double(renderer_->width_px()) / renderer_->height_px();
    const auto record =
        scene_camera(loaded_.scene, loaded_.world, CameraIndex(std::uint32_t(index)), aspect, posed_time_s_);
    if (!record) return;
    const double speed_m_s = camera_.speed_m_s;
    camera_ = start_flying(*record, loaded_.world);
    camera_.speed_m_s = speed_m_s;
    facts_.followed_camera = index;
}

FrameOutput Viewer::render_frame(double dt_s) {
    FrameInput input;
    input.camera =
        camera_record(camera_, loaded_.world, double(renderer_->width_px()) / renderer_->height_px());
    input.frame = frame_;
    input.seed = state_.seed;
    input.settings = state_.settings;
    DisplayInput& display = input.display.emplace();
    display.view = state_.view;
    if (!state_.auto_exposure) display.exposure.fixed_ev = state_.exposure_ev;
    display.exposure.elapsed_s = dt_s;
    return renderer_->render(input);
}

void Viewer::collect_facts(const FrameOutput& output, double dt_s) {
    timings_.add(output.timings);
    facts_.timings = timings_.medians();
    // The first frame has none before it.
    if (frame_ > 0) loop_s_ = loop_s_ == 0.0 ? dt_s : 0.9 * loop_s_ + 0.1 * dt_s;
    facts_.frames_per_s = loop_s_ > 0.0 ? 1.0 / loop_s_ : 0.0;
    facts_.width_px = renderer_->width_px();
    facts_.height_px = renderer_->height_px();
    facts_.shadow_rays = output.shadow_rays.traced;
    facts_.rays_per_s = count_rays_per_s(output, facts_.timings);
    facts_.triangles_drawn = output.raster.triangles_drawn;
    facts_.triangles_total = output.raster.triangles_total;
    facts_.counters = renderer_->read_counters();
    facts_.plan = &renderer_->plan();
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
    for (const Setting& setting : setting_table()) {
        title += fmt::format(" {}={}", setting.name, setting.format(state_.settings));
    }
    window_.set_title(
        title + fmt::format(" view={} frame={}", display_views()[std::size_t(state_.view)].name, frame_));
}

void Viewer::reload_shaders() {
    const std::string errors = renderer_->reload_shaders();
    report(errors.empty() ? "shaders are up to date" : errors, !errors.empty());
}

void Viewer::save_screenshot() {
    if (picture_ == nullptr) return;
    try {
        const std::filesystem::path file =
            state_.screenshot_file.empty() ? find_new_name() : std::filesystem::path(state_.screenshot_file);
        write_picture(file);
        report("wrote " + file.string(), false);
    } catch (const Error& error) {
        report(error.what(), true);
    }
}

void Viewer::write_picture(const std::filesystem::path& file) const {
    const std::vector<glm::u8vec4> texels = picture_->download<glm::u8vec4>();
    Image image(picture_->width_px(), picture_->height_px(), 3);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        for (int c = 0; c < 3; ++c) image.values[3 * i + c] = float(texels[i][c]) / 255.0f;
    }
    write_png(file, image);
}

void Viewer::report(const std::string& message, bool is_error) {
    facts_.message = message;
    facts_.message_is_error = is_error;
    reported_at_ = Clock::now();
}

}  // namespace tarn
