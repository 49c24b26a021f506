// own_window SCENE.glb [FRAMES]: a program with a window of its own, in which Tarn draws. The camera turns
// about the scene, a lamp about its middle. Ends after FRAMES frames, or when the window is closed.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <tarn/tarn.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

GLFWwindow* open_window() {
    if (!glfwInit()) throw tarn::Error("GLFW does not start: is there a display?");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow* window = glfwCreateWindow(640, 360, "A program of its own", nullptr, nullptr);
    if (window == nullptr) throw tarn::Error("no window with OpenGL 4.5 core can be opened");
    glfwMakeContextCurrent(window);
    return window;
}

void run(GLFWwindow* window, const char* file, unsigned frames) {
    tarn::EngineOptions options;
    options.gl_loader = glfwGetProcAddress;  // draw in this window's context
    const tarn::Engine engine(options);
    tarn::Scene scene = tarn::Scene::load(file);
    tarn::View view(engine, scene, 320, 180);

    const tarn::Box box = scene.bounds();
    const tarn::Vec3 middle{(box.lower.x + box.upper.x) / 2, (box.lower.y + box.upper.y) / 2,
                            (box.lower.z + box.upper.z) / 2};
    const double size =
        std::max({box.upper.x - box.lower.x, box.upper.y - box.lower.y, box.upper.z - box.lower.z});
    tarn::Light light;
    light.intensity = {size * size, size * size, size * size};
    const tarn::Node lamp = scene.add_light(light, {});

    tarn::Frame frame;
    frame.settings = tarn::Settings::preset("fast");
    for (; frame.number < frames && !glfwWindowShouldClose(window); ++frame.number) {
        const double turn = 0.02 * frame.number;
        frame.camera = tarn::Camera::look_at({middle.x + 2.0 * size * std::sin(turn), middle.y + 0.2 * size,
                                              middle.z + 2.0 * size * std::cos(turn)},
                                             middle, 35.0);
        tarn::Transform place;
        place.translation = {middle.x + 0.2 * size * std::cos(3.0 * turn), middle.y,
                             middle.z + 0.2 * size * std::sin(3.0 * turn)};
        scene.set_transform(lamp, place);
        view.draw(frame);
        int width = 0, height = 0;
        glfwGetFramebufferSize(window, &width, &height);
        if (width > 0 && height > 0) view.present(width, height);
        glfwSwapBuffers(window);
        glfwPollEvents();
    }
    std::printf("%u frames\n", frame.number);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc < 2) throw tarn::Error("usage: own_window SCENE.glb [FRAMES]");
        run(open_window(), argv[1], argc > 2 ? unsigned(std::atoi(argv[2])) : 0xffffffffu);
        glfwTerminate();
        return 0;
    } catch (const tarn::Error& error) {
        std::fprintf(stderr, "own_window: %s\n", error.what());
        return 1;
    }
}
