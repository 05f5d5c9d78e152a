// SPDX-License-Identifier: Apache-2.0
// Makes the runs of the window's presets on a device. Keeps the device's context, with its built kernels, and the
// loaded scene from one run to the next, so that moving the camera loads and builds nothing again. With a kernels
// folder (--kernels) it watches that.
#pragma once
#include "compute/compute.h"
#include "run/ready.h"
#include "ui/state/run_in_hand.h"

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace nephroid::ui {

/// What panels keep of a loaded scene; called on the worker's thread.
using TakeFacts = SceneFacts (*)(const preset::Preset&, const std::shared_ptr<const run::LoadedScene>&);

class DeviceRuns : public RunSource {
public:
  /// take_facts: null where no panel asks.
  explicit DeviceRuns(compute::DeviceOptions device, TakeFacts take_facts = nullptr);
  ~DeviceRuns() override;
  /// Reads the scene and builds the job. Throws as run::make_ready.
  NewRun make(const preset::Preset& preset, const Watch& watch) override;
  void reread_files() override { reread_ = true; }
  void reopen_device() override { reopen_ = true; }
  /// True once after a file in the kernels folder changed that the newest run was not built from.
  bool take_changed() override { return changed_.exchange(false); }

private:
  void watch(const std::stop_token& stop);

  std::filesystem::path kernels_; ///< the kernels folder; empty: none
  TakeFacts take_facts_;
  run::ReadyRun run_; ///< the newest one, without its job; the worker's thread only
  std::atomic<bool> changed_{false}, reread_{false}, reopen_{false};
  std::mutex watching_; ///< held for a look at the folder
  std::optional<compute::KernelTimes>
      seen_; ///< by the newest run or look, whichever is later; nothing before the first run
  std::condition_variable_any stopping_;
  std::jthread watcher_; ///< a thread of its own: neither a frame nor a run waits for the folder's disk. Last: it uses
                         ///< the others.
};

} // namespace nephroid::ui
