// SPDX-License-Identifier: Apache-2.0
// The environment as a light, as kernels/tracing/sky.h reads it.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "scene/environment.h"

#include <cstdint>
#include <vector>

namespace nephroid::tracing {

struct SkyTables {
  shared::DeviceBackground size{};
  std::vector<float> cdf;       ///< exact_cdf of the rows' flux, then of the texels of each row
  std::vector<float> colour;    ///< [row][column][3]: what a photon of the texel carries of each primary, about rgb over grey
  shared::float4 mean_colour{}; ///< of all photons
};

/// Where texels are looked up: of what is seen, too.
shared::DeviceBackground picture_size(const scene::Environment& environment);

/// Of an environment that is not black. A texel of less than 2^-24 of its row is drawn more often than its flux asks for; its photons
/// carry less then, so that nothing is too bright.
SkyTables make_sky_tables(const scene::Environment& environment);

/// Bytes on the device.
std::uint64_t bytes_of(const SkyTables& tables);

} // namespace nephroid::tracing
