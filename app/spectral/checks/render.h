// SPDX-License-Identifier: Apache-2.0
// Small pictures by the real engine and its tables, for checks, and what checks and tests read off a picture.
#pragma once
#include "base/error.h"
#include "check/check.h"
#include "compute/compute.h"
#include "job/job.h"
#include "optics/colour.h"
#include "preset/preset.h"
#include "spectral/energy.h"
#include "spectral/tables/run_tables.h"

#include <string>
#include <string_view>
#include <vector>

namespace nephroid::check {

/// Runs engine 1 to the preset's end, with the general kernels rather than those made for the scene: so all checks together build two
/// programs, which is most of their time on a device whose compiler has not seen them. Tests compare the two kinds.
job::Snapshot render(preset::Preset preset, const compute::Context& context);

/// The tables that the engine would render the preset with.
spectral::RunTables device_tables(const preset::Preset& preset);

/// The layer of that name, which must be there: throws failed else.
inline const job::Layer& layer(const job::Snapshot& snapshot, std::string_view name)
{
  for (const job::Layer& candidate : snapshot.picture->layers)
    if (candidate.name == name) return candidate;
  throw failed("check", "no layer " + std::string(name));
}

/// The luminance Y of a pixel of a layer; width: of the picture.
inline double luminance(const job::Layer& layer, int width, int row, int column)
{
  const std::size_t i = 3 * static_cast<std::size_t>(row * width + column);
  return optics::linear_srgb_to_xyz({layer.rgb[i], layer.rgb[i + 1], layer.rgb[i + 2]})[1];
}

/// The checks of engine 1 by subject: its tables, its lights, and small pictures against closed forms.
Checks spectral_checks();   ///< spectra.cpp: sums over wavelengths, absorption
Checks emission_checks();   ///< emission.cpp: what lights send
Checks radiometry_checks(); ///< radiometry.cpp: small pictures against closed forms of irradiance and power
Checks refraction_checks(); ///< refraction.cpp: plates, a prism and a ball lens

} // namespace nephroid::check
