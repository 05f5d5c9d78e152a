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

/// A cluster drawn at random needs sppm's pass of its own; a variance is measured where all share a film; a tile is a
/// piece of a lattice, swept along its wavelengths.
void check_estimator(const photons::Settings& s, const std::string& pointer, const Where& where) {
  const bool sppm = s.estimator == photons::Settings::Estimator::sppm,
             tiles = s.estimator == photons::Settings::Estimator::tiles;
  if (s.effort == photons::Settings::Effort::random && !sppm)
    throw bad_input(where(preset::child(pointer, "effort")), "random needs the estimator sppm",
                    "expected spectral.estimator to be sppm", "choose that, or another effort");
  if (s.effort == photons::Settings::Effort::variance && (sppm || tiles))
    throw bad_input(where(preset::child(pointer, "effort")),
                    fmt::format("variance is not measured by the estimator {}", sppm ? "sppm" : "tiles"),
                    "expected another effort or estimator", "choose effort importance, or estimator automatic");
  for (const auto& [key, is_set] : {std::pair{"jitter", s.jitter}, {"low_discrepancy", s.low_discrepancy}})
    if (tiles && !is_set)
      throw bad_input(where(preset::child(pointer, key)), "the estimator tiles cannot do without",
                      "expected true, or another 'spectral.estimator'", "choose estimator points");
}

/// Layers hold the sums of splats of whole clusters.
void check_relight(const preset::Preset& preset, const photons::Settings& spectral, const Where& where) {
  if (!spectral.relight) return;
  const auto refuse = [&](bool contradicts, const char* key, const char* reason) {
    if (contradicts)
      throw bad_input(where(preset::child("/spectral", key)), fmt::format("cannot be kept in layers: {}", reason),
                      "expected 'spectral.relight' false, or this as it is by default");
  };
  refuse(spectral.estimator == photons::Settings::Estimator::sppm, "estimator",
         "photon maps add up colours, not layers");
  refuse(spectral.estimator == photons::Settings::Estimator::tiles, "estimator",
         "a tile's light is of a part of the wavelengths, not of whole clusters");
  refuse(spectral.effort != photons::Settings::Effort::automatic && spectral.effort != photons::Settings::Effort::power,
         "effort",
         "half of the photons go by the present light's power, and half to every cluster alike for lights to come");
  refuse(spectral.indirect, "indirect", "its light met several reflectors");
  if (preset.scene.environment && preset.scene.environment->lights)
    throw bad_input(where("/scene/environment/lights"),
                    "cannot be kept in layers: every texel has a spectrum of its own",
                    "expected 'spectral.relight' false, or an environment that is only seen");
}

void check(const preset::Preset& preset, const Where& where) {
  const photons::Settings& own = settings(preset);
  check_estimator(own, "/spectral", where);
  if (preset.reference && preset.reference->settings)
    check_estimator(preset.reference->settings->as<photons::Settings>(), "/reference/spectral", where);
  if (preset.stop.error && !preset.reference && own.estimator == photons::Settings::Estimator::sppm)
    throw bad_input(where("/stop/error"),
                    "nothing measures the error of this run: the estimator sppm makes no estimate of its own error",
                    "expected a 'reference', or another 'spectral.estimator'");
  check_relight(preset, own, where);
}

} // namespace

const preset::SettingsType& settings_type() {
  static const preset::SettingsType type =
      preset::settings_type<photons::Settings>("spectral", "Dispersion caustics by wavelength clusters.", check);
  return type;
}

} // namespace nephroid::spectral
