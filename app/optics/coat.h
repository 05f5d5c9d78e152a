// SPDX-License-Identifier: Apache-2.0
// A coat without colour over a matt base: plastic, varnish, glaze.
#pragma once
#include "optics/wavelength.h"

namespace nephroid::optics {

/// At how many cosines a coat is known.
inline constexpr std::size_t coat_cosines = 256;

/// What light does at a coat. It comes from air, and what passes is scattered evenly by the base.
struct Coat {
  std::array<double, coat_cosines> passes{}; ///< [i]: the part that passes at the cosine i / (coat_cosines - 1)
  double outer = 0; ///< the part of light from all sides of a matt world that the coat reflects
  double inner = 0; ///< the same of the base's light, from within: 1 - (1 - outer) / n^2
};

/// n: of the coat, 1 to 4. alpha: of GGX; 0: polished. What passes is the mean over the facets that a direction sees.
Coat make_coat(double n, double alpha);

/// What the base of a surface with a coat has to reflect, so that with the parts that pass on the way in and on the way
/// out it sends back what a base of this reflectance does, 0..1. Between base and coat light goes back and forth:
///   r (1 - inner) / ((1 - outer) (1 - inner r)) = r / (n^2 (1 - inner r)).
/// A base of 1 has 1 / (1 - outer), with which no light is lost.
Spectrum base_reflectance(const Coat& coat, const Spectrum& reflectance);

} // namespace nephroid::optics
