// SPDX-License-Identifier: Apache-2.0
// Small pictures by the real engine, for checks.
#pragma once
#include "compute/compute.h"
#include "job/job.h"
#include "preset/preset.h"

#include <string>

namespace nephroid::check {

/// Runs engine 1 to the preset's end, with the general kernels rather than those made for the scene: so all checks together build two
/// programs, which is most of their time on a device whose compiler has not seen them. Tests compare the two kinds.
job::Snapshot render(preset::Preset preset, const compute::Context& context);

/// The layer of that name, which must be there.
const job::Layer& layer(const job::Snapshot& snapshot, const std::string& name);

/// The luminance Y of a pixel of a layer.
double luminance(const job::Layer& layer, int width, int row, int column);

} // namespace nephroid::check
