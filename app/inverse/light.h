// SPDX-License-Identifier: Apache-2.0
// Light on its way to the facets: through the flat front, straight on, tilted or from a lamp.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// The illumination of a layout whose light is not known yet. Throws bad_input, naming a tilt or distance that works,
/// for light from behind the front, where facets would stand in each other's light, and where none reaches a facet.
Illumination make_illumination(Layout layout, const Light& light, const Location& where);

/// Illumination::facets, where sines and lamp are known. No `power` is above 0 where no light reaches any facet.
std::optional<std::vector<Incoming>> light_on_facets(const Layout& layout);

/// The light at a facet's middle. `power`: over that straight on, or in a lamp's intensity over a square millimetre.
Incoming incoming_at(const Layout& layout, const glm::dvec2& middle);

/// The facet about a point, or the nearest one.
std::size_t facet_at(const Layout& layout, const glm::dvec2& p);

/// The light on a point of a smooth surface, by the facet about it.
Incoming incoming_on(const Layout& layout, const glm::dvec2& p, double height);

/// The part of a rectangle that lies within the object's outline.
double part_within(const Layout& layout, const glm::dvec2& middle, const glm::dvec2& size);

/// Light that falls on a place of the front; `weight` is relative to the mean.
struct LightRay {
  glm::dvec3 direction{0, 0, -1};
  double weight = 1;
};
LightRay light_ray(const Layout& layout, const glm::dvec3& front);
/// A lamp's weight as in LightRay, over the solid angle of a square millimetre of the front.
double lamp_weight(const Layout& layout);

} // namespace nephroid::inverse
