// The engine and its views: the one file that knows the renderer.
#include "tarn/engine.h"

#include <algorithm>
#include <optional>

#include "api/gl_state.h"
#include "api/guard.h"
#include "api/scene_state.h"
#include "api/settings_access.h"
#include "core/data_files.h"
#include "image_io/image_io.h"
#include "passes/display.h"
#include "platform/context.h"
#include "rays/ray_tracer.h"
#include "renderer/renderer.h"

namespace tarn::api {
namespace {

constexpr int MAX_SIZE_PX = 16384;

std::unique_ptr<Context> open_context(const EngineOptions& options) {
    if (options.gl_loader != nullptr) return create_borrowed_context(options.gl_loader);
    ContextOptions context;
    context.gl_threads = options.threads;
    return create_context(context);
}

FrameReport describe_frame(const FrameOutput& output, const Renderer& renderer) {
    FrameReport report;
    report.frame_ms = output.timings.frame_ms;
    for (const PassTiming& pass : output.timings.passes) {
        const bool traces_rays = pass.is_on_cpu && pass.name != "lights/tree";
        report.passes.push_back({pass.name, pass.ms, traces_rays});
    }
    report.shadow_rays = output.shadow_rays.traced;
    report.closest_rays = output.closest_rays;
    report.camera_rays = output.camera_rays;
    report.triangles_drawn = output.raster.triangles_drawn;
    report.triangles_total = output.raster.triangles_total;
    report.averaged_frames = renderer.averaged_frames();
    report.relative_error = renderer.read_relative_error();
    report.counters = renderer.read_counters();
    for (const FeatureReason& entry : renderer.plan().feature_reasons)
        report.plan.push_back({entry.define, entry.reason});
    return report;
}

}  // namespace

struct EngineState {
    explicit EngineState(const EngineOptions& options)
        : workers(options.threads), context(open_context(options)) {}

    // What GL calls need around them: the engine's context, or the caller's state put aside.
    std::optional<GlStateGuard> enter() {
        if (context->kind() == ContextKind::BORROWED) return std::optional<GlStateGuard>(std::in_place);
        if (!context->is_current()) context->make_current();
        return std::nullopt;
    }

    WorkerLimit workers;
    std::unique_ptr<Context> context;
};

Engine::Engine(const EngineOptions& options) {
    guard([&] {
        if (options.threads < 0) throw tarn::Error("threads is {}, it must be 0 or more", options.threads);
        if (!options.data_folder.empty()) set_data_root(options.data_folder);
        get_shader_root();
        state_ = std::make_shared<EngineState>(options);
    });
}

Engine::Engine(Engine&& other) noexcept = default;
Engine& Engine::operator=(Engine&& other) noexcept = default;
Engine::~Engine() = default;

const std::string& Engine::device_name() const {
    return state_->context->device_info().renderer;
}

struct ViewState final : SceneFollower {
    ViewState(std::shared_ptr<EngineState> engine_state, std::shared_ptr<SceneState> scene_state,
              int width_px, int height_px)
        : engine(std::move(engine_state)), scene(std::move(scene_state)) {
        const auto gl = engine->enter();
        scene->update();
        renderer = std::make_unique<Renderer>(scene->world, scene->find_tracer(), width_px, height_px);
        scene->followers.push_back(this);
    }
    ~ViewState() override {
        std::erase(scene->followers, this);
        const auto gl = engine->enter();
        last.reset();
        renderer.reset();
    }
    ViewState(const ViewState&) = delete;
    ViewState& operator=(const ViewState&) = delete;

    void follow_scene() override { renderer->update(); }
    void rebuild() override {
        const int width_px = renderer->width_px(), height_px = renderer->height_px();
        last.reset();
        renderer.reset();
        renderer = std::make_unique<Renderer>(scene->world, scene->find_tracer(), width_px, height_px);
    }

