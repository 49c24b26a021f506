// tarn render: one picture (the last of N frames) through the GL renderer.
#include <nlohmann/json.hpp>

#include <fstream>

#include "commands.h"
#include "core/display.h"
#include "image_io/image_io.h"
#include "platform/context.h"
#include "renderer/renderer.h"
#include "scene/gltf_import.h"
namespace tarn {
void add_render_command(CLI::App& app) {
    auto* c = app.add_subcommand("render");
    static std::string scene_path, out; c->add_option("SCENE", scene_path)->required(); c->add_option("--out", out)->required();
    static int frames = 1; c->add_option("--frames", frames);
    static std::string mode = "ris"; c->add_option("--direct", mode);
    c->callback([] {
        Scene scene = load_gltf(scene_path);
        World world = build_world(scene);
        auto tracer = create_embree_tracer(world);
        tracer->update(world);
        auto context = create_context({});
        const int w = 640, h = 360;
        Renderer renderer(world, *tracer, w, h);
        auto camera = scene_camera(scene, world, CameraIndex(0), double(w) / h, -1);
        FrameInput input; input.camera = camera ? *camera : default_camera(world, double(w) / h);
        setting_table()[0].parse(input.settings, mode);
        Image sum(w, h, 3);
        TimingLog log;
        for (int i = 0; i < frames; ++i) {
            input.frame = i;
            auto o = renderer.render(input);
            if (i) log.add(o.timings);
            auto im = renderer.read_radiance(o.radiance);
            for (size_t k = 0; k < sum.values.size(); ++k) sum.values[k] += im.values[k] / frames;
            if (i + 1 == frames) fmt::print("draws {} tris {}/{} rays {}\n", o.raster.draws, o.raster.triangles_drawn, o.raster.triangles_total, o.shadow_rays.traced);
        }
        fmt::print("frame {:.2f} ms\n", log.frame_quantile_ms(0.5));
        for (auto& p : log.pass_medians()) fmt::print("  {} {:.2f}\n", p.name, p.ms);
        for (auto& [n, v] : renderer.read_counters()) fmt::print("  {} {}\n", n, v);
        write_png(out, display_from_radiance(sum, auto_exposure_ev(sum)));
    });
}
}  // namespace tarn
