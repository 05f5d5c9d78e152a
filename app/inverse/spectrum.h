// SPDX-License-Identifier: Apache-2.0
// The light's wavelengths, as what the object makes of them: an index each, and a colour.
#pragma once
#include "preset/preset.h"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace nephroid::inverse {

/// A piece of the light's spectrum. What counts for pictures is xyz.y: over all pieces it sums to 1.
struct LightPart {
  double n = 1.5;    ///< index of the object over that of what is around it
  glm::dvec3 xyz{1}; ///< CIE 1931; of light without colours three times the same
};

struct Spectrum {
  std::vector<LightPart> parts; ///< by wavelength; one at least
  bool coloured = false;        ///< what counts is luminance, else energy
};

/// What the object's material does to the light.
struct Refraction {
  double n = 1.5; ///< index of the object over that of what is around it: the mean over what counts of the light
  std::optional<Spectrum> spectrum; ///< none: one index and no colours
};

/// Throws bad_input where the index cannot be read, is 1 or is not known for all of the light, and for a spectrum
/// without power.
Refraction make_refraction(const preset::Preset& preset);

/// The spectrum, which is not empty, in so many parts with as much of x + y + z, so that what is violet has its share:
/// neighbours, whose index is the mean of theirs.
std::vector<LightPart> equal_parts(const std::vector<LightPart>& spectrum, std::size_t count);

} // namespace nephroid::inverse
