// SPDX-License-Identifier: Apache-2.0
// The settings of engine 1 in a preset, and checks that involve more than one field.
#include "spectral/settings.h"

#include "base/error.h"
#include "photons/describe_settings.h"
#include "preset/settings_type.h"

#include <fmt/format.h>

namespace nephroid::spectral {
namespace {

using preset::Where;

void check(const preset::Preset& preset, const Where& where) {
  const photons::Settings& own = settings(preset);
  if (preset.stop.error && !preset.reference && own.estimator == photons::Settings::Estimator::sppm)
    throw bad_input(where("/stop/error"),
                    "nothing measures the error of this run: the estimator sppm makes no estimate of its own error",
                    "expected a 'reference', or another 'spectral.estimator'");
}

} // namespace

const preset::SettingsType& settings_type() {
  static const preset::SettingsType type =
      preset::settings_type<photons::Settings>("spectral", "Dispersion caustics by wavelength clusters.", check);
  return type;
}

} // namespace nephroid::spectral
