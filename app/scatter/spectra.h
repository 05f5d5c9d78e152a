// SPDX-License-Identifier: Apache-2.0
// From a preset's spectra and indices of refraction, which are words and numbers, to values on the 401 wavelengths.
#pragma once
#include "base/error.h"
#include "base/files.h"
#include "optics/dispersion.h"
#include "optics/wavelength.h"
#include "preset/preset.h"

#include <optional>
#include <set>

namespace nephroid::scatter {

/// What optics throws names a curve or a file; the person needs the preset's field as well.
template <class Make>
auto at(const Location& where, const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    if (error.location() == where) throw;
    throw Error(error.kind(), where, error.line());
  }
}

/// The preset's words for it, which knows nothing of optics, are the same in the same order.
inline optics::Extrapolation outside_policy(preset::Extrapolation outside) {
  static_assert(int(optics::Extrapolation::hold) == int(preset::Extrapolation::hold) &&
                int(optics::Extrapolation::refuse) == int(preset::Extrapolation::refuse));
  return static_cast<optics::Extrapolation>(outside);
}

/// The file of a preset's dispersion data: found as other files are, or a shipped material by its short name
/// ("N-SF66"), which means the same from every folder.
std::filesystem::path find_dispersion(const std::string& name, const FileFinder& finder, const Location& where);

/// The names of the shipped materials: "N-BK7".
std::set<std::string> shipped_materials();

/// What a person chooses a shipped material by.
struct ShippedMaterial {
  std::string name;                ///< as presets name it: "gold", "N-BK7"
  bool metal = false;              ///< it lets no light through: material for a conductor
  std::optional<double> n_d, abbe; ///< where the data has them
};
/// All that can be read, by name. Reads every file, which takes a while: no frame of a window waits for it.
std::vector<ShippedMaterial> read_shipped_materials();

/// The dispersion that a person names: a file, else a shipped material. Throws bad_input naming the folders searched.
optics::DispersionCurve load_dispersion(const std::string& name);

/// where (all three): the field's FILE#/json/pointer. They throw bad_input there with the reason that optics gives.
optics::DispersionCurve make_curve(const preset::Dispersion& dispersion, const FileFinder& finder,
                                   const Location& where);
/// Its part of 380..780 nm sums to 1 (optics/spectrum.h).
optics::Spectrum make_light_spectrum(const preset::LightSpectrum& spectrum, const Location& where,
                                     optics::SpectralRange range = optics::SpectralRange::visible);
/// Each value in 0..1.
optics::Spectrum make_reflectance(const preset::Reflectance& reflectance, const Location& where,
                                  optics::SpectralRange range = optics::SpectralRange::visible);

/// Whether the light has power, by its data, beyond 380..780 nm.
bool reaches_beyond(const preset::LightSpectrum& spectrum);

} // namespace nephroid::scatter
