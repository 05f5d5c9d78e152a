// SPDX-License-Identifier: Apache-2.0
// The panel Meters on a real device: numbers of a closed form, a cell under the mouse, and the map over the picture
// where the camera sees the meter.
#include "tests/support/render.h"
#include "ui/meters/panel.h"
#include "ui/state/device_runs.h"
#include "window_fixture.h"

namespace nephroid::ui::meters_panel_test {

class RealRuns : public DeviceRuns {
public:
  RealRuns() : DeviceRuns({}, take_facts) {}
};

/// 100 W/m^2 straight down on the left half of a white floor: a plate above keeps it from the right half.
constexpr const char* preset_text = R"({"engine": "spectral", "white": 50, "stop": {"seconds": 600},
  "spectral": {"indirect": false},
  "scene": {"camera": {"position": [0, 4, 0], "target": [0, 0, 0], "up": [0, 0, -1], "projection": "orthographic",
                       "height": 2, "resolution": [16, 16]},
    "materials": {"white": {"type": "diffuse", "reflectance": 0.5}, "black": {"type": "diffuse", "reflectance": 0}},
    "objects": [{"name": "floor", "shape": {"type": "quad", "size": [2, 1, 2]}, "material": "white"},
                {"name": "plate", "shape": {"type": "quad", "size": [2, 1, 4]}, "material": "black",
                 "transform": {"translate": [1, 1, 0]}}],
    "lights": [{"type": "directional", "direction": [0, -1, 0], "irradiance_w_m2": 100}],
    "meters": [{"type": "surface", "name": "floor", "object": "floor", "cell": 0.5, "threshold": "50 W/m^2"}]}})";

class MetersPanelTest : public test::WindowFixtureOf<RealRuns> {
protected:
  MetersPanelTest() : WindowFixtureOf("meters") { test::shared_context(); }
  const MetersPanel& meters() { return workspace.panel<MetersPanel>(); }
};

TEST_F(MetersPanelTest, ShowsNumbersACellAndTheMapOnThePicture) {
  open(preset_text);
  ASSERT_TRUE(until([&] { return meters().shown() != nullptr; }));
  const meters::Reading& reading = *meters().shown()->reading;
  const meters::Numbers& watts = reading.all().numbers(meters::Quantity::irradiance);
  EXPECT_NEAR(watts.mean.value, 50, 0.5);
  EXPECT_NEAR(watts.peak.value, 100, 0.1);
  EXPECT_NEAR(reading.share_above.value().value, 0.5, 1e-6);

  frames(3);
  click(meters().place_of("map").value());
  ASSERT_TRUE(meters().cell());
  const glm::dvec3 centre = meters().shown()->surface->centres.at(*meters().cell());
  EXPECT_LT(std::max(std::abs(centre.x), std::abs(centre.z)), 0.5) << "the map's middle";

  EXPECT_FALSE(view().map().is_shown());
  click(meters().place_of("on the picture").value());
  ASSERT_TRUE(until([&] { return view().map().is_shown(); }));
  const auto alpha = [&](std::size_t column, std::size_t row) {
    return view().map().texture().pixels()[4 * (16 * row + column) + 3];
  };
  for (const std::size_t row : {0, 8, 15}) {
    EXPECT_GT(alpha(2, row), 200) << "the floor";
    EXPECT_EQ(alpha(13, row), 0) << "the plate is before it";
  }
  EXPECT_EQ(view().map().high(), 100);
  EXPECT_EQ(view().map().unit(), "W/m^2");
  click(meters().place_of("on the picture").value());
  ASSERT_TRUE(until([&] { return !view().map().is_shown(); }));
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(MetersPanelTest, IsThereOnlyWhereAPresetHasMeters) {
  std::string text = preset_text;
  const std::size_t meters = text.find(",\n    \"meters\"");
  open(text.substr(0, meters) + "}}");
  EXPECT_EQ(this->meters().place_of("meter"), std::nullopt);
}

} // namespace nephroid::ui::meters_panel_test