    void render(const Frame& frame) {
        scene->update();
        FrameInput input;
        input.camera =
            make_record(frame.camera, scene->world, double(renderer->width_px()) / renderer->height_px());
        input.frame = frame.number;
        input.seed = frame.seed;
        input.settings = SettingsAccess::values(frame.settings);
        input.average = frame.average;
        DisplayInput& display = input.display.emplace();
        display.choice.view = parse_display_view(frame.display.view);
        display.choice.look.tone = parse_tone_curve(frame.display.tone);
        display.choice.look.glare = float(frame.display.glare_strength);
        display.exposure = {frame.display.exposure_ev, frame.display.elapsed_s, display.choice.look.tone};
        last.reset();
        last.emplace(renderer->render(input));
    }

    const FrameOutput& output() const {
        if (!last) throw tarn::Error("the view has not rendered a frame yet");
        return *last;
    }

    Picture read() const {
        Image image = renderer->read_radiance(output().radiance);
        return {image.width, image.height, std::move(image.values), describe_frame(*last, *renderer)};
    }

    FrameReport draw(const Frame& frame) {
        render(frame);
        return describe_frame(*last, *renderer);
    }

    std::shared_ptr<EngineState> engine;
    std::shared_ptr<SceneState> scene;
    std::unique_ptr<Renderer> renderer;
    std::optional<FrameOutput> last;
};

View::View(const Engine& engine, const Scene& scene, int width_px, int height_px) {
    guard([&] {
        if (std::min(width_px, height_px) < 1 || std::max(width_px, height_px) > MAX_SIZE_PX) {
            throw tarn::Error("the view is {} x {} pixels, it must have 1 to {} a side", width_px, height_px,
                              MAX_SIZE_PX);
        }
        state_ = std::make_unique<ViewState>(engine.state_, scene.state_, width_px, height_px);
    });
}

View::View(View&& other) noexcept = default;
View& View::operator=(View&& other) noexcept = default;
View::~View() = default;

int View::width_px() const {
    return state_->renderer->width_px();
}

int View::height_px() const {
    return state_->renderer->height_px();
}

Picture View::render(const Frame& frame) {
    return guard([&] {
        const auto gl = state_->engine->enter();
        state_->render(frame);
        return state_->read();
    });
}

FrameReport View::draw(const Frame& frame) {
    return guard([&] {
        const auto gl = state_->engine->enter();
        return state_->draw(frame);
    });
}

Picture View::read() const {
    return guard([&] {
        const auto gl = state_->engine->enter();
        return state_->read();
    });
}

unsigned View::texture() const {
    return guard([&] { return state_->output().display->id(); });
}

float View::exposure_ev() const {
    return guard([&] {
        const auto gl = state_->engine->enter();
        state_->output();
        return state_->renderer->read_exposure_ev();
    });
}

void View::present(int framebuffer_width_px, int framebuffer_height_px) {
    guard([&] {
        const auto gl = state_->engine->enter();
        if (!gl) throw tarn::Error("the engine's own context has no window to present a picture in");
        tarn::present(*state_->output().display, {framebuffer_width_px, framebuffer_height_px},
                      gl->draw_framebuffer());
    });
}

void View::write_png(const std::filesystem::path& file) const {
    guard([&] {
        const auto gl = state_->engine->enter();
        const Texture2D& picture = *state_->output().display;
        const std::vector<glm::u8vec4> texels = picture.download<glm::u8vec4>();
        Image image(picture.width_px(), picture.height_px(), 3);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            for (int c = 0; c < 3; ++c) image.values[3 * i + std::size_t(c)] = float(texels[i][c]) / 255.0f;
        }
        tarn::write_png(file, image);
    });
}

void View::reset_history() {
    state_->renderer->reset_history();
}

std::string View::reload_shaders() {
    return guard([&] {
        const auto gl = state_->engine->enter();
        return state_->renderer->reload_shaders();
    });
}

std::vector<DisplayViewInfo> Display::list_views() {
    std::vector<DisplayViewInfo> list;
    for (const tarn::DisplayViewInfo& view : display_views()) list.push_back({view.name, view.sentence});
    return list;
}

std::vector<std::string> Display::list_tone_curves() {
    const auto names = tone_curve_names();
    return {names.begin(), names.end()};
}

}  // namespace tarn::api
