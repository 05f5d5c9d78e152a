// SPDX-License-Identifier: Apache-2.0
// The workbench on fake jobs and the program's real worker thread, without a window.
#pragma once
#include "fake_job.h"
#include "tests/support/test.h"
#include "ui/state/workbench.h"

namespace nephroid::test {

class WorkbenchFixture : public ::testing::Test {
protected:
  FakeRuns runs;
  TemporaryFolder folder;
  ui::Workbench workbench{runs};

  bool until(const std::function<bool()>& done)
  {
    return eventually([&] { workbench.update(); }, done);
  }
  bool until(job::State state)
  {
    return until([&] { return workbench.run().status().state == state; });
  }
  /// As a panel does; gesture and live: as command::Edit has them.
  void edit(const std::function<void(preset::Preset&)>& change, std::uint64_t gesture = 0, bool live = false)
  {
    preset::Preset edited = *workbench.preset();
    change(edited);
    workbench.apply({ui::command::Edit{"edit", edited, gesture, live}});
  }
};

} // namespace nephroid::test
