// SPDX-License-Identifier: Apache-2.0
#include "run/display.h"

#include "optics/colour.h"
#include "preset/settings_type.h"
#include "scatter/spectra.h"

#include <algorithm>

namespace nephroid::run {

bool has_display(const preset::Preset& preset) {
  return std::ranges::count(preset.settings.type().without, "display") == 0;
}

image::Display display_of(const preset::Preset& preset) {
  image::Display display;
  if (!has_display(preset)) return display;
  display.gamut = preset.display.gamut;
  display.tone = preset.display.tone;
  if (preset.display.white_balance == preset::Display::WhiteBalance::d65) return display;
  const Location where = Location(preset.source) / "scene" / "lights" / 0 / "spectrum";
  const optics::Colour white = optics::to_xyz(scatter::make_light_spectrum(preset.scene.lights.at(0).spectrum, where)),
                       rgb = optics::xyz_to_linear_srgb(white);
  if (std::ranges::min(rgb) < -0.04 * std::ranges::max(rgb)) // a laser's, a sodium lamp's: the balance would be absurd
    throw bad_input(Location(preset.source) / "display" / "white_balance",
                    "is \"light\", and no display has the colour of the first light", "expected \"D65\"");
  const auto balance = optics::white_balance(white);
  for (std::size_t i = 0; i < 9; ++i) display.white_balance[i] = static_cast<float>(balance[i / 3][i % 3]);
  return display;
}

} // namespace nephroid::run
