// SPDX-License-Identifier: Apache-2.0
// Makes the runs of the window's presets on a device. The device's context, with its built kernels, and the loaded
// scene stay from one run to the next, so moving the camera loads and builds nothing again. A kernels folder
// (--kernels) is watched.
#pragma once
#include "compute/compute.h"
#include "run/ready.h"
#include "ui/state/kept_light.h"
#include "ui/state/run_in_hand.h"

#include <atomic>
#include <condition_variable>
#include <thread>

namespace nephroid::ui {

/// Returns what panels keep of a loaded scene. Called on the worker's thread.
using TakeFacts = SceneFacts (*)(const preset::Preset&, const std::shared_ptr<const run::LoadedScene>&);

class DeviceRuns : public RunSource {
public:
  /// take_facts: null where no panel needs any.
  explicit DeviceRuns(compute::DeviceOptions device, TakeFacts take_facts = nullptr);
  ~DeviceRuns() override;
  /// Reads the scene and builds the job. Throws as run::make_ready.
  NewRun make(const preset::Preset& preset, const Watch& watch) override;
  /// On a queue of its own.
  std::unique_ptr<job::Job> make_beside(const preset::Preset& preset, const Watch& watch) override;
  std::function<compute::Context()> device_opener() const override {
    return [options = options_] { return compute::Context::open(options); };
  }
  void reread_files() override { reread_ = true; }
  void reopen_device() override { reopen_ = true; }
  void look_at_meters(bool on) override { *meter_share_ = on ? 0.5 : run::usual_meter_share; }
  /// True once after a file in the kernels folder has changed since the newest run was built.
  bool take_changed() override { return changed_.exchange(false); }

private:
  compute::Context device();
  void watch(const std::stop_token& stop);

  std::filesystem::path kernels_; ///< empty: none
  TakeFacts take_facts_;
  compute::DeviceOptions options_;
  std::mutex opening_;
  std::optional<compute::Context> opened_; ///< for run_; beside_ has a queue of its own there. Guarded by opening_
  run::ReadyRun run_;                      ///< the newest one, without its job; the worker's thread only
  KeptLight kept_light_;                   ///< of run_'s jobs
  run::ReadyRun beside_;                   ///< the same of small pictures
  std::shared_ptr<std::atomic<double>> meter_share_ = std::make_shared<std::atomic<double>>(run::usual_meter_share);
  std::atomic<bool> changed_{false}, reread_{false}, reopen_{false}, reopen_beside_{false};
  std::mutex watching_;                      ///< held while the folder is read
  std::optional<compute::KernelTimes> seen_; ///< by the newest run or check; nothing before the first run
  std::condition_variable_any stopping_;
  std::jthread watcher_; ///< so that no frame or run waits for the disk. Last: it uses the other members.
};

} // namespace nephroid::ui
