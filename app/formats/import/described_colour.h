// SPDX-License-Identifier: Apache-2.0
// Colours as files have them, linear sRGB or spectra, and what becomes of them in a preset.
#pragma once
#include "base/location.h"
#include "formats/import/gltf_scene.h"
#include "optics/wavelength.h"
#include "preset/preset.h"

#include <glm/glm.hpp>

#include <optional>

namespace nephroid::formats {

struct Description;

struct DescribedColour {
  glm::dvec3 rgb{1}; ///< linear sRGB; not looked at where there is a spectrum
  std::optional<optics::Spectrum> spectrum;
  std::optional<preset::LightSpectrum> light; ///< a shorter form of the spectrum
  double luminance = 1;                       ///< of the spectrum: 1 is as bright as an rgb of 1 1 1

  bool is_black() const;
};
DescribedColour operator*(DescribedColour colour, double factor);

/// Rows of nm and value: linear between them, 0 outside, as Mitsuba and PBRT have it. unit: the luminance that counts
/// as 1. Throws bad_input at `where`: no rows, a negative value, a wavelength given twice.
DescribedColour spectrum_of_rows(std::vector<std::array<double, 2>> rows, double unit, const Location& where);
/// The rows of a file with two numbers a line, and comments after #. where: of what names it.
std::vector<std::array<double, 2>> rows_of_file(const std::filesystem::path& file, const Location& where);
/// Planck's law in W m^-2 sr^-1 nm^-1. Throws bad_input at `where` for a temperature that is not above 0.
DescribedColour blackbody_of(double temperature_k, double unit, const Location& where);
DescribedColour illuminant_of(const std::string& name, double unit);
DescribedColour even_spectrum(double value, double unit);

LightColour light_colour(const DescribedColour& colour);
/// At most 1.
preset::Reflectance reflectance_of(const DescribedColour& colour);
/// Turns a matt material into plastic. below: its reflectance is that of the base below the coat, and light that goes
/// back and forth between both makes it darker; false: it is what is seen, as a preset has it.
void make_plastic(preset::Material& matt, double n, double roughness, bool below);
/// (1 - weight) of one and `weight` of the other, where they differ in nothing but their reflectances; else the heavier
/// one, with a note.
preset::Material mixed(const preset::Material& one, const preset::Material& other, double weight, const Location& where,
                       Description& into);
/// At each wavelength; of rgb the smoothest spectrum, as of a reflectance.
optics::Spectrum values_of(const DescribedColour& colour);

glm::dvec3 linear_srgb_of(const DescribedColour& colour);

} // namespace nephroid::formats
