// SPDX-License-Identifier: Apache-2.0
// The light's wavelengths, as what the object makes of them: an index each, and a colour.
#pragma once
#include <glm/glm.hpp>

#include <vector>

namespace nephroid::inverse {

/// A piece of the light's spectrum. What counts for pictures is xyz.y: over all pieces it sums to 1.
struct LightPart {
  double n = 1.5;    ///< index of the object over that of what is around it
  glm::dvec3 xyz{1}; ///< CIE 1931; of light without colours three times the same
};

/// The spectrum, which is not empty, in so many parts with as much of x + y + z, so that what is violet has its share: neighbours, whose
/// index is the mean of theirs.
std::vector<LightPart> equal_parts(const std::vector<LightPart>& spectrum, std::size_t count);

} // namespace nephroid::inverse
