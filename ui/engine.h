// SPDX-License-Identifier: Apache-2.0
// Makes the jobs of the window's presets on a device. Keeps the device's context, with its built kernels, and the loaded scene from
// one run to the next, so that moving the camera loads and builds nothing again.
#pragma once
#include "compute/compute.h"
#include "job/job.h"
#include "preset/preset.h"

#include <memory>

namespace nephroid::run {
struct Prepared;
}

namespace nephroid::ui {

class Engine {
public:
  explicit Engine(compute::DeviceOptions device);
  ~Engine();
  /// Reads the scene and builds the job. From one thread only: the worker's. Throws as run::prepare and compute do.
  std::unique_ptr<job::Job> make(const preset::Preset& preset);

private:
  compute::DeviceOptions options_;
  std::unique_ptr<compute::Context> context_; ///< opened by the first make(): opening a device takes a while
  std::unique_ptr<run::Prepared> previous_;
};

} // namespace nephroid::ui
