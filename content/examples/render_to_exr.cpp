// render_to_exr SCENE.glb OUT.exr [FRAMES]: renders a glTF scene without a window; the picture is linear
// radiance.
#include <tarn/tarn.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: %s SCENE.glb OUT.exr [FRAMES]\n", argv[0]);
        return 2;
    }
    try {
        const tarn::Engine engine;
        const tarn::Scene scene = tarn::Scene::load(argv[1]);
        tarn::View view(engine, scene, 640, 360);

        tarn::Frame frame;
        frame.camera = scene.default_camera(640.0 / 360.0);
        frame.settings = tarn::Settings::preset("balanced");
        const unsigned frames =
            argc > 3 ? unsigned(std::atoi(argv[3])) : 16;  // each reuses samples of the last
        for (; frame.number + 1 < frames; ++frame.number) view.draw(frame);
        const tarn::Picture picture = view.render(frame);

        picture.write_exr(argv[2]);
        std::printf("%s: %d x %d px, %.1f ms on %s\n", argv[2], picture.width_px, picture.height_px,
                    picture.report.frame_ms, engine.device_name().c_str());
        return 0;
    } catch (const tarn::Error& error) {
        std::fprintf(stderr, "render_to_exr: %s\n", error.what());
        return 1;
    }
}
