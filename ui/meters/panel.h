// SPDX-License-Identifier: Apache-2.0
// The panel Meters: what a meter of the preset shows, with its intervals: numbers, map, and how they came to be.
#pragma once
#include "meters/map.h"
#include "meters/shown.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/picture_texture.h"

namespace nephroid::ui {

class MetersPanel : public Panel {
public:
  static constexpr const char* title = "Meters";
  void draw(const Context& context) override;

  /// For tests: the meter that was drawn last; null where it had no reading.
  const meters::Shown* shown() const { return shown_ ? &*shown_ : nullptr; }
  /// For tests: the cell that a click on the map chose.
  std::optional<std::size_t> cell() const { return cell_; }

private:
  /// What a map is coloured of.
  struct Colours {
    std::shared_ptr<const meters::Reading> reading;
    std::string layer;
    preset::Meter::Unit unit = preset::Meter::Unit::watts;
    bool operator==(const Colours&) const = default;
  };
  void draw_choices(const Context& context);
  void draw_numbers();
  void draw_map(const Context& context);
  void draw_cell(std::size_t cell);
  void draw_history();
  const meters::LayerReading& layer() const;
  std::string cell_text(std::size_t cell) const;

  std::string name_;                        ///< of the meter; unknown: the first
  std::string layer_ = "all";               ///< unknown: all
  std::optional<preset::Meter::Unit> unit_; ///< nothing: the meter's own
  std::optional<meters::Shown> shown_;      ///< in this frame
  preset::Meter::Unit unit_now_ = preset::Meter::Unit::watts;
  std::optional<std::size_t> cell_;
  std::string preset_unit_; ///< of places
  std::optional<Colours> coloured_;
  meters::Map map_;
  int zoom_ = 1;
  double high_ = 1;
  PictureTexture texture_;
};

} // namespace nephroid::ui
