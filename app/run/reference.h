// SPDX-License-Identifier: Apache-2.0
// What a run is measured against: a file, or a recipe that is rendered once and kept in the cache.
#pragma once
#include "compute/compute.h"
#include "measure/measured_job.h"
#include "run/prepare.h"

#include <functional>
#include <memory>
#include <stop_token>

namespace nephroid::run {

/// Null where the preset has none, and where it is a recipe that is not in the cache or damaged there. Reads the mask
/// of preset.measure too. Throws bad_input where a file cannot be read or has another size than the run's picture.
std::shared_ptr<const measure::Reference> find_reference(const Prepared& prepared, const compute::Context& context);

/// How making one goes on: 0..1, and the seconds of work so far.
using ReferenceProgress = std::function<void(double fraction, double seconds)>;

/// Renders the recipe with both of its seeds and puts their mean into the cache. Throws failed where it cannot be made
/// (memory, a time above reference.seconds, the cache), interrupted where `stop` asks for it.
std::shared_ptr<const measure::Reference> make_reference(const Prepared& prepared, const compute::Context& context,
                                                         const std::stop_token& stop,
                                                         const ReferenceProgress& progress);

} // namespace nephroid::run
