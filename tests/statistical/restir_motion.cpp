#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "core/tile_test.h"
#include "platform/context.h"
#include "reference/reference.h"
#include "renderer/renderer.h"
#include "support/moving_scenes.h"

namespace tarn::test {
namespace {
constexpr int W = 64, H = 48;

struct Method { std::string name; RenderSettings settings; std::vector<std::string> planted; };

void explore(MovingScene moving, std::vector<Method> methods, int seeds) {
    moving.pose(moving.scene, LAST_FRAME);
    World world = build_world(moving.scene, moving.options);
    const auto tracer = create_embree_tracer(world);
    FrameInput input;
    input.camera = look_at(world, moving.camera_ws, moving.target_ws, 45.0, double(W) / H);
    ReferenceSettings rs;
    rs.width = W; rs.height = H; rs.camera = input.camera; rs.direct_only = true; rs.spp = 1024; rs.seed = 5;
    const ReferenceResult rr = render_reference(world, *tracer, rs);
    const TileReference truth{rr.radiance, rr.variance};
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::vector<TileSamples> tiles, whole;
    for (auto& m : methods) {
        renderers.push_back(std::make_unique<Renderer>(world, *tracer, W, H, m.planted));
        tiles.emplace_back(W, H, 16); whole.emplace_back(W, H, 64);
    }
    std::vector<double> ms(methods.size());
    for (int seed = 0; seed < seeds; ++seed) {
        input.seed = seed + 100;
        for (int f = 0; f <= LAST_FRAME; ++f) {
            moving.pose(moving.scene, f);
            update_world(world, moving.scene, 0.0);
            tracer->update(world);
            for (std::size_t i = 0; i < methods.size(); ++i) {
                renderers[i]->update();
                if (f == 0) renderers[i]->reset_history();
                input.frame = f;
                input.settings = methods[i].settings;
                auto out = renderers[i]->render(input);
                if (seed > 0) ms[i] += out.timings.frame_ms;
                if (f == LAST_FRAME) { Image im = renderers[i]->read_radiance(out.radiance); tiles[i].add(im); whole[i].add(im); }
            }
        }
    }
    for (std::size_t i = 0; i < methods.size(); ++i) {
        auto t = tiles[i].test(truth); auto w = whole[i].test(truth);
        fmt::print("{:28} {:5.2f} ms  picture {:.4f} +- {:.4f}  p {:.2g} | {}\n", methods[i].name, ms[i] / (seeds - 1) / (LAST_FRAME + 1), w.mean / w.reference_mean, w.standard_error / w.reference_mean, w.min_p_value, describe(t));
    }
}

RenderSettings with(Mis mis) { RenderSettings s = find_preset("unbiased").settings; s.mis = mis; return s; }

TEST(Explore, Things) {
    const auto context = create_context({});
    const int seeds = std::getenv("SEEDS") ? std::atoi(std::getenv("SEEDS")) : 24;
    std::vector<Method> methods = {{"pairwise", with(Mis::PAIRWISE), {}}, {"balance", with(Mis::BALANCE), {}}, {"count", with(Mis::COUNT), {}},
        {"pairwise planted", with(Mis::PAIRWISE), {"TARN_PLANT_PRESENT_GEOMETRY"}}};
    for (auto n : {"fast", "balanced", "fine", "student"}) methods.push_back({n, find_preset(n).settings, {}});
    for (double step : {0.005, 0.02, 0.2}) { fmt::print("step {}\n", step); explore(make_moving_things(step), methods, seeds); }
}
}
}
