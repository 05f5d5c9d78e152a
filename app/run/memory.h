// SPDX-License-Identifier: Apache-2.0
// Whether a run fits is asked before anything is allocated: Linux grants memory that it does not have and kills the
// process later.
#pragma once
#include "compute/compute.h"
#include "plan/plan.h"
#include "run/prepare.h"

#include <cstdint>
#include <optional>

namespace nephroid::run {

/// Throws failed where the device or this machine has not enough memory for the run.
void require_memory(const Prepared& prepared, const compute::Context& context);

/// What the program itself needs at most to make a picture of width x height pixels, measure it and write its files.
plan::PlannedBuffer picture_and_files(const plan::Plan& plan, int width, int height);

/// What an animation's frame needs for the frame before it, and for what it leaves itself.
plan::PlannedBuffer held_of_frame_before(const plan::Plan& plan, int width, int height);

/// What the system says can be allocated without swapping, in bytes; empty where it does not say.
std::optional<std::uint64_t> available_memory_bytes();

/// Throws failed where the plan's buffers exceed the device's memory, one of them the device's largest buffer, or what
/// this machine has to hold (for a cpu device its buffers too) `available` bytes. width, height: for the message.
void require_memory(const plan::Plan& plan, int width, int height, const compute::DeviceInfo& device,
                    std::optional<std::uint64_t> available);

} // namespace nephroid::run
