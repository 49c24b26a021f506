// A history that is cut short where light changes, and only there.
#include <gtest/gtest.h>

#include "platform/context.h"
#include "support/toy_render.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 96, HEIGHT_PX = 64;
constexpr int CHANGE_FRAME = 24;

// At CHANGE_FRAME a lamp over a floor dims to a tenth, or a board slides before it, or a brighter lamp goes
// out under a roof that hides it from the floor.
struct ChangingScene {
    ToyScene toy;
    NodeIndex board;

    explicit ChangingScene(bool has_hidden_lamp) {
        const MaterialIndex grey = toy.add_material(lambert_material(glm::vec3(0.6f)));
        toy.add_quad(grey, {-6, 0, 6}, {12, 0, 0}, {0, 0, -12});
        toy.add_light(make_point(20.0f), at_place(0.0, 3.0, 0.0));
        toy.add_quad(grey, {-1.5f, 1.5f, 1.5f}, {3, 0, 0}, {0, 0, -3});
        board = toy.scene.instances.back().node;
        move_board(50.0);
        if (!has_hidden_lamp) return;
        toy.add_light(make_point(30.0f), at_place(0.0, 4.0, -1.0));
        toy.add_quad(grey, {-1, 3.9f, 0}, {2, 0, 0}, {0, 0, -2});
    }

    void move_board(double x) { at(toy.scene.nodes, board).matrix = at_place(x, 0.0, 0.0); }
};

enum class Change { NONE, LAMP_DIMS, SHADOW_FALLS, HIDDEN_LAMP_GOES_OUT };

// Whose light itself is never late.
RenderSettings with_reuse() {
    return find_preset("unbiased").settings;
}
RenderSettings without_reuse() {
    RenderSettings settings = with_reuse();
    settings.direct.mode = DirectMode::RIS;
    return settings;
}

// Means of the picture's middle, frame by frame from the one before the change.
std::vector<double> render_change(Change change, DenoiseMode mode, const RenderSettings& settings,
                                  const std::vector<std::string>& planted = {}) {
    ChangingScene scene(change == Change::HIDDEN_LAMP_GOES_OUT);
    World world = build_world(scene.toy.scene);
    const auto tracer = create_embree_tracer(world);
    Renderer renderer(world, *tracer, WIDTH_PX, HEIGHT_PX, planted);
    FrameInput input;
    input.settings = settings;
    input.settings.denoise.mode = mode;
    input.camera = look_at(world, {0.0, 1.2, 3.0}, {0.0, 0.0, 0.0}, 40.0, double(WIDTH_PX) / HEIGHT_PX);
    std::vector<double> means;
    for (int frame = 0; frame < CHANGE_FRAME + 8; ++frame) {
        if (frame == CHANGE_FRAME && change == Change::LAMP_DIMS) scene.toy.scene.lights[0].intensity *= 0.1f;
        if (frame == CHANGE_FRAME && change == Change::SHADOW_FALLS) scene.move_board(0.0);
        if (frame == CHANGE_FRAME && change == Change::HIDDEN_LAMP_GOES_OUT)
            scene.toy.scene.lights[1].intensity *= 0.0f;
        ++scene.toy.scene.revision;
        update_world(world, scene.toy.scene, 0.0);
        tracer->update(world);
        renderer.update();
        input.frame = std::uint32_t(frame);
        const Image image = renderer.read_radiance(renderer.render(input).radiance);
        double sum = 0.0;
        for (int y = HEIGHT_PX / 2 - 4; y < HEIGHT_PX / 2 + 4; ++y)
            for (int x = WIDTH_PX / 2 - 4; x < WIDTH_PX / 2 + 4; ++x) sum += image.pixel(x, y)[1];
        if (frame >= CHANGE_FRAME - 1) means.push_back(sum / 64.0);
    }
    return means;
}

// Frames after which nine tenths of the change show; more than there are where they never do.
int find_lag(const std::vector<double>& means, double after) {
    for (int frame = 1; frame < int(means.size()); ++frame) {
        if (std::abs(means[std::size_t(frame)] - after) < 0.1 * std::abs(means[0] - after)) return frame - 1;
    }
    return int(means.size());
}

class DenoiseChanges : public testing::Test {
    std::unique_ptr<Context> context_ = create_context({});
};

TEST_F(DenoiseChanges, ALampThatDimsShowsAtOnce) {
    for (const RenderSettings& settings : {with_reuse(), without_reuse()}) {
        const auto adaptive = render_change(Change::LAMP_DIMS, DenoiseMode::SVGF, settings);
        const double after = 0.1 * adaptive[0];
        EXPECT_LE(find_lag(adaptive, after), 1);
        EXPECT_GE(find_lag(render_change(Change::LAMP_DIMS, DenoiseMode::SVGF_STATIC, settings), after), 8);
    }
}

TEST_F(DenoiseChanges, AShadowThatFallsShowsAtOnce) {
    for (const RenderSettings& settings : {with_reuse(), without_reuse()}) {
        const auto noisy = render_change(Change::SHADOW_FALLS, DenoiseMode::OFF, settings);
        const double after = noisy.back();
        const auto adaptive = render_change(Change::SHADOW_FALLS, DenoiseMode::SVGF, settings);
        EXPECT_LE(find_lag(adaptive, after), 2)
            << testing::PrintToString(adaptive) << ", without a denoiser " << testing::PrintToString(noisy);
        EXPECT_GE(find_lag(render_change(Change::SHADOW_FALLS, DenoiseMode::SVGF_STATIC, settings), after),
                  8);
    }
}

TEST_F(DenoiseChanges, ChangesThatAreIgnoredAreFound) {
    const auto planted =
        render_change(Change::LAMP_DIMS, DenoiseMode::SVGF, with_reuse(), {"TARN_PLANT_IGNORE_CHANGES"});
    EXPECT_GE(find_lag(planted, 0.1 * planted[0]), 8);
}

TEST_F(DenoiseChanges, WithoutAChangeNothingIsCutShort) {
    for (const RenderSettings& settings : {with_reuse(), without_reuse()}) {
        EXPECT_EQ(render_change(Change::NONE, DenoiseMode::SVGF, settings),
                  render_change(Change::NONE, DenoiseMode::SVGF_STATIC, settings));
    }
}

// Single samples choose the hidden lamp as often as its light would matter.
TEST_F(DenoiseChanges, NeitherIsItWhereALampGoesOutThatIsNotSeen) {
    for (const RenderSettings& settings : {with_reuse(), without_reuse()}) {
        EXPECT_EQ(render_change(Change::HIDDEN_LAMP_GOES_OUT, DenoiseMode::SVGF, settings),
                  render_change(Change::HIDDEN_LAMP_GOES_OUT, DenoiseMode::SVGF_STATIC, settings));
    }
}

}  // namespace
}  // namespace tarn::test
