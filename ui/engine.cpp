// SPDX-License-Identifier: Apache-2.0
#include "ui/engine.h"

#include "run/run.h"

#include <chrono>

namespace nephroid::ui {
namespace {

constexpr std::chrono::milliseconds look_every{200}; ///< at the kernels folder

} // namespace

Engine::Engine(compute::DeviceOptions device) : options_(std::move(device))
{
  if (!options_.kernels.empty()) watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

Engine::~Engine() = default;

NewRun Engine::make(const preset::Preset& preset)
{
  auto prepared = std::make_unique<run::Prepared>(run::prepare(preset, previous_.get()));
  const std::lock_guard lock(building_);
  if (!context_) context_ = std::make_unique<compute::Context>(compute::Context::open(options_));
  // The sources are read below: what changed until here is in this run.
  compute::kernels_changed(*context_);
  changed_ = false;
  previous_ = std::move(prepared);
  return {run::make_job(*previous_, *context_), previous_->plan, nullptr};
}

void Engine::watch(const std::stop_token& stop)
{
  std::unique_lock lock(building_);
  while (!stop.stop_requested()) {
    stopping_.wait_for(lock, stop, look_every, [] { return false; });
    if (context_ && compute::kernels_changed(*context_)) changed_ = true;
  }
}

} // namespace nephroid::ui
