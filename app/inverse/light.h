// SPDX-License-Identifier: Apache-2.0
// Light on its way to the facets: through the flat front, straight on, tilted or from a lamp.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// Of a layout whose light is not known yet. Throws bad_input, naming the tilt or distance that would do, for light
/// from behind the front, and where facets would stand in each other's light; also where no light that enters through
/// the front reaches a facet.
Illumination make_illumination(Layout layout, const Light& light, const Place& where);

/// Illumination::facets, where sines and lamp are known. No value of `power` is above 0 where no light reaches any
/// facet.
std::optional<std::vector<Incoming>> light_on_facets(const Layout& layout);

/// At a facet's middle. power: over light that falls straight on or, of a lamp, in units of its intensity over a square
/// millimetre.
Incoming incoming_at(const Layout& layout, const glm::dvec2& middle);

/// How much of a rectangle lies within the object's outline.
double part_within(const Layout& layout, const glm::dvec2& middle, const glm::dvec2& size);

/// Light that falls on a place of the front; weight: over its mean.
struct LightRay {
  glm::dvec3 direction{0, 0, -1};
  double weight = 1;
};
LightRay light_ray(const Layout& layout, const glm::dvec3& front);
/// Of a lamp: that weight over the solid angle of a square millimetre of the front there.
double lamp_weight(const Layout& layout);

} // namespace nephroid::inverse
