// SPDX-License-Identifier: Apache-2.0
// The panel Inspector: one pixel with all its values, its neighbours and its spectrum, and statistics of a rectangle of
// pixels. Which they are the View's mouse says, and actions (commands InspectPixel and SelectRegion).
#pragma once
#include "ui/inspector/pixels.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

class InspectorPanel : public Panel {
public:
  static constexpr const char* title = "Inspector";
  /// wavelengths: shared with other panels; outlives this.
  explicit InspectorPanel(WavelengthAxis& wavelengths) : axis_(wavelengths) {}
  void draw(const Context& context) override;

  /// For tests: the region's; null where there are none yet.
  const std::shared_ptr<const RegionStatistics>& statistics() const { return statistics_.newest(); }

private:
  void draw_pixel(const Context& context);
  void draw_neighbours(const Context& context);
  void draw_spectrum(const Context& context);
  void offer_spectra(const Context& context, const job::PixelSpectrum& none);
  void draw_region(const Context& context);

  /// What is drawn stays while nothing changes, since an automatic range takes the whole picture.
  struct Neighbours {
    std::shared_ptr<const void> owner;
    std::array<int, 2> pixel{};
    ViewSettings view_settings;
    image::Display display;
    double white = 1;
    std::vector<unsigned char> rgba; ///< transparent outside of the picture
  };

  WavelengthAxis& axis_;
  NewestResult<RegionStatistics> statistics_;
  Neighbours neighbours_;
};

} // namespace nephroid::ui
