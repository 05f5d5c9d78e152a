// SPDX-License-Identifier: Apache-2.0
#include "ui/state/device_runs.h"

#include "compute/own_queue.h"
#include "preset/origins.h"
#include "run/reference.h"

namespace nephroid::ui {
namespace {

constexpr std::chrono::milliseconds look_at_kernels_every{200}; ///< between two checks of the kernels folder

/// The run's reference. The window shows a picture with or without one, so an obstacle becomes a note. A recipe is not
/// rendered here, because every edit of the scene would need another one.
std::shared_ptr<const measure::Reference> reference_of(const run::Prepared& prepared, const compute::Context& context,
                                                       std::vector<std::string>& notes) {
  try {
    auto found = preset::at_origins(prepared.preset, [&] { return run::find_reference(prepared, context); });
    if (!found && prepared.preset.reference)
      notes.emplace_back(
          "the reference of the preset as it is now has not been rendered yet; save it, and nephroid run renders it");
    return found;
  } catch (const Error& error) {
    notes.push_back("without a reference: " + error.line());
    return nullptr;
  }
}

} // namespace

DeviceRuns::DeviceRuns(compute::DeviceOptions device, TakeFacts take_facts)
    : kernels_(device.kernels), take_facts_(take_facts), options_(std::move(device)),
      run_([this] { return this->device(); }), beside_([this] { return compute::with_own_queue(this->device()); }) {
  if (!kernels_.empty()) watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

DeviceRuns::~DeviceRuns() = default;

/// Opens it where it is not open.
compute::Context DeviceRuns::device() {
  const std::lock_guard lock(opening_);
  if (!opened_) opened_ = compute::Context::open(options_);
  return *opened_;
}

NewRun DeviceRuns::make(const preset::Preset& preset, const Watch& watch) {
  if (reread_.exchange(false)) {
    run_.prepared.reset();
    kept_light_ = {};
  }
  if (reopen_.exchange(false)) {
    run_.device.close();
    const std::lock_guard lock(opening_);
    opened_.reset();
    reopen_beside_ = true;
  }
  if (watcher_.joinable()) { // the sources are read below, so changes until here are in this run
    const std::lock_guard lock(watching_);
    compute::KernelTimes now = compute::kernel_times(kernels_);
    if (seen_ && now != *seen_) kept_light_ = {};
    seen_ = std::move(now);
    changed_ = false;
  }
  std::vector<std::string> notes;
  const auto reference = [&](const run::Prepared& prepared, const compute::Context& context) {
    return reference_of(prepared, context, notes);
  };
  preset::at_origins(preset, [&] {
    run::make_ready(run_, preset, {.watch = watch, .reference = reference, .meter_share = meter_share_});
  });
  auto plan = std::make_shared<plan::Plan>(*run_.prepared->plan);
  plan->notes.insert(plan->notes.end(), notes.begin(), notes.end());
  SceneFacts facts;
  if (take_facts_) facts = take_facts_(preset, run_.prepared->loaded);
  return {kept_light_.wrap(std::move(run_.job), *run_.prepared),
          std::move(plan),
          run_.reference,
          std::move(facts),
          run_.device.opened().device(),
          run_.prepared->preset.white};
}

std::unique_ptr<job::Job> DeviceRuns::make_beside(const preset::Preset& preset, const Watch& watch) {
  if (reopen_beside_.exchange(false)) beside_.device.close();
  beside_.prepared.reset(); // files may have changed, and there is little to read
  run::make_ready(beside_, preset, {.watch = watch});
  return std::move(beside_.job);
}

void DeviceRuns::watch(const std::stop_token& stop) {
  std::unique_lock lock(watching_);
  while (!stop.stop_requested()) {
    stopping_.wait_for(lock, stop, look_at_kernels_every, [] { return false; });
    compute::KernelTimes now = compute::kernel_times(kernels_);
    if (!seen_ || now == *seen_) continue;
    seen_ = std::move(now);
    changed_ = true;
  }
}

} // namespace nephroid::ui
