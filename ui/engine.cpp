// SPDX-License-Identifier: Apache-2.0
#include "ui/engine.h"

#include "run/run.h"

namespace nephroid::ui {

Engine::Engine(compute::DeviceOptions device) : options_(std::move(device)) {}

Engine::~Engine() = default;

std::unique_ptr<job::Job> Engine::make(const preset::Preset& preset)
{
  auto prepared = std::make_unique<run::Prepared>(run::prepare(preset, previous_.get()));
  if (!context_) context_ = std::make_unique<compute::Context>(compute::Context::open(options_));
  previous_ = std::move(prepared);
  return run::make_job(*previous_, *context_);
}

} // namespace nephroid::ui
