// SPDX-License-Identifier: Apache-2.0
// Light on its way through the flat front to the facets: parallel, straight on or tilted, or of a lamp.
#pragma once
#include "base/error.h"
#include "inverse/layout.h"
#include "inverse/settings.h"

namespace nephroid::inverse {

/// Fills sines, lamp and incoming. Parallel light straight on needs no table of facets. Throws bad_input, naming the tilt or distance that
/// would do, for light from behind the front, and where facets would stand in each other's light; also where no light that enters through
/// the front reaches a facet.
void set_light(Layout& layout, const Light& light, const Place& where);

/// At a facet's middle. power: over light that falls straight on or, of a lamp, in units of its intensity over a square millimetre.
Incoming incoming_at(const Layout& layout, const glm::dvec2& middle);

/// Light that falls on a place of the front; weight: over its mean.
struct LightRay {
  glm::dvec3 direction{0, 0, -1};
  double weight = 1;
};
LightRay light_ray(const Layout& layout, const glm::dvec3& front);

} // namespace nephroid::inverse
