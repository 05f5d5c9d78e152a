// SPDX-License-Identifier: Apache-2.0
// The display side of the window: GLFW, OpenGL and Dear ImGui's two back ends. Nothing of the workbench.
#pragma once
#include "ui/state/commands.h"

struct GLFWwindow;

namespace nephroid::ui {

class GlfwWindow {
public:
  /// Opens the window and a Dear ImGui context with font and theme. Throws failed at "window" where there is no display
  /// or no OpenGL 3.
  GlfwWindow(const std::string& title, std::array<int, 2> size);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  /// Theme and size of text from the next frame on.
  void set_appearance(Theme theme, double text_size) { wanted_ = {theme, static_cast<float>(text_size)}; }
  /// Takes the events that are there and begins a frame of Dear ImGui.
  void begin_frame();
  void end_frame();
  /// Draws into the back buffer; present() shows it.
  void draw_frame();
  void present();
  /// The back buffer after draw_frame(): 4 bytes a pixel, row 0 at the top.
  std::vector<unsigned char> read_back(int& width, int& height) const;
  /// Sleeps until something happens to the window or the time is over.
  void wait(double seconds);

  /// True once after somebody wants to close the window, which stays: there may be something to ask first.
  bool take_close_request();
  void set_title(const std::string& title);
  /// Files that were dropped on the window since the last call.
  std::vector<std::string> take_dropped() { return std::exchange(dropped_, {}); }
  /// True where the mouse or a key was used since the last call.
  bool take_activity() { return std::exchange(activity_, false); }
  std::string renderer() const;
  /// Lets go of what the back ends hold, textures of panels too; the context stays until the destructor.
  void shut_down_back_ends();

private:
  void follow_scale();

  GLFWwindow* window_ = nullptr;
  std::string title_;
  std::vector<std::string> dropped_;
  struct Appearance {
    Theme theme = Theme::dark;
    float scale = 1;
    bool operator==(const Appearance&) const = default;
  };
  Appearance wanted_, shown_{Theme::dark, 0}; ///< by the person; of the display and the person together
  bool back_ends_ = false, activity_ = false;
};

/// ImGui::NewFrame(), but a modifier that is let go after something was pressed is let go in the next frame. Where Ctrl
/// was held before, and Z is pressed and Ctrl let go within one frame, Dear ImGui sees Z alone. And a button that is
/// pressed where the mouse has just come is pressed in the next frame: tabs, and whatever else others may lie over,
/// hear only what was under the mouse a frame before.
void new_frame();

} // namespace nephroid::ui
