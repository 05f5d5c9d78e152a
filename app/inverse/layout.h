// SPDX-License-Identifier: Apache-2.0
// What stands where, in millimetres: facets about z = 0, light through the flat front at z = thickness, receivers at
// z = -distance, all of them centred on the z axis, but for receivers with an offset. y is up, and row 0 of facets and cells is at the top:
// a person who looks along the light sees the pictures as they are.
#pragma once
#include "base/error.h"
#include "inverse/settings.h"
#include "inverse/spectrum.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <limits>

namespace nephroid::inverse {

/// Light that falls on a facet's middle through the flat front.
struct Incoming {
  glm::dvec2 sines{0};  ///< x and y of its unit direction before the front: see bending.h
  glm::dvec2 around{0}; ///< the facet's gradient as its neighbours see it; at first of one that lights the middle of the last receiver
  double power = 1;     ///< on the facet as if it lay flat, over the mean of all facets
  glm::dmat2 spread{0}; ///< of the sines over x and y: a lamp's light falls on each place of the facet from another side
};

/// Where column and row are among values that are kept row by row, `columns` of them a row.
inline std::size_t index_at(int column, int row, int columns)
{
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

struct Layout {
  glm::dvec2 size{100, 100}; ///< of the object
  bool round = false;        ///< it is the ellipse within this size
  double thickness = 10;
  glm::ivec2 facets{128, 128};
  double n = 1.5;                  ///< index of the object over that of what is around it: the mean over what counts of the light
  std::vector<LightPart> spectrum; ///< by wavelength; empty: one index and no colours
  bool coloured = false;           ///< what counts is luminance, else energy
  glm::dvec2 receiver{100, 100};   ///< size of every receiver
  glm::ivec2 cells{64, 64};        ///< of every receiver
  std::vector<double> distances;   ///< ascending
  std::vector<double> frames;      ///< distances of further screens, which the judge alone looks at; ascending
  std::vector<double> weights;     ///< of each receiver's picture; empty: they count alike
  std::vector<glm::dvec2> offsets; ///< of each receiver's middle beside the z axis; empty: all are centred on it
  double sun_radius = 0;           ///< of the sun's disc: tangent of its half angle
  double scatter = 0;              ///< standard deviation of a slope, along x and along y
  glm::dvec2 sines{0};             ///< of parallel light: x and y of its unit direction before the front
  std::optional<glm::dvec3> lamp;  ///< of a point light: its place
  std::vector<Incoming> incoming;  ///< of each facet; empty: straight on

  bool free_heights = false;                                 ///< else every facet's middle is at z = 0
  double band = std::numeric_limits<double>::infinity();     ///< no corner of a facet is further from z = 0
  double steepest = std::numeric_limits<double>::infinity(); ///< of a facet's gradient, at most

  double draft = 0;     ///< tangent of the least angle between a wall and the light straight on
  double smoothing = 0; ///< thesis (6.1): alpha_N over alpha_P

  /// Beside a round object's outline.
  bool is_beside(const glm::dvec2& p) const { return round && glm::length(p / size) > 0.5; }
  /// Light has a width, or many wavelengths.
  bool blurs() const { return sun_radius > 0 || scatter > 0 || !spectrum.empty(); }
  glm::dvec2 facet() const { return size / glm::dvec2(facets); }
  glm::dvec2 cell() const { return receiver / glm::dvec2(cells); }
  std::size_t facet_count() const { return static_cast<std::size_t>(facets.x) * static_cast<std::size_t>(facets.y); }
  std::size_t cell_count() const { return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y); }
  /// Middle of facet i, row by row from the top.
  glm::dvec2 middle(std::size_t i) const { return middle_of(i, facets, size); }
  glm::dvec2 middle_of_cell(std::size_t i) const { return middle_of(i, cells, receiver); }
  /// Of part i of a centred rectangle that has so many parts across and down.
  static glm::dvec2 middle_of(std::size_t i, const glm::ivec2& parts, const glm::dvec2& whole)
  {
    const auto columns = static_cast<std::size_t>(parts.x);
    const glm::dvec2 at = glm::dvec2(i % columns, i / columns) + 0.5, part = whole / glm::dvec2(parts);
    return {at.x * part.x - whole.x / 2, whole.y / 2 - at.y * part.y};
  }
  glm::dvec2 sines_on(std::size_t facet) const { return incoming.empty() ? glm::dvec2(0) : incoming[facet].sines; }
  /// Half of the rectangle about the z axis that the object and all receivers fill.
  glm::dvec2 half_room() const
  {
    glm::dvec2 half = glm::max(size, receiver) / 2.0;
    for (const glm::dvec2& offset : offsets) half = glm::max(half, glm::abs(offset) + receiver / 2.0);
    return half;
  }
  glm::dvec2 offset(std::size_t of) const { return offsets.empty() ? glm::dvec2(0) : offsets[of]; }
  /// Of a point of a receiver, from its middle, in cells from its top left corner.
  glm::dvec2 in_cells(const glm::dvec2& p) const { return {(p.x + receiver.x / 2) / cell().x, (receiver.y / 2 - p.y) / cell().y}; }
  /// Where a point of a receiver lies, given from its middle; empty: beside it.
  std::optional<std::size_t> cell_at(const glm::dvec2& p) const
  {
    const glm::dvec2 at = in_cells(p);
    if (!(at.x >= 0 && at.y >= 0 && at.x < cells.x && at.y < cells.y)) return std::nullopt;
    return index_at(static_cast<int>(at.x), static_cast<int>(at.y), cells.x);
  }
};

/// The solid makes heights equal that are closer than this part of a facet's shorter side. It turns a facet by that much at most.
inline constexpr double corners_join = 1e-4;

/// A receiver's wanted light: a value a cell, row 0 at the top, which sum to 1.
using Target = std::vector<double>;

/// Reads the index. Throws bad_input where that cannot be read or is 1, where a constraint or the light leaves no picture, where facets
/// would reach the front or the nearest receiver, and where the farthest is too far for the solid to aim at its cells.
Layout make_layout(const preset::Preset& preset);

/// Fills n, spectrum and coloured. Throws bad_input where the index cannot be read, is 1 or is not known for all of the light, and
/// for a spectrum without power.
void set_spectrum(Layout& layout, const preset::Preset& preset);

/// A lattice of facets that speaks for all: every one up to so many a side.
std::vector<std::size_t> some_facets(const Layout& layout, int a_side);

/// The largest slope that facets give the light: what their index lets them, or less where they may not be steeper.
double usable_slope(const Layout& layout);

/// Throws bad_input where no facet can bend light far enough to reach a lit cell.
void check_reach(const Layout& layout, const std::vector<Target>& targets, const preset::Preset& preset);

/// Fills sines, lamp and incoming. Parallel light straight on a rectangle needs no table of facets. Throws bad_input, naming the tilt or
/// distance that would do, for light from behind the front, and where facets would stand in each other's light; also where no light that
/// enters through the front reaches a facet.
void set_light(Layout& layout, const Light& light, const Place& where);

/// Fills incoming, the rest of the light being known. False: no light reaches any facet.
bool light_facets(Layout& layout);

/// At a facet's middle. power: over light that falls straight on or, of a lamp, in units of its intensity over a square millimetre.
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
