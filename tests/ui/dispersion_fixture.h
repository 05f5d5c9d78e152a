// SPDX-License-Identifier: Apache-2.0
// The panel "Dispersion" in a window without a display: presets with glass, the mouse on its points and widgets.
#pragma once
#include "optics/dispersion.h"
#include "spectral/settings.h"
#include "window_fixture.h"

namespace nephroid::test {

using photons::ClusterMethod;
using ui::ControlPoint;

inline std::string shipped(const std::string& name) {
  return std::string(NEPHROID_SOURCE_DIR) + "/presets/materials/" + name + ".yml";
}

inline preset::Dispersion from_file(const std::string& file) {
  return {.type = preset::Dispersion::Type::file, .file = file};
}

inline preset::Dispersion from_points(std::vector<ControlPoint> points) {
  return ui::with_points({}, std::move(points));
}

inline const std::vector<ControlPoint> five{{380, 1.62}, {450, 1.58}, {550, 1.55}, {650, 1.53}, {780, 1.52}};

class DispersionFixture : public WindowFixture {
protected:
  DispersionFixture() : WindowFixture("dispersion") {}

  /// A preset of these dielectrics, with a ball of each.
  void open_glass(const std::map<std::string, preset::Dispersion>& glasses) {
    preset::Preset made = preset::parse_preset(test::preset_text, "test");
    for (const auto& [name, dispersion] : glasses) {
      preset::Material& material = made.scene.materials[name];
      material.type = preset::Material::Type::dielectric;
      material.dispersion = dispersion;
      preset::Object& ball = made.scene.objects.emplace_back();
      ball.name = ball.material = name;
      ball.shape = preset::Shape{};
    }
    ASSERT_TRUE(workbench.open(folder.write("glass.json", preset::to_json(made))));
    frames(4);
  }
  const ui::DispersionPanel& panel() const { return workspace.panel<ui::DispersionPanel>(); }
  const preset::Dispersion& dispersion(const std::string& material = "glass") const {
    return workbench.preset()->scene.materials.at(material).dispersion;
  }
  std::vector<ControlPoint> points() const { return ui::sorted_points(dispersion()); }
  std::size_t shown_count(ClusterMethod method) const {
    return panel().model().figures(method).clustering.clusters.size();
  }
  /// What the clusters of the preset's curve are, without the panel.
  std::size_t true_count(ClusterMethod method) const {
    return photons::cluster_wavelengths(
               optics::sample_n(optics::control_points(dispersion().table), optics::Extrapolation::automatic),
               spectral::settings(*workbench.preset()).threshold_deg, method)
        .clusters.size();
  }
  void expect_true_counts() const {
    ASSERT_EQ(panel().model().error(), "");
    for (const ClusterMethod method : {ClusterMethod::optimal, ClusterMethod::thesis, ClusterMethod::brute_force})
      EXPECT_EQ(shown_count(method), true_count(method));
  }

  using WindowFixture::click;
  void click(const std::string& widget) { click(panel().place_of(widget).value()); }
  /// In the plot, as wavelength and n.
  void drag_point(const ControlPoint& from, const ControlPoint& to, int steps = 5) {
    drag_between(panel().plot().to_screen(from), panel().plot().to_screen(to), steps);
    frame();
  }
};

} // namespace nephroid::test
