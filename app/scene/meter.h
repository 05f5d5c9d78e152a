// SPDX-License-Identifier: Apache-2.0
// Where a meter of the preset measures: cells on an object's surface, or in the air. Light takes no notice of them: the
// pieces of the cells are in the scene's tables and not in its tree. In the scene's coordinates.
#pragma once
#include "base/location.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace nephroid::scene {

/// A flat grid. A surface that is not flat has up to six, along the axes; each of its triangles is in the one that it
/// faces most.
struct MeterChart {
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}; ///< unit; right x up looks to the side that is measured
  double left = 0, top = 0;               ///< of the grid, along right and up
  double height = 0;                      ///< of a plane in the air, along right x up
  double cell_width = 1, cell_height = 1;
  int columns = 1, rows = 1;
  std::size_t first = 0; ///< its first place in MeterSurface::cells
  glm::dvec3 normal() const { return glm::cross(right, up); }
  std::size_t place(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  std::size_t places() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

struct MeterSurface {
  std::string name;
  int object = -1;        ///< whose surface it is; -1: none's, it is in the air
  bool is_flat = true;    ///< in one plane, with one chart
  double rounding = 4e-6; ///< of what it measures: single precision, and the facets that stand for an ellipsoid
  int white = 0;          ///< the object that its pieces are of, which has no other surface
  glm::dvec3 low{-1e30}, high{1e30}; ///< of an object only what is in this box,
  glm::dvec3 facing{0};              ///< and faces this way, unit or 0, by at least a cosine
  double least_cosine = -1;
  std::vector<MeterChart> charts;               ///< at least one
  std::vector<int> cells;                       ///< of each place of the charts' grids, rows from the top; -1: none
  std::vector<std::array<glm::vec3, 3>> pieces; ///< triangles, cell after cell, just above the surface
  std::vector<std::uint32_t> first_piece;       ///< [cell + 1]
  std::vector<float> chances;                   ///< [piece]: of it and those before it, in its cell; the last 1
  std::vector<double> areas;                    ///< [cell], square units
  std::vector<glm::dvec3> centres, normals;     ///< [cell]
  std::vector<double> steradians;               ///< [cell]: of a goniometer, whose cells are directions; else empty
  glm::dmat3 directions{1};                     ///< of a goniometer: to C = 0 and C = 90 degrees, and to gamma = 0
  glm::dvec3 middle{0};                         ///< of a goniometer: where directions are counted from
  std::size_t count() const { return areas.size(); }
  bool is_goniometer() const { return !steradians.empty(); }
  /// What means over cells are weighted with: square units, or steradians.
  const std::vector<double>& weights() const { return is_goniometer() ? steradians : areas; }
};

/// The direction of a goniometer's cell.
struct GammaC {
  double gamma_deg = 0, c_deg = 0; ///< 0..180, 0..360
};
GammaC direction_of(const MeterSurface& goniometer, std::size_t cell);
/// Between the values of the cells about a direction, linearly. values: [cell].
double at_direction(const MeterSurface& goniometer, const std::vector<double>& values, const GammaC& direction);

/// The most cells of a meter.
inline constexpr std::size_t most_meter_cells = std::size_t{1} << 18;

/// scene: loaded of the same preset. where: FILE#/scene/meters/INDEX. Throws bad_input there: no surface that faces
/// there or is in the box, too many cells, a place inside of glass, a plane that looks into the object that it lies on,
/// a goniometer where light comes from far away.
MeterSurface make_meter(const preset::Meter& meter, const Scene& scene, const Location& where);

/// The scene as the meter sees it: a camera with a pixel for each cell. A pixel's radiance is its cell's irradiance
/// over pi. Its colours are watts, what the eye makes of them (Y), and 0.
Scene meter_view(Scene scene, MeterSurface meter);

/// A rectangle in a plane.
struct Rectangle {
  glm::dvec3 centre{0};
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}; ///< unit
  double width = 0, height = 0;           ///< along right and up
};

/// The smallest one about a flat object along an edge of its first triangle: what is a rectangle has itself. normal:
/// right x up, one of the plane's two.
Rectangle rectangle_about(const Scene& scene, const Object& object, const Plane& plane, const glm::dvec3& normal);

} // namespace nephroid::scene
