// SPDX-License-Identifier: Apache-2.0
// The light's wavelengths, as what the object makes of them: an index each, and a colour.
#pragma once
#include "preset/preset.h"

#include <glm/glm.hpp>

namespace nephroid::inverse {

inline constexpr double mm_a_nm = 1e-6;

/// A piece of the light's spectrum. What counts for pictures is xyz.y: over all pieces it sums to 1.
struct LightPart {
  double n = 1.5;    ///< index of the object over that of what is around it
  glm::dvec3 xyz{1}; ///< CIE 1931; for light without colours three equal values
  double nm = 550;   ///< wavelength
};

struct Spectrum {
  std::vector<LightPart> parts; ///< by wavelength; at least one
  bool coloured = false;        ///< whether luminance counts, else energy
};

struct Refraction {
  double n = 1.5;                   ///< the mean index over what counts of the light
  double nm = 550;                  ///< the mean wavelength
  std::optional<Spectrum> spectrum; ///< none: one index and no colours
};

/// Throws bad_input for an index that cannot be read, is 1 or not known everywhere, and for light without power.
Refraction make_refraction(const preset::Preset& preset);

/// Divides the spectrum, which is not empty, into parts of equal x + y + z. A part is of neighbours, with their mean
/// index.
std::vector<LightPart> equal_parts(const std::vector<LightPart>& spectrum, std::size_t count);

} // namespace nephroid::inverse
