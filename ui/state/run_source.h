// SPDX-License-Identifier: Apache-2.0
// Where the workbench gets its runs from: the program gives ui/state/device_runs.h with a device, tests give jobs of their own.
#pragma once
#include "compute/compute.h"
#include "job/job.h"
#include "measure/reference.h"
#include "plan/plan.h"
#include "preset/preset.h"

#include <any>
#include <memory>
#include <vector>

namespace nephroid::ui {

struct NewRun {
  std::unique_ptr<job::Job> job;
  std::shared_ptr<const plan::Plan> plan;
  std::shared_ptr<const measure::Reference> reference; ///< what it is measured against; null where there is none
  std::vector<std::any> seen = {};                     ///< what panels looked for in the loaded scene: RunInHand::seen
  compute::DeviceInfo device = {};                     ///< that it works on
};

class RunSource {
public:
  virtual ~RunSource() = default;
  /// On the worker's thread only. What it throws is why the run failed.
  virtual NewRun make(const preset::Preset& preset) = 0;
  /// From any thread, at once: the next make() reads every file anew; and opens the device anew, which a run may have lost.
  virtual void reread_files() {}
  virtual void reopen_device() {}
  /// From any thread, at once: whether kernels are being compiled.
  virtual bool compiling() const { return false; }
  /// From any thread, at once: true once after what every run is made of (the kernels) changed.
  virtual bool take_changed() = 0;
};

} // namespace nephroid::ui
