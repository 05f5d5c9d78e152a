// SPDX-License-Identifier: Apache-2.0
// The scenes to begin with on a real device: each has a picture at once.
#include "fake_job.h"
#include "ui/state/device_runs.h"
#include "ui/state/new_scenes.h"

namespace nephroid::ui::new_scenes_test {

TEST(NewScenesTest, EachIsDrawn)
{
  for (const NewScene kind : {NewScene::spectral, NewScene::environment, NewScene::inverse}) {
    DeviceRuns engine({});
    Workbench workbench(engine);
    workbench.apply({command::New{kind}});
    const auto brightness = [&] {
      double all = 0;
      if (workbench.run().snapshot())
        for (const float value : workbench.run().snapshot()->picture->rgb) all += value;
      return all;
    };
    EXPECT_TRUE(test::eventually([&] { workbench.update(); }, [&] { return brightness() > 0; })) << static_cast<int>(kind);
    EXPECT_TRUE(workbench.messages().empty()) << workbench.messages().front().line;
  }
}

} // namespace nephroid::ui::new_scenes_test
