// SPDX-License-Identifier: Apache-2.0
// A ball over a floor with a light for tests of what is selected and moved; and fake runs whose scene is loaded, so that a click finds
// something.
#pragma once
#include "fake_job.h"
#include "run/run.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "ui/view/sight.h"

#include <memory>
#include <string>

namespace nephroid::test {

/// From (0, 0, 4) to the origin, 40 degrees high. The ball is at the left, the light at the upper right.
inline std::string ball_text(const std::string& engine = "spectral")
{
  return R"({
  "name": "Ball", "engine": ")" +
         engine + R"(", "unit": "m",
  "scene": {
    "camera": {"position": [0, 0, 4], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 40, "resolution": [64, 48]},
    "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "wall": {"type": "diffuse", "reflectance": 0.5}},
    "objects": [
      {"name": "ball", "shape": {"type": "sphere", "radius": 0.3}, "material": "glass", "transform": {"translate": [-0.5, 0, 0]}},
      {"name": "floor", "shape": {"type": "quad", "size": [2, 1, 2]}, "material": "wall", "transform": {"translate": [0, -1, 0]}}
    ],
    "lights": [{"type": "point", "power_w": 10, "position": [0.9, 0.9, 0]},
               {"type": "spot", "power_w": 10, "position": [-1, 1, 0], "direction": [0, -1, 0]}]
  },
  "stop": {"passes": 20}
})";
}

inline std::shared_ptr<const run::LoadedScene> loaded_scene(const preset::Preset& preset)
{
  auto loaded = std::make_shared<run::LoadedScene>();
  loaded->scene = scene::load_scene(preset);
  loaded->bvh = std::make_shared<scene::Bvh>(scene::build_bvh(loaded->scene.geometry));
  return loaded;
}

inline std::shared_ptr<const ui::SeenScene> seen_scene(const preset::Preset& preset)
{
  return std::any_cast<std::shared_ptr<const ui::SeenScene>>(ui::SeenScene::look(preset, loaded_scene(preset)));
}

class SceneRuns : public FakeRuns {
public:
  ui::NewRun make(const preset::Preset& preset) override
  {
    ui::NewRun run = FakeRuns::make(preset);
    run.seen = {ui::SeenScene::look(preset, loaded_scene(preset))};
    return run;
  }
};

} // namespace nephroid::test
