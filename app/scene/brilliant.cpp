// SPDX-License-Identifier: Apache-2.0
// The round brilliant cut with 57 facets: table, 8 stars, 8 bezels, 16 upper girdle, 16 lower girdle, 8 pavilion mains; pointed
// culet. The two angles and the table are Tolkowsky's (Diamond Design, 1919); star and lower-girdle lengths are common today
// (Gemological Institute of America, "Estimating a round brilliant's cut grade"). The girdle is a prism of 16 flat sides, so
// that the upper and lower girdle facets end in straight edges.
#include "scene/shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::scene {
namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr double crown_angle = 34.5 * radians;
constexpr double pavilion_angle = 40.75 * radians;
constexpr double table = 0.53;         ///< corner to opposite corner, over the girdle's diameter
constexpr double star = 0.5;           ///< horizontal length over the way from table edge to girdle
constexpr double lower_girdle = 0.8;   ///< horizontal length over the way from girdle to axis
constexpr double girdle_height = 0.06; ///< over the radius: 3 % of the diameter

/// A point at `step` times 22.5 degrees around the axis; the same bits again after a whole turn.
glm::dvec3 around(int step, double radius, double y)
{
  const double angle = (step + 16) % 16 * 22.5 * radians;
  return {radius * std::cos(angle), y, -radius * std::sin(angle)};
}

/// Height over the girdle at `radius` and 22.5 degrees beside the middle of a facet that starts at radius 1 with `slope`:
/// where the facet meets its neighbour, which lies 45 degrees on.
double height_between(double radius, double slope) { return (1 - radius * std::cos(22.5 * radians)) * std::tan(slope); }

} // namespace

Mesh make_brilliant()
{
  // Heights over the girdle's middle. The bezel (kite) facet rises from a girdle corner to a table corner; two neighbours meet in
  // a line on which the star's tip lies. The pavilion mains fall from the girdle's corners to the culet in the same way.
  const double top = girdle_height / 2, bottom = -girdle_height / 2;
  const double table_y = top + (1 - table) * std::tan(crown_angle);
  const double culet_y = bottom - std::tan(pavilion_angle);
  const double table_edge = table * std::cos(22.5 * radians);
  const double star_radius = table_edge + star * (1 - table_edge);
  const double star_y = top + height_between(star_radius, crown_angle);
  const double half_radius = 1 - lower_girdle;
  const double half_y = bottom - height_between(half_radius, pavilion_angle);
  const double centre_y = (table_y + culet_y) / 2;

  const auto corner = [&](int step) { return around(step, table, table_y - centre_y); };
  const auto star_tip = [&](int step) { return around(step, star_radius, star_y - centre_y); };
  const auto upper = [&](int step) { return around(step, 1, top - centre_y); };
  const auto lower = [&](int step) { return around(step, 1, bottom - centre_y); };
  const auto half_tip = [&](int step) { return around(step, half_radius, half_y - centre_y); };
  const glm::dvec3 culet{0, culet_y - centre_y, 0};

  Mesh mesh;
  using Triangle = std::array<glm::dvec3, 3>;
  using Kite = std::array<glm::dvec3, 4>;
  std::array<glm::dvec3, 8> octagon;
  for (int i = 0; i < 8; ++i) octagon[i] = corner(2 * i);
  add_facet(mesh, octagon);
  for (int step = 0; step < 16; step += 2) {
    add_facet(mesh, Triangle{corner(step), star_tip(step + 1), corner(step + 2)});
    add_facet(mesh, Kite{corner(step), star_tip(step - 1), upper(step), star_tip(step + 1)});
    add_facet(mesh, Triangle{star_tip(step + 1), upper(step), upper(step + 1)});
    add_facet(mesh, Triangle{star_tip(step + 1), upper(step + 1), upper(step + 2)});
    add_facet(mesh, Kite{culet, half_tip(step + 1), lower(step), half_tip(step - 1)});
    add_facet(mesh, Triangle{half_tip(step + 1), lower(step + 1), lower(step)});
    add_facet(mesh, Triangle{half_tip(step + 1), lower(step + 2), lower(step + 1)});
  }
  for (int step = 0; step < 16; ++step) add_facet(mesh, Kite{upper(step), lower(step), lower(step + 1), upper(step + 1)});
  return mesh;
}

} // namespace nephroid::scene
