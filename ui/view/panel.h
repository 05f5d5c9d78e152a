// SPDX-License-Identifier: Apache-2.0
// The View panel: the picture as it converges, another one in its place, or two: beside each other, or in one place and
// cut at a line. The mouse moves the camera (edits of the preset) or the pictures in the panel (their look);
// docs/keys.md says which does what.
#pragma once
#include "ui/state/tone.h"
#include "ui/view/gizmo.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/picture_texture.h"

namespace nephroid::ui {

/// What the View shows now: the run's picture or an opened one, what that is compared with, or the map of their
/// difference.
struct ShownPicture {
  std::shared_ptr<const void>
      owner;                  ///< of the pixels below; null: there is nothing to show. Other pixels have another owner.
  std::span<const float> rgb; ///< linear, to be shown with the settings' exposure; or
  std::span<const unsigned char> rgba; ///< as it is, 4 bytes a pixel
  std::array<int, 2> size{1, 1}; ///< of the picture that is chosen to be shown, also in place of what it is compared
                                 ///< with; before the first, the preset's
  std::string label;             ///< where it is not the run's picture
  std::string hint;              ///< in the middle of the panel, where there is nothing to show
};

ShownPicture shown_picture(const Context& context);
/// What stands beside it, or behind the line; its size is its own. Nothing where one picture is shown alone.
ShownPicture picture_beside(const Context& context);
/// Linear values of a pixel of what is shown, with the luminance that the preset's white makes of them; when comparing,
/// a second line with those of the other picture and a third with the difference. Empty where there is no picture.
std::string pixel_text(const Context& context, const std::array<int, 2>& pixel);

class ViewPanel : public Panel {
public:
  static constexpr const char* title = "View";
  void draw(const Context& context) override;

  /// For tests: widgets of its bars, and "line", which cuts two pictures. Where the picture's part of the panel was
  /// drawn last, and the picture in it; for tests.
  const Canvas& canvas() const { return canvas_; }
  const PictureTexture& texture() const { return first_.texture; }
  const Tone& tone() const { return first_.tone; }
  /// What it showed last; for tests.
  const ShownPicture& shown() const { return shown_; }
  const ShownPicture& beside() const { return beside_; }
  const PictureTexture& texture_beside() const { return second_.texture; }
  /// From a pixel of the first picture to the same one of the second, on the screen; 0 but where they stand side by
  /// side.
  double shift() const { return shift_; }
  std::string pixel_value() const { return pixel_value_; }
  /// For tests: what is over it.
  const SceneOverlay& overlay() const { return overlay_; }

private:
  enum class Drag { none, orbit, pan, dolly, move_picture, mark };

  /// A picture as a texture.
  struct ToneMappedPicture {
    PictureTexture texture;
    std::shared_ptr<const void> owner; ///< what it shows,
    Tone tone;                         ///< with this tone;
    ViewSettings view_settings;        ///< that is made with these settings
    double white = 1;                  ///< and this white
  };

  void draw_toolbar(const Context& context);
  void lay_out(const Context& context, const Canvas& area);
  void take_line(const Context& context, const Canvas& area);
  void draw_pictures(const Context& context);
  void draw_picture(const ShownPicture& shown, const ToneMappedPicture& tone_mapped, const Placement& placement) const;
  void draw_marked(const Context& context, const ShownPicture& shown, const Canvas& seen,
                   const Placement& placement) const;
  void draw_pixel_value(const Context& context, const Canvas& area);
  Placement placed(const Context& context) const {
    return place(context.view_state.view_settings, canvas_, shown_.size);
  }
  Point pointer() const;
  std::optional<std::array<int, 2>> pointed_pixel(const Context& context) const;
  void own_keys(const Context& context);
  void use_mouse(const Context& context);
  void start_drag(const Context& context);
  void continue_drag(const Context& context);
  void move_camera(const Context& context, const Point& delta) const;
  void mark(const Context& context);
  void use_wheel(const Context& context);
  static void refresh(ToneMappedPicture& tone_mapped, const ShownPicture& shown, const ViewSettings& view_settings,
                      double white, const Tone* like = nullptr);

  Canvas canvas_;                   ///< that the first picture is placed in
  Canvas seen_first_, seen_second_; ///< the parts of the panel in which the two are seen
  double shift_ = 0;                ///< as shift()
  ShownPicture shown_, beside_;     ///< of the frame that is being drawn
  ToneMappedPicture first_, second_;
  std::string pixel_value_; ///< as drawn last

  SceneOverlay overlay_;
  BarRows bars_;

  Drag drag_ = Drag::none;
  bool pressed_ = false, held_ = false; ///< a button of the mouse, on the picture
  bool on_second_ = false; ///< the mouse is on the second picture; as long as a button is held, where it was pressed
  bool moved_ = false;     ///< the drag is one: the mouse went farther than a click's hand trembles
  Point drag_from_{0, 0};
  bool marks_region_ = false;      ///< the mouse went too far for a click
  preset::Camera camera_at_start_; ///< a drag is measured from its start, so that rounding does not add up
  ViewSettings settings_at_start_;
  Gestures gestures_{title};
  double last_wheel_s_ = -1; ///< turns of the wheel in quick succession are one gesture
  bool hovered_ = false;
};

} // namespace nephroid::ui
