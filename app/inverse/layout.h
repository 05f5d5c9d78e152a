// SPDX-License-Identifier: Apache-2.0
// What stands where, in millimetres: facets about z = 0, light through the flat front at z = thickness, receivers at z
// = -distance, with their middles on the z axis but for an offset. y is up, and row 0 at the top, as seen along the
// light. A mirror has a flat back at z = thickness, and its light, which comes from below, is folded at z = 0: a lamp
// that is written down at z stands at -z (bending.h).
#pragma once
#include "base/error.h"
#include "inverse/settings.h"
#include "inverse/spectrum.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <limits>
#include <span>

namespace nephroid::inverse {

/// The light that falls on a facet's middle through the flat front.
struct Incoming {
  glm::dvec2 sines{0};  ///< x and y of its unit direction before the front: see bending.h
  glm::dvec2 around{0}; ///< its gradient as neighbours see it; at first, one that lights the last receiver's middle
  double power = 1;     ///< the power on the facet as if it lay flat, over the mean of all facets
  glm::dmat2 spread{0}; ///< change of the sines over x and y: a lamp's light has another direction at each place
};

/// Points that stand for light with a width: the middles of equal parts of it, and the covariance that is left in a
/// part, on average. Those of a lamp are in millimetres from its middle, those of a disc have a covariance of 1.
struct LightPoints {
  static constexpr std::size_t most = 8, few = 4; ///< for light with one wavelength, and with many
  std::vector<glm::dvec3> at;
  glm::dmat3 left{0};
};

/// Where the light comes from, and how much of it falls on the facets.
struct Illumination {
  glm::dvec2 sines{0};                 ///< parallel light: x and y of its unit direction before the front
  std::optional<glm::dvec3> lamp;      ///< a point light's place, or the middle of one of some size
  std::vector<glm::dvec4> lamp_places; ///< Lamp::places; empty: a point, or parallel light
  glm::dmat3 lamp_covariance{0};       ///< of its places, in mm^2: points_of_places
  LightPoints points{}, few_points{};  ///< of the lamp's places
  double sun_radius = 0;               ///< of the sun, where the settings do not say it: Layout::sun_radius
  /// The light on each facet. None: parallel light falls straight on a rectangle and is the same on all facets.
  std::optional<std::vector<Incoming>> facets;
};

/// The index of a column and row in values row by row.
inline std::size_t index_at(int column, int row, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

struct Layout {
  glm::dvec2 size{100, 100}; ///< the object's width and height
  bool round = false;        ///< whether the object is the ellipse within this size
  double thickness = 10;
  glm::ivec2 facets{128, 128};
  double n = 1.5;                   ///< Refraction::n; mirror_index: a mirror
  std::optional<Spectrum> spectrum; ///< Refraction::spectrum
  glm::dvec2 receiver{100, 100};    ///< size of every receiver
  glm::ivec2 cells{64, 64};         ///< cells of a receiver, across and down
  std::vector<double> distances;    ///< ascending
  bool far = false;                 ///< whether the one receiver is so far away that directions alone count
  std::vector<double> frames;       ///< distances of further screens, which only the judge looks at; ascending
  std::optional<std::vector<double>> weights;     ///< weight of each receiver's picture; none: they count alike
  std::optional<std::vector<glm::dvec2>> offsets; ///< each receiver's middle from the z axis; none: all are on it
  double sun_radius = 0;                          ///< of every light: tangent of half its disc's angular diameter
  double scatter = 0;                             ///< standard deviation of a slope, along x and along y
  double wavelength = 0;                          ///< in mm: the mean
  bool diffracts = false;                         ///< whether facets spread light as slits do
  Illumination light;

  bool free_heights = false;                                 ///< whether facets move along z; else they stand at z = 0
  double band = std::numeric_limits<double>::infinity();     ///< the furthest that a facet's corner may be from z = 0
  double steepest = std::numeric_limits<double>::infinity(); ///< the largest gradient that a facet may have

  double draft = 0;     ///< tangent of the least angle between a wall and the light straight on
  double smoothing = 0; ///< thesis (6.1): alpha_N over alpha_P

  /// Lights that receivers have of their own. A facet's slope is always that of `light` behind it.
  std::vector<Illumination> own_lights{};
  std::vector<std::size_t>
      light_of{}; ///< for each receiver: 0 is `light`, k own_lights[k - 1]; empty: all have `light`

  std::size_t light_index(std::size_t receiver_index) const { return light_of.empty() ? 0 : light_of[receiver_index]; }
  const Illumination& numbered(std::size_t index) const { return index == 0 ? light : own_lights[index - 1]; }
  Illumination& numbered(std::size_t index) { return index == 0 ? light : own_lights[index - 1]; }
  const Illumination& light_on(std::size_t receiver_index) const { return numbered(light_index(receiver_index)); }

  bool is_mirror() const { return n < 0; }
  /// z of where light comes in: the front, or z = 0 of a mirror.
  double entry() const { return is_mirror() ? 0 : thickness; }
  /// Whether p is outside a round object's outline.
  bool is_beside(const glm::dvec2& p) const { return round && glm::length(p / size) > 0.5; }
  /// Whether light has a width, or many wavelengths.
  bool blurs() const {
    return disc(light) > 0 || scatter > 0 || spectrum || has_area() || wave_width() != glm::dvec2(0) ||
           std::ranges::any_of(own_lights, [this](const Illumination& l) { return disc(l) > 0; });
  }
  /// Tangent of half the angular diameter of a light's disc.
  double disc(const Illumination& of) const { return std::max(sun_radius, of.sun_radius); }
  bool has_area() const {
    return !light.lamp_places.empty() ||
           std::ranges::any_of(own_lights, [](const Illumination& l) { return !l.lamp_places.empty(); });
  }
  /// How far a facet spreads light, across and down, in direction cosines: wavelength over the facet's width, where a
  /// slit's light first is 0 (Hecht 2017, Optics, 10.2.1).
  glm::dvec2 diffraction() const { return wavelength / facet(); }
  /// The width of the box that stands for it in footprints; 0 where no receiver shows it.
  glm::dvec2 wave_width() const;
  /// Whether light counts as luminance, else as energy.
  bool coloured() const { return spectrum && spectrum->coloured; }
  std::span<const LightPart> parts() const { return spectrum ? spectrum->parts : std::span<const LightPart>(); }
  /// The light on each facet; empty where all get the same.
  std::span<const Incoming> incoming() const { return light.facets ? *light.facets : std::span<const Incoming>(); }
  glm::dvec2 facet() const { return size / glm::dvec2(facets); }
  glm::dvec2 cell() const { return receiver / glm::dvec2(cells); }
  /// A receiver far away is drawn smaller by this, about as large as the object.
  double shrink() const { return far ? std::max(size.x, size.y) / std::max(receiver.x, receiver.y) : 1; }
  std::size_t facet_count() const { return static_cast<std::size_t>(facets.x) * static_cast<std::size_t>(facets.y); }
  std::size_t cell_count() const { return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y); }
  /// The point at so many facets across and down from the top left.
  glm::dvec2 corner(double column, double row) const {
    return {column * facet().x - size.x / 2, size.y / 2 - row * facet().y};
  }
  /// The middle of facet i, row by row from the top.
  glm::dvec2 middle(std::size_t i) const { return middle_of(i, facets, size); }
  glm::dvec2 middle_of_cell(std::size_t i) const { return middle_of(i, cells, receiver); }
  /// The middle of part i of a centred rectangle that has so many parts across and down.
  static glm::dvec2 middle_of(std::size_t i, const glm::ivec2& parts, const glm::dvec2& whole) {
    const auto columns = static_cast<std::size_t>(parts.x);
    const glm::dvec2 at = glm::dvec2(i % columns, i / columns) + 0.5, part = whole / glm::dvec2(parts);
    return {at.x * part.x - whole.x / 2, whole.y / 2 - at.y * part.y};
  }
  glm::dvec2 sines_on(std::size_t facet) const { return light.facets ? (*light.facets)[facet].sines : glm::dvec2(0); }
  /// Half the size of the rectangle about the z axis that holds the object and all receivers.
  glm::dvec2 half_room() const {
    glm::dvec2 half = glm::max(size, receiver) / 2.0;
    for (std::size_t j = 0; offsets && j < offsets->size(); ++j)
      half = glm::max(half, glm::abs(offset(j)) + receiver / 2.0);
    return half;
  }
  glm::dvec2 offset(std::size_t receiver_index) const { return offsets ? (*offsets)[receiver_index] : glm::dvec2(0); }
  /// Converts a point of a receiver, given from its middle, to cells from the receiver's top left corner.
  glm::dvec2 in_cells(const glm::dvec2& p) const {
    return {(p.x + receiver.x / 2) / cell().x, (receiver.y / 2 - p.y) / cell().y};
  }
  /// The cell at a point of a receiver, given from its middle; empty outside the receiver.
  std::optional<std::size_t> cell_at(const glm::dvec2& p) const {
    const glm::dvec2 at = in_cells(p);
    if (!(at.x >= 0 && at.y >= 0 && at.x < cells.x && at.y < cells.y)) return std::nullopt;
    return index_at(static_cast<int>(at.x), static_cast<int>(at.y), cells.x);
  }
};

/// The solid joins heights closer than this part of a facet's shorter side; so it turns a facet by as much at most.
inline constexpr double corners_join = 1e-4;

/// A receiver's wanted light: a value for each cell, row 0 at the top; the values sum to 1.
using Target = std::vector<double>;

/// Throws bad_input where the index cannot be read or is 1, where a constraint or the light leaves no picture, where
/// facets would reach the front or the nearest receiver, and where the solid cannot aim at the farthest one's cells.
///
/// With stock_mm the thickness is one of which the facets' relief is sure to fit into the sheet, until the relief is
/// known and gives it: `thickness`.
Layout make_layout(const preset::Preset& preset, std::optional<double> thickness = {});

/// A lattice of facets that stand for all: every facet, up to `a_side` of them a side.
std::vector<std::size_t> some_facets(const Layout& layout, int a_side);

/// The largest slope that facets give the light: what the index allows, or less where their steepness is limited.
double usable_slope(const Layout& layout);

/// Throws bad_input where no facet can bend light far enough to reach a lit cell.
void check_reach(const Layout& layout, const std::vector<Target>& targets, const preset::Preset& preset);

} // namespace nephroid::inverse
