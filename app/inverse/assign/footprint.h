// SPDX-License-Identifier: Apache-2.0
// Where the light of one facet falls on a receiver: its true footprint, as parts of cells.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// A beam along one axis, in cells: a box `width` wide that another one smears, `blur` wide: a trapezoid of area 1.
struct Beam {
  double middle = 0, width = 1, blur = 0;
};

/// The part of a beam that is left of t.
double part_before(const Beam& beam, double t);

/// The width in millimetres, on a receiver, of a box with the variance of the sun's disc and rough surfaces behind a
/// flat facet. A disc of radius r has r^2 / 4 along an axis, a box of width b has b^2 / 12.
double blur_width(const Layout& layout, std::size_t receiver);

/// In cells: how long the pieces of a spectrum's line of light may be; how wide a box with a disc's variance.
inline constexpr double piece_in_cells = 0.25, wide_in_cells = 0.5;

/// The largest index minus the least, without the thousandth of what counts at either end of the spectrum.
double index_spread(const Layout& layout);

/// The spectrum's indices in `count` ranges of equal width. `over` is a range's mean index minus layout.n, `parts` its
/// part of what counts, `within` the variance that is left in the ranges. Light beyond an end is counted there.
struct IndexGroups {
  std::vector<double> over, parts;
  double within = 0;
};
IndexGroups index_groups(const Layout& layout, int count);

/// A facet's light on a receiver, in cells: `count` beams of one shape, each with its shift from x.middle and y.middle
/// and its part of the light. A cell gets a beam's part along x times its part along y.
struct Beams {
  static constexpr int most = 16;
  Beam x, y;
  int count = 1;
  std::array<glm::dvec2, most> shifts{};
  std::array<double, most> parts{1};
};

/// The beams of a facet that sends the light of all with this slope; `height` is z of its middle. From the point p of a
/// facet with gradient g, light starts at z = g . p and meets a plane at (1 + slope g^T) p from where the middle's
/// does: a parallelogram. Its projections on x and y are exact; how they depend on each other is not kept. A lamp's
/// light has another slope at each p. A spectrum is a line along the change of the slope with the index: as many beams
/// as make its pieces short, 16 at most. A lamp of some size, or else the sun's disc and roughness, are 8 beams where
/// they are wide, or 4 for each of up to 4 pieces of a spectrum. What is left of a blur, and roughness beside a lamp,
/// is a box along each axis with its variance.
Beams beams_of(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver,
               double height = 0);

/// A facet's light in a receiver's cells: column x0 + i, row y0 + k get cells[k * columns + i] of it.
struct Footprint {
  int x0 = 0, y0 = 0, columns = 0, rows = 0;
  std::vector<double> cells;
};
Footprint footprint(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver,
                    double height = 0);

/// How much light a facet sends, over what the mean facet would send lying flat. A facet of gradient g meets 1 + t . g
/// of light with slope t. Along each axis its edge towards the light is g / 2 below its middle, in parts of its width,
/// and a neighbour of gradient h (Incoming::around) ends h / 2 above its own: so t (g + h) / 2 / (1 + t . g) of the
/// facet lies in shadow, more or less of it along the edge, as g and h differ there. In the same way a wall stops light
/// that leaves with slope s within s (g + h) / 2 / (1 + s . g) of the other edge. Neighbours do not count for light
/// straight on, nor for facets of free heights, whose edges nearly meet.
double facet_power(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver = 0);

/// Calls f(cell, part of the facet's light) for every cell of a footprint.
template <class F>
void for_cells(const Layout& layout, const Footprint& print, const F& f) {
  for (int k = 0; k < print.rows; ++k)
    for (int i = 0; i < print.columns; ++i)
      f(index_at(print.x0 + i, print.y0 + k, layout.cells.x), print.cells[index_at(i, k, print.columns)]);
}

/// The light of all facets with these slopes and heights: [receiver][cell], in units of facets that send all of theirs.
std::vector<std::vector<double>> light_of_all(const Layout& layout, const std::vector<glm::dvec2>& slopes,
                                              const std::vector<double>& heights);

/// The light that all facets send, wherever it goes, in the unit of facet_power().
double light_sent(const Layout& layout, const std::vector<glm::dvec2>& slopes, std::size_t receiver = 0);
/// The same in the light of each receiver.
std::vector<double> light_sent_to_each(const Layout& layout, const std::vector<glm::dvec2>& slopes);

} // namespace nephroid::inverse
