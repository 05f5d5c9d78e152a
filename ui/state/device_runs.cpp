// SPDX-License-Identifier: Apache-2.0
#include "ui/state/device_runs.h"

#include "compute/compute.h"
#include "measure/measured_job.h"
#include "preset/origins.h"
#include "run/run.h"

namespace nephroid::ui {
namespace {

constexpr std::chrono::milliseconds look_at_kernels_every{200}; ///< at the kernels folder

/// What the run is measured against. The window shows a picture with or without one: what stands against it becomes a note. A recipe is
/// not rendered here, because every edit of the scene asks for another one.
std::shared_ptr<const measure::Reference> reference_of(const run::Prepared& prepared, const compute::Context& context,
                                                       std::vector<std::string>& notes)
{
  try {
    auto found = preset::at_origins(prepared.preset, [&] { return run::find_reference(prepared, context); });
    if (!found && prepared.preset.reference)
      notes.emplace_back("the reference of the preset as it is now has not been rendered yet; save it, and nephroid run renders it");
    return found;
  } catch (const Error& error) {
    notes.push_back("without a reference: " + error.line());
    return nullptr;
  }
}

} // namespace

DeviceRuns::DeviceRuns(compute::DeviceOptions device, TakeFacts take_facts) : options_(std::move(device)), take_facts_(take_facts)
{
  if (!options_.kernels.empty()) watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

DeviceRuns::~DeviceRuns() = default;

NewRun DeviceRuns::make(const preset::Preset& preset, const Watch& watch)
{
  if (reread_.exchange(false)) previous_.reset();
  auto prepared = preset::at_origins(preset, [&] { return std::make_unique<run::Prepared>(run::prepare(preset, previous_.get(), watch)); });
  if (reopen_.exchange(false)) context_.reset();
  if (!context_) {
    watch.begin("opening the device");
    context_ = std::make_unique<compute::Context>(compute::Context::open(options_));
  }
  std::optional<compute::TellOfCompiling> telling(std::in_place, *context_, [watch] { watch.begin("compiling kernels"); });
  if (watcher_.joinable()) { // the sources are read below: what changed until here is in this run
    const std::lock_guard lock(watching_);
    seen_ = compute::kernel_times(options_.kernels);
    changed_ = false;
  }
  previous_ = std::move(prepared);
  if (preset.white == 0) previous_->preset.white = run::fitted_white(*previous_, *context_, watch);
  auto plan = std::make_shared<plan::Plan>(*previous_->plan);
  std::shared_ptr<const measure::Reference> reference = reference_of(*previous_, *context_, plan->notes);
  watch.begin("setting up the run");
  auto job = measure::measured(run::make_job(*previous_, *context_), previous_->preset, reference);
  telling.reset(); // what a job builds later is short
  SceneFacts facts;
  if (take_facts_) facts = take_facts_(preset, previous_->loaded);
  return {std::move(job), std::move(plan), std::move(reference), std::move(facts), context_->device(), previous_->preset.white};
}

void DeviceRuns::watch(const std::stop_token& stop)
{
  std::unique_lock lock(watching_);
  while (!stop.stop_requested()) {
    stopping_.wait_for(lock, stop, look_at_kernels_every, [] { return false; });
    compute::KernelTimes now = compute::kernel_times(options_.kernels);
    if (!seen_ || now == *seen_) continue;
    seen_ = std::move(now);
    changed_ = true;
  }
}

} // namespace nephroid::ui
