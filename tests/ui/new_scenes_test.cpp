// SPDX-License-Identifier: Apache-2.0
// The scenes to begin with on a real device: each has a picture at once.
#include "engine/engine.h"
#include "fake_job.h"
#include "ui/state/device_runs.h"

namespace nephroid::ui::new_scenes_test {

TEST(NewScenesTest, EachIsDrawn)
{
  for (const engine::Engine* engine : engine::engines()) {
    DeviceRuns runs({});
    Workbench workbench(runs);
    workbench.apply({command::New{engine->introduction.new_scene.preset}});
    const auto brightness = [&] {
      double all = 0;
      if (workbench.run().snapshot())
        for (const float value : workbench.run().snapshot()->picture->rgb) all += value;
      return all;
    };
    EXPECT_TRUE(test::eventually([&] { workbench.update(); }, [&] { return brightness() > 0; })) << name_of(*engine);
    EXPECT_TRUE(workbench.messages().empty()) << workbench.messages().front().line;
  }
}

} // namespace nephroid::ui::new_scenes_test
