// SPDX-License-Identifier: Apache-2.0
// A coat without colour over a matt base: plastic, varnish, glaze. Light comes to it from air, and what passes is
// scattered evenly by the base.
#pragma once
#include "optics/wavelength.h"

namespace nephroid::optics {

/// At how many cosines a coat is known.
inline constexpr std::size_t coat_cosines = 256;

struct Coat {
  std::array<double, coat_cosines> passes{}; ///< [i]: the part that passes at the cosine i / (coat_cosines - 1)
  double mean = 1;                           ///< of light from all sides
};

/// n: of the coat, 1 to 4. alpha: of GGX; 0: polished. What passes is the mean over the facets that a direction sees.
Coat make_coat(double n, double alpha);

/// What a surface with a coat shows of a base of this reflectance, 0..1. Between the base and the coat light goes back
/// and forth: r (1 - inner) / (1 - inner r), with the part 1 - inner = mean / n^2 of the base's light that passes.
double seen_below_coat(const Coat& coat, double n, double reflectance);

} // namespace nephroid::optics
