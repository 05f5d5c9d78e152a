// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/glfw_window.h"

#include "base/error.h"
#include "ui/widgets/theme.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cstdlib>

namespace nephroid::ui {
namespace {

std::string last_glfw_error() {
  const char* description = nullptr;
  glfwGetError(&description);
  return description ? description : "no reason given";
}

Error no_window(const std::string& what) {
  return failed("window", what + " (" + last_glfw_error() + ")", "run it in a desktop session or under xvfb-run",
                "or use nephroid run PRESET");
}

GLFWwindow* open_glfw(const std::string& title, std::array<int, 2> size) {
#ifdef GLFW_PLATFORM // since 3.4, which asks Wayland first; its library then says on standard error that there is none
  if (!std::getenv("WAYLAND_DISPLAY")) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
  if (!glfwInit()) throw no_window("no display");
  // 3.0 is the oldest that the back end draws with; drivers give the newest that is compatible with it.
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  for (const int name : {GLFW_X11_CLASS_NAME, GLFW_X11_INSTANCE_NAME})
    glfwWindowHintString(name, "nephroid"); // as the desktop file says
  GLFWwindow* window = glfwCreateWindow(size[0], size[1], title.c_str(), nullptr, nullptr);
  if (window) return window;
  const Error error = no_window("no OpenGL 3");
  glfwTerminate();
  throw error;
}

bool is_modifier(ImGuiKey key) { return (key & ImGuiMod_Mask_) != 0 || ImGui::IsLRModKey(key); }

bool is_press(const ImGuiInputEvent& event) {
  if (event.Type == ImGuiInputEventType_Key) return event.Key.Down && !is_modifier(event.Key.Key);
  return event.Type == ImGuiInputEventType_MouseWheel; // a click's modifier Dear ImGui itself keeps
}

/// The first press of a button after a move of the mouse; the end where there is none.
ImGuiInputEvent* press_after_move(ImVector<ImGuiInputEvent>& events) {
  ImGuiInputEvent* const move = std::find_if(
      events.begin(), events.end(), [](const ImGuiInputEvent& e) { return e.Type == ImGuiInputEventType_MousePos; });
  return std::find_if(move, events.end(), [](const ImGuiInputEvent& e) {
    return e.Type == ImGuiInputEventType_MouseButton && e.MouseButton.Down;
  });
}

bool lets_modifier_go(const ImGuiInputEvent& event) {
  return event.Type == ImGuiInputEventType_Key && !event.Key.Down && is_modifier(event.Key.Key);
}

} // namespace

void new_frame() {
  ImVector<ImGuiInputEvent>& events = ImGui::GetCurrentContext()->InputEventsQueue;
  ImGuiInputEvent* const later =
      std::min(std::find_if(std::find_if(events.begin(), events.end(), is_press), events.end(), lets_modifier_go),
               press_after_move(events));
  const std::vector<ImGuiInputEvent> kept(later, events.end());
  events.resize(static_cast<int>(later - events.begin()));
  ImGui::NewFrame();
  for (const ImGuiInputEvent& event : kept) events.push_back(event);
}

GlfwWindow::GlfwWindow(const std::string& title, std::array<int, 2> size)
    : window_(open_glfw(title, size)), title_(title) {
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, &dropped_);
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    auto& dropped = *static_cast<std::vector<std::string>*>(glfwGetWindowUserPointer(window));
    dropped.insert(dropped.end(), paths, paths + count);
  });
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigFlags |= ImGuiConfigFlags_DockingEnable | ImGuiConfigFlags_NavEnableKeyboard;
  io.IniFilename = nullptr; // the workbench keeps layouts (EngineLayout)
  add_font();
  ImGui_ImplGlfw_InitForOpenGL(window_, true);
  back_ends_ = ImGui_ImplOpenGL3_Init("#version 130");
  follow_scale();
}

GlfwWindow::~GlfwWindow() {
  shut_down_back_ends();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void GlfwWindow::shut_down_back_ends() {
  if (!std::exchange(back_ends_, false)) return;
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
}

/// The scale changes when the window moves to another display, or when a person wants another.
void GlfwWindow::follow_scale() {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  const Appearance now{wanted_.theme, wanted_.scale * std::clamp(std::max(x, y), 0.5f, 8.0f)};
  if (now == std::exchange(shown_, now)) return;
  set_theme(now.scale, now.theme);
}

void GlfwWindow::begin_frame() {
  glfwPollEvents();
  follow_scale();
  // Mouse, keys and focus; Dear ImGui may deal one burst of them out to several frames.
  if (ImGui::GetCurrentContext()->InputEventsQueue.Size > 0) activity_ = true;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  new_frame();
}

void GlfwWindow::end_frame() { ImGui::Render(); }

void GlfwWindow::draw_frame() {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  glViewport(0, 0, width, height);
  glClearColor(0.1f, 0.1f, 0.1f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void GlfwWindow::present() { glfwSwapBuffers(window_); }

std::vector<unsigned char> GlfwWindow::read_back(int& width, int& height) const {
  glfwGetFramebufferSize(window_, &width, &height);
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  std::vector<unsigned char> pixels(row * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  // OpenGL's row 0 is at the bottom, and its alpha says nothing about what the screen shows.
  for (std::size_t top = 0, bottom = static_cast<std::size_t>(height); top + 1 < bottom; ++top)
    std::swap_ranges(&pixels[top * row], &pixels[top * row] + row, &pixels[--bottom * row]);
  for (std::size_t i = 3; i < pixels.size(); i += 4) pixels[i] = 255;
  return pixels;
}

void GlfwWindow::wait(double seconds) { glfwWaitEventsTimeout(seconds); }

bool GlfwWindow::take_close_request() {
  const bool requested = glfwWindowShouldClose(window_);
  glfwSetWindowShouldClose(window_, GLFW_FALSE);
  return requested;
}

void GlfwWindow::set_title(const std::string& title) {
  if (title != std::exchange(title_, title)) glfwSetWindowTitle(window_, title.c_str());
}

std::string GlfwWindow::renderer() const {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name ? reinterpret_cast<const char*>(name) : "unknown";
}

} // namespace nephroid::ui
