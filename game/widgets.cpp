#include "widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace game {
namespace {

void choose_style(GLFWwindow* handle) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 4.0f;
    style.FrameRounding = 2.0f;
    style.ItemSpacing = ImVec2(6.0f, 3.0f);
    style.Colors[ImGuiCol_WindowBg].w = 0.88f;
    float scale = 1.0f;
    glfwGetWindowContentScale(handle, &scale, nullptr);
    style.ScaleAllSizes(scale);
    ImGui::GetIO().FontGlobalScale = scale;
}

}  // namespace

Widgets::Widgets(Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // no file beside the user's work
    choose_style(window.native_handle());
    if (!ImGui_ImplGlfw_InitForOpenGL(window.native_handle(), true) ||
        !ImGui_ImplOpenGL3_Init("#version 450 core")) {
        throw Error(fmt::format("Dear ImGui {} cannot draw with this OpenGL", ImGui::GetVersion()));
    }
}

Widgets::~Widgets() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Widgets::begin() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Widgets::end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Widgets::wants_mouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

}  // namespace game
