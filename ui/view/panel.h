// SPDX-License-Identifier: Apache-2.0
// The View panel: the picture as it converges, or what it is compared with. The mouse moves the camera (edits of the preset) or the picture
// in the panel (its look); docs/keys.md says which does what.
#pragma once
#include "ui/state/tone.h"
#include "ui/view/gizmo.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/picture_texture.h"

namespace nephroid::ui {

/// What the View shows now: the run's picture, the one it is compared with, or the map of their difference.
struct ShownPicture {
  std::shared_ptr<const void> owner;   ///< of the pixels below; null: there is nothing to show. Other pixels have another owner.
  std::span<const float> rgb;          ///< linear, to be shown with the look's exposure; or
  std::span<const unsigned char> rgba; ///< as it is, 4 bytes a pixel
  std::array<int, 2> size{1, 1};       ///< the run's picture's, whatever is shown; before the first, the preset's
  std::string label;                   ///< where it is not the run's picture
  std::string hint;                    ///< in the middle of the panel, where there is nothing to show
};

ShownPicture shown_picture(const Context& context);
/// Linear values of a pixel inside of the run's picture, with the luminance that the preset's white makes of them; when comparing, a
/// second line with those of the other picture and a third with the difference. Empty where there is no picture.
std::string pixel_text(const Context& context, const std::array<int, 2>& pixel);

class ViewPanel : public Panel {
public:
  static constexpr const char* title = "View";
  void draw(const Context& context) override;

  /// Where the picture's part of the panel was drawn last, and the picture in it; for tests.
  const Canvas& canvas() const { return canvas_; }
  const PictureTexture& texture() const { return texture_; }
  const Tone& tone() const { return tone_; }
  /// What it showed last; for tests.
  const ShownPicture& shown() const { return shown_; }
  /// For tests: what is over it.
  const SceneOverlay& overlay() const { return overlay_; }

private:
  enum class Drag { none, orbit, pan, dolly, move_picture, mark };

  void draw_toolbar(const Context& context);
  void draw_picture(const Context& context);
  void draw_pixel_value(const Context& context) const;
  void own_keys(const Context& context);
  void use_mouse(const Context& context);
  void start_drag(const Context& context);
  void continue_drag(const Context& context);
  void move_camera(const Context& context, const Point& delta) const;
  void mark(const Context& context);
  void use_wheel(const Context& context);
  void refresh_texture(const Context& context);

  Canvas canvas_;
  ShownPicture shown_; ///< of the frame that is being drawn
  PictureTexture texture_;
  std::shared_ptr<const void> in_texture_; ///< what the texture shows,
  Look look_in_texture_;                   ///< of which its exposure and tone curve,
  double white_in_texture_ = 1;            ///< and for which white
  Tone tone_;                              ///< that it was made with

  SceneOverlay overlay_;
  BarRows bars_;

  Drag drag_ = Drag::none;
  bool pressed_ = false, held_ = false; ///< a button of the mouse, on the picture
  bool moved_ = false;                  ///< the drag is one: the mouse went farther than a click's hand trembles
  Point drag_from_{0, 0};
  bool marks_region_ = false;      ///< the mouse went too far for a click
  preset::Camera camera_at_start_; ///< a drag is measured from its start, so that rounding does not add up
  Look look_at_start_;
  Gestures gestures_{title};
  double last_wheel_s_ = -1; ///< turns of the wheel in quick succession are one gesture
  bool hovered_ = false;
};

} // namespace nephroid::ui
