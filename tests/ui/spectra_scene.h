// SPDX-License-Identifier: Apache-2.0
// A glass ball in a room of two colours for tests of the panel "Spectra", and runs that look at what it sees.
#pragma once
#include "fake_job.h"
#include "run/run.h"
#include "ui/spectral/spectra/curves.h"

#include <string>

namespace nephroid::test {

/// spectrum, effort: JSON.
inline std::string room_text(const std::string& spectrum, const std::string& effort = "importance")
{
  return R"({
  "name": "Room", "engine": "spectral", "unit": "m",
  "scene": {
    "camera": {"position": [0, 0, 4], "resolution": [64, 48]},
    "materials": {
      "glass": {"type": "dielectric", "dispersion": {"type": "cauchy", "coefficients": [1.6, 0.02]}},
      "red": {"type": "diffuse", "reflectance": "red"},
      "floor": {"type": "diffuse", "reflectance": 0.5},
      "unused": {"type": "diffuse", "reflectance": 1}
    },
    "objects": [
      {"name": "ball", "shape": {"type": "sphere", "radius": 0.4}, "material": "glass"},
      {"name": "room", "shape": {"type": "box", "size": [4, 4, 4], "inwards": true}, "material": "red"},
      {"name": "floor", "shape": {"type": "quad", "size": [4, 1, 4]}, "material": "floor", "transform": {"translate": [0, -1, 0]}}
    ],
    "lights": [{"type": "point", "power_w": 10, "position": [0.5, 1.5, 1], "spectrum": )" +
         spectrum + R"(}]
  },
  "spectral": {"effort": ")" +
         effort + R"(", "threshold_deg": 0.2},
  "stop": {"passes": 100}
})";
}

/// Fake jobs, but what the glass sees is looked at as the program does.
class SeeingRuns : public FakeRuns {
public:
  ui::NewRun make(const preset::Preset& preset) override
  {
    ui::NewRun run = FakeRuns::make(preset);
    const scene::Scene scene = scene::load_scene(preset);
    run.seen = {ui::SeenByGlass::look(preset, scene, scene::build_bvh(scene.geometry))};
    return run;
  }
};

} // namespace nephroid::test
