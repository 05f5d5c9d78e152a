// SPDX-License-Identifier: Apache-2.0
// Where the light of one facet falls on a receiver: its true footprint, as parts of cells.
#pragma once
#include "inverse/layout.h"

#include <array>

namespace nephroid::inverse {

/// A beam along one axis, in cells: a box of `width` that another box of `blur` smears; a trapezoid.
struct Beam {
  double middle = 0, width = 1, blur = 0;
};

/// The part of a beam before t.
double part_before(const Beam& beam, double t);

/// The width of a box that smears as the sun's disc and rough surfaces do behind a flat facet: it has their variance. A
/// disc of radius r has r^2 / 4 along an axis, a box of width b has b^2 / 12. In millimetres on a receiver at this
/// distance.
double blur_width(const Layout& layout, double distance);

/// A line of indices is cut until its pieces are this short, and a disc that is wider becomes points; in parts of a
/// cell.
inline constexpr double piece_in_cells = 0.25, wide_in_cells = 0.5;

/// The largest index minus the least, without a thousandth of what counts at either end of the spectrum.
double index_spread(const Layout& layout);

/// The line of indices in pieces of equal length. `over` is each piece's mean index minus layout.n, `parts` its part of
/// what counts, `within` the variance that is left in the pieces. Light beyond an end is counted there.
struct IndexGroups {
  std::vector<double> over, parts;
  double within = 0;
};
IndexGroups index_groups(const Layout& layout, int count);

/// Points on a circle that stand for a disc with a variance of 1 along each axis, disc_beams or 4 of them. Some of the
/// variance is left for a box about each point. With such boxes 8 points are close to a disc also between the axes.
/// Where its radius is 0.5 to 1.2 cells, 0.002 to 0.02 of the disc falls elsewhere; with a box alone it is 0.01 to 0.1.
inline constexpr int disc_beams = 8;
std::vector<glm::dvec2> disc_points(int count);
constexpr double left_of_disc(int points) { return points == disc_beams ? 0.22 : 0.27; }

/// A facet's light on its way to a receiver, in cells: beams that are alike, each with its shift from the middle and
/// its part of the light. A beam is a product: what lands in a cell is the part along x times the part along y.
struct Beams {
  static constexpr int most = 16;
  Beam x, y;
  int count = 1;
  std::array<glm::dvec2, most> shifts{};
  std::array<double, most> parts{1};
};

/// The beams of a facet with this slope. The light of a facet with gradient g starts at z = g . p and hits a plane at
/// (1 + slope g^T) p from its middle: a parallelogram, smaller along the slope than the facet. A lamp's light has
/// another slope at each p. The shadow along x and along y is exact; how both depend on each other off the axes is not
/// kept. A spectrum is a line along the change of the slope with the index; it has as many beams as make the rest of
/// each short beside a cell. The sun's disc and roughness, where they are wide beside a cell, are 8 beams, or 4 where
/// the light has a spectrum. What is left of a blur is a box along each axis with its variance. `height` is z of the
/// facet's middle: light goes further from there.
Beams beams_of(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver,
               double height = 0);

/// A facet's light in cells of a receiver: column x0 + i, row y0 + k get cells[k * columns + i]. Cells beside the
/// receiver are left out.
struct Footprint {
  int x0 = 0, y0 = 0, columns = 0, rows = 0;
  std::vector<double> cells;
};
Footprint footprint(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver,
                    double height = 0);

/// How much light a facet sends, over what the mean facet would send lying flat. A facet of gradient g meets 1 + t . g
/// of light with slope t. Its edge towards the light is g / 2 below its middle, in parts of its width; a neighbour of
/// gradient h ends h / 2 above its own middle. So t (g + h) / 2 / (1 + t . g) of the facet lies in the neighbour's
/// shadow, along x and along y. This grows or falls towards the ends of the edge, as g and h differ along it. In the
/// same way a wall stops light that leaves with slope s within s (g + h) / 2 / (1 + s . g) of the other edge. The
/// footprint is of what is left. h is what the layout says of the neighbour (Incoming::around). Neighbours do not count
/// for light straight on, nor for facets of free heights, whose edges nearly meet.
double facet_power(const Layout& layout, std::size_t facet, const glm::dvec2& slope);

/// Calls f(cell, part of the facet's light) for every cell of the receiver that gets some.
template <class F>
void for_cells(const Layout& layout, const Footprint& print, const F& f) {
  for (int k = 0; k < print.rows; ++k)
    for (int i = 0; i < print.columns; ++i)
      f(index_at(print.x0 + i, print.y0 + k, layout.cells.x), print.cells[index_at(i, k, print.columns)]);
}

/// The light of all facets: [receiver][cell], in units of facets that send all of theirs. `heights` are those of their
/// middles.
std::vector<std::vector<double>> light_of_all(const Layout& layout, const std::vector<glm::dvec2>& slopes,
                                              const std::vector<double>& heights);

/// The light that all facets send, wherever it goes.
double light_sent(const Layout& layout, const std::vector<glm::dvec2>& slopes);

} // namespace nephroid::inverse
