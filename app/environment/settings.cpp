// SPDX-License-Identifier: Apache-2.0
// Checks that involve several fields of the preset. The plan makes those that need the scene (bake/caster.cpp).
#include "environment/settings.h"

#include "environment/bake/bake.h"
#include "environment/describe_settings.h"
#include "preset/settings_type.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::environment {
namespace {

void check(const preset::Preset& preset, const preset::Where& where) {
  const Settings& s = settings(preset);
  if (!std::ranges::count(direction_counts(), s.directions))
    throw bad_input(where("/environment/directions"), fmt::format("is {}", s.directions), "expected 26, 98 or 386",
                    "they are the points of 3 x 3, 5 x 5 and 9 x 9 grids on a cube's faces");
  if (preset.stop.error && !preset.reference && (!s.refine || s.extinction > 0))
    throw bad_input(
        where("/stop/error"),
        "nothing measures the error of this run: spheres alone, and caustics in the air, make no estimate of it",
        "expected a 'reference', or 'environment.refine' true and 'environment.extinction' 0");
}

} // namespace

const preset::SettingsType& settings_type() {
  static const preset::SettingsType type = preset::settings_type<Settings>(
      "environment", "Caustics of glass and mirrors under an environment, baked once.", check);
  return type;
}

} // namespace nephroid::environment
