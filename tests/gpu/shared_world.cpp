// Several renderers over one world: each draws what it would draw alone, whoever else looks at the world and
// however many updates it lets pass before it looks again.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "platform/context.h"
#include "rays/ray_tracer.h"
#include "renderer/renderer.h"
#include "support/draws.h"
#include "support/moving_scenes.h"

namespace tarn::test {
namespace {

constexpr int WIDTH_PX = 48;
constexpr int HEIGHT_PX = 32;
constexpr int STEPS = 36;
constexpr int POINT_COUNT = 14;
constexpr int LAMP_COUNT = 4;

// A lit floor with lamps and point lights over it, which move, dim, come, go and change places.
class ChangingLights {
  public:
    ChangingLights() : toy_(make_lit_floor()), draws_(11) {
        for (int i = 0; i < LAMP_COUNT; ++i) {
            const MaterialIndex glow = toy_.add_material(emissive_material(glm::vec3(4.0f + float(i))));
            toy_.add_quad(glow, {-0.2f, 0, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
            lamps_.push_back(last_node(toy_));
            place(lamps_.back(), 1.0);
        }
        for (int i = 0; i < POINT_COUNT; ++i) {
            PunctualLight light;
            light.intensity = glm::vec3(0.3f + 0.1f * float(i), 0.5f, 0.8f);
            toy_.add_light(light, place_at(draw_place()));
        }
        nodes_ = scene().light_nodes;
    }

    Scene& scene() { return toy_.scene; }

    // What happens between two updates; every kind comes up, and so do steps in which nothing does.
    void step() {
        std::vector<NodeIndex>& shining = scene().light_nodes;
        switch (draws_.bits() % 12u) {
            case 0u:
            case 6u:
            case 7u:
                return;
            case 1u:  // one goes
                if (shining.size() > 4) shining.erase(shining.begin() + std::ptrdiff_t(any_of(shining)));
                break;
            case 2u:  // all are there again
                shining = nodes_;
                break;
            case 3u:
                std::swap(shining[any_of(shining)], shining.front());
                break;
            case 4u:
                scene().lights[any_of(scene().lights)].intensity *= 1.5f;
                break;
            case 5u:  // a lamp without area is no light
                place(lamps_[any_of(lamps_)], draws_.bits() % 2u == 0u ? 0.0 : 1.0);
                break;
            default:  // moved as games do it: noted, not an edit
                for (int i = 0; i < 3; ++i) move(nodes_[any_of(nodes_)]);
                move(lamps_[any_of(lamps_)]);
                return;
        }
        ++scene().revision;
    }

  private:
    template <class Item>
    std::size_t any_of(const std::vector<Item>& items) {
        return draws_.bits() % items.size();
    }
    glm::dvec3 draw_place() {
        return {draws_.uniform(-1.5, 1.5), draws_.uniform(0.3, 1.5), draws_.uniform(-1.5, 1.5)};
    }
    void place(NodeIndex node, double scale) {
        at(scene().nodes, node).matrix = place_at(draw_place(), glm::dvec3(scale), draws_.uniform(0.0, 6.0));
    }
    void move(NodeIndex node) {
        (*at(scene().nodes, node).matrix)[3] += glm::dvec4(0.2 * glm::dvec3(draws_.unit_vector()), 0.0);
        scene().moves.add(node);
    }

    ToyScene toy_;
    Draws draws_;
    std::vector<NodeIndex> lamps_;
    std::vector<NodeIndex> nodes_;  // of all point lights, whether they shine or not
};

struct Stage {
    explicit Stage(const Scene& scene) : world(build_world(scene)), tracer(create_embree_tracer(world)) {}
    void follow(const Scene& scene) {
        update_world(world, scene, 0.0);
        tracer->update(world);
    }

    World world;
    std::unique_ptr<RayTracer> tracer;
};

// One who draws, with frames numbered one after the other, so that each looks back to the last.
class Painter {
  public:
    explicit Painter(Stage& stage)
        : stage_(stage), renderer_(stage.world, *stage.tracer, WIDTH_PX, HEIGHT_PX) {}

    void look() { renderer_.update(); }

    Image draw(const RenderSettings& settings) {
        const CameraRecord camera =
            look_at(stage_.world, {0.0, 2.6, 2.9}, {0.0, 0.0, 0.1}, 45.0, double(WIDTH_PX) / HEIGHT_PX);
        return renderer_.read_radiance(renderer_.render({camera, frame_++, 7, settings}).radiance);
    }

  private:
    Stage& stage_;
    Renderer renderer_;
    std::uint32_t frame_ = 0;
};

bool are_same_bits(const Image& a, const Image& b) {
    return a.values.size() == b.values.size() &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0;
}

// Whether painter `who` draws after update `step`. The first draws often, the second seldom; both, one or
// none of them at a time, and each lets up to six updates pass.
bool is_turn_of(std::size_t who, int step) {
    const bool turns[2][12] = {
        {true, false, true, true, false, false, true, false, true, true, false, true},
        {true, true, false, false, false, true, false, false, false, false, false, true}};
    return turns[who][step % 12];
}

// Two painters share a world. Each has a double with a world of its own, who looks at every update and draws
// when they draw. Returns how many of their pictures differ.
int count_differences(const RenderSettings& settings) {
    ChangingLights lights;
    Stage shared(lights.scene());
    std::array<Painter, 2> painters{Painter(shared), Painter(shared)};
    std::array<Stage, 2> own{Stage(lights.scene()), Stage(lights.scene())};
    std::array<Painter, 2> doubles{Painter(own[0]), Painter(own[1])};
    int different = 0;
    for (int step = 0; step < STEPS; ++step) {
        lights.step();
        shared.follow(lights.scene());
        for (std::size_t who = 0; who < 2; ++who) {
            own[who].follow(lights.scene());
            doubles[who].look();
            if (!is_turn_of(who, step)) continue;
            painters[who].look();
            different += !are_same_bits(painters[who].draw(settings), doubles[who].draw(settings));
        }
    }
    return different;
}

class SharedWorld : public testing::Test {
  protected:
    static void SetUpTestSuite() { context_ = create_context({}); }
    static void TearDownTestSuite() { context_.reset(); }

    static RenderSettings settings_of(const char* preset, LightSelection selection) {
        RenderSettings settings = find_preset(preset).settings;
        settings.direct.light_selection = selection;
        return settings;
    }

    static inline std::unique_ptr<Context> context_;
};

TEST_F(SharedWorld, LightsDrawnByTheTreeAreThoseOfARendererAlone) {
    RenderSettings settings;
    settings.direct.mode = DirectMode::LIGHT_TREE;
    EXPECT_EQ(count_differences(settings), 0);
}

TEST_F(SharedWorld, LightsDrawnByPowerAreThoseOfARendererAlone) {
    RenderSettings settings;
    settings.direct.brdf_candidate = true;
    EXPECT_EQ(count_differences(settings), 0);
}

TEST_F(SharedWorld, ReuseOverTimeIsThatOfARendererAlone) {
    EXPECT_EQ(count_differences(settings_of("balanced", LightSelection::TREE)), 0);
    EXPECT_EQ(count_differences(settings_of("balanced", LightSelection::TILES)), 0);
    EXPECT_EQ(count_differences(settings_of("unbiased", LightSelection::TREE)), 0);
}

}  // namespace
}  // namespace tarn::test
