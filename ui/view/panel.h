// SPDX-License-Identifier: Apache-2.0
// The View panel: one picture as it converges, another in its place, or two: beside each other, or in one place and cut
// at a line. The mouse moves the camera (edits of the preset) or the pictures in the panel (view settings);
// docs/keys.md says which does what.
#pragma once
#include "ui/view/gizmo.h"
#include "ui/view/meter_map.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/picture_texture.h"

namespace nephroid::ui {

/// What the View shows now: a picture of the run or an opened one, or the map of its difference to another.
struct ShownPicture {
  std::shared_ptr<const void> owner;   ///< of the pixels below, other ones have another; null: nothing is shown
  std::span<const float> rgb;          ///< linear, shown with the settings' exposure; or
  std::span<const unsigned char> rgba; ///< shown unchanged, 4 bytes per pixel
  std::array<int, 2> size{1, 1};       ///< the chosen picture's, even while the other one is shown; first the preset's
  std::string label;                   ///< given where it is not the run's picture
  std::string hint;                    ///< shown in the middle of the panel where there is no picture
};

ShownPicture shown_picture(const Context& context);
/// What is shown beside it, or behind the line, in its own size. Nothing where one picture is shown alone.
ShownPicture picture_beside(const Context& context);
/// Linear values of a shown pixel, with their luminance by the preset's white. When comparing, a second line has the
/// other picture's values and a third the difference. Empty where there is no picture.
std::string pixel_text(const Context& context, const std::array<int, 2>& pixel);

/// A shown picture as a texture.
struct PictureOnScreen {
  PictureTexture texture;
  std::shared_ptr<const void> owner; ///< the picture's owner
  Tone tone;                         ///< its tone
  ViewSettings view_settings;        ///< the settings that gave the tone
  image::Display display;            ///< the preset's that gave the tone
  double white = 1;                  ///< the white that gave the tone

  /// like: the tone of the picture that it is compared with; null: its own.
  void refresh(const Context& context, const ShownPicture& shown, const Tone* like = nullptr);
  void draw(const ShownPicture& shown, const Placement& placement) const;
};

/// Where two pictures are shown: in one place, each on its side of the line, or each in a half of the panel.
struct PictureAreas {
  Canvas canvas;        ///< the place of the first picture
  Canvas first, second; ///< the parts of the panel that show the two pictures; empty where there is no second one
  double shift = 0;     ///< on the screen from a pixel of the first picture to the same one of the second
};

class ViewPanel : public Panel {
public:
  static constexpr const char* title = "View";
  void draw(const Context& context) override;

  /// For tests: what was shown last, and where. Widgets of the bars and "line", which cuts two pictures, have places.
  const Canvas& canvas() const { return areas_.canvas; }
  const PictureTexture& texture() const { return first_.texture; }
  const Tone& tone() const { return first_.tone; }
  const ShownPicture& shown() const { return shown_; }
  const ShownPicture& beside() const { return beside_; }
  const PictureTexture& texture_beside() const { return second_.texture; }
  double shift() const { return areas_.shift; }
  std::string pixel_value() const { return pixel_value_; }
  const SceneOverlay& overlay() const { return overlay_; }
  const MapOnPicture& map() const { return map_; }

private:
  enum class Drag { none, orbit, pan, dolly, move_picture, mark };

  void draw_toolbar(const Context& context);
  void take_line(const Context& context, const Canvas& area);
  void draw_pictures(const Context& context);
  void draw_pixel_value(const Context& context, const Canvas& area);
  Placement placed(const Context& context) const {
    return place(context.view_state.view_settings, areas_.canvas, shown_.size);
  }
  Point pointer() const;
  std::optional<std::array<int, 2>> pointed_pixel(const Context& context) const;
  void use_mouse(const Context& context);
  void start_drag(const Context& context);
  void continue_drag(const Context& context);
  void move_camera(const Context& context, const Point& delta) const;
  void mark(const Context& context);
  void use_wheel(const Context& context);

  PictureAreas areas_;
  ShownPicture shown_, beside_; ///< what the current frame shows
  PictureOnScreen first_, second_;
  std::string pixel_value_;

  SceneOverlay overlay_;
  MapOnPicture map_;
  BarRows bars_;

  Drag drag_ = Drag::none;
  bool pressed_ = false, held_ = false; ///< the state of a mouse button on the picture
  bool on_second_ = false; ///< the mouse is on the second picture; while a button is held: was on it when pressed
  bool moved_ = false;     ///< the mouse moved farther than a hand trembles in a click
  Point drag_from_{0, 0};
  bool marks_region_ = false;      ///< the mouse moved too far for a click
  preset::Camera camera_at_start_; ///< a drag is measured from its start, so that rounding does not add up
  ViewSettings settings_at_start_;
  Gestures gestures_{title};
  double last_wheel_s_ = -1; ///< turns of the wheel in quick succession are one gesture
  bool hovered_ = false;
};

} // namespace nephroid::ui
