// SPDX-License-Identifier: Apache-2.0
// Light on its way to the facets: through the flat front, straight on, tilted or from a lamp.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// The illumination of a layout whose light is not known yet. `settings` say where the front looks, for the sun.
/// Throws bad_input, naming a tilt or distance that works,
/// for light from behind the front, for meshes that mesh_lamp() refuses, where facets would stand in each other's
/// light, and where none reaches a facet.
Illumination make_illumination(Layout layout, const Light& light, const Location& where, const Settings& settings = {});

/// Adds each receiver's light, where it is not that of all. Throws as make_illumination.
void add_own_lights(Layout& layout, const Settings& settings, const Location& own);

/// Illumination::facets, where sines and lamp are known. No `power` is above 0 where no light reaches any facet.
std::optional<std::vector<Incoming>> light_on_facets(const Layout& layout);

/// The layout with one of its receivers alone, in its light, which is that of all there.
Layout receiver_alone(const Layout& layout, std::size_t receiver);

/// A facet's light on its way to a receiver, in the light that falls there.
struct LitFacet {
  Incoming in;
  glm::dvec2 slope{0}, gradient{0};
  bool goes = true; ///< false: it is reflected totally
};
LitFacet lit_facet(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver);

/// The slope in the light of all with which light goes to a receiver with this one, or the nearest one.
glm::dvec2 slope_towards(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver);

/// The light at a facet's middle. `power`: over that straight on, or in a lamp's intensity over a square millimetre.
Incoming incoming_at(const Layout& layout, const glm::dvec2& middle);

/// The facet about a point, or the nearest one.
std::size_t facet_at(const Layout& layout, const glm::dvec2& p);

/// The light on a point of a smooth surface, by the facet about it.
Incoming incoming_on(const Layout& layout, const glm::dvec2& p, double height);

/// The part of a rectangle that lies within the object's outline.
double part_within(const Layout& layout, const glm::dvec2& middle, const glm::dvec2& size);

/// The part of a mirror whose light a receiver stops, because it stands between them; 0 of glass.
double shaded_part(const Layout& layout, std::size_t receiver);

/// Light that falls on a place of the front; `weight` is relative to the mean.
struct LightRay {
  glm::dvec3 direction{0, 0, -1};
  double weight = 1;
};
LightRay light_ray(const Layout& layout, const glm::dvec3& front);
/// A lamp's weight as in LightRay, over the solid angle of a square millimetre of the front.
double lamp_weight(const Layout& layout);

} // namespace nephroid::inverse
