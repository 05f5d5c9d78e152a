// SPDX-License-Identifier: Apache-2.0
// Arrays through a kernel of check.cl: inputs to the device, one item of work each, outputs back.
#pragma once
#include "compute/compute.h"
#include "kernels/tracing/shared_types.h"

#include <array>
#include <initializer_list>

namespace nephroid::check {

using shared::float4;

inline shared::uint2 device_seed(std::uint64_t seed) {
  return {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
}

/// The group size of the engines' kernels, so that a device that cannot run it fails here too.
inline constexpr std::size_t local_size = 64;

/// Runs kernel `name` of a file over `count` items. Its argument "count" is set here, the others are given.
inline void run_kernel(const compute::Context& context, const char* name, std::size_t count,
                       std::initializer_list<compute::Argument> own, const char* file = "check/check.cl",
                       const compute::Defines& defines = {}) {
  const auto items = static_cast<std::uint32_t>(count);
  compute::Program(context, file, defines)
      .kernel(name)
      .run(count, local_size, std::array{compute::Argument("count", items)}, own);
}

} // namespace nephroid::check
