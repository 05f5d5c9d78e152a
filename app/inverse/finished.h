// SPDX-License-Identifier: Apache-2.0
// A finished object, made, measured or bought, judged without a new design: as a mesh or a height map, in the frame of
// a run's object.stl: millimetres, the flat side at the top (+z), the relief about z = 0 below it.
#pragma once
#include "image/image.h"
#include "inverse/assign/cost.h"
#include "inverse/facets/solid.h"

#include <stop_token>

namespace nephroid::inverse {

/// The solid of a closed mesh, with its own thickness. What stands steeper than 55 degrees is a wall, and at the
/// outline a side. Throws bad_input at `where` for holes, for another width or height than the layout's, and for a mesh
/// without a flat side at the top.
Solid solid_of_mesh(const Layout& layout, const scene::Mesh& mesh, const Location& where);

/// The solid below a map of its thickness in mm, as heights.exr has it: +x is at the left, +y at the top. The relief's
/// mean is at z = 0. Throws bad_input at `where` for pixels without a thickness.
Solid solid_of_heights(const Layout& layout, const image::Image& thickness, const Location& where);

/// Reads a mesh, or a picture of one channel as a height map. Throws as these two, load_mesh and read_image.
Solid read_finished(const Layout& layout, const std::filesystem::path& file);

/// z of the flat side.
double top_of(const Solid& solid);
/// Moves the flat side: the object becomes thicker or thinner.
void move_top(Solid& solid, double z);

/// How far a made surface sends light from where the design's does, by slopes alone.
struct Deviation {
  std::vector<double> off; ///< for each facet, row by row: the part of it that sends light more than a cell off
  double part_off = 0;     ///< the same of the whole surface
  double median_cells = 0; ///< half of the surface is closer
};
Deviation deviation(const Layout& layout, const Solid& design, const Solid& made, std::size_t receiver);

/// The layout with `steps` screens in place of each receiver, each in its light: from -part to +part of its distance.
Layout through_focus(const Layout& layout, double part, int steps);
/// Each target as often.
std::vector<Target> through_focus(const std::vector<Target>& targets, int steps);

} // namespace nephroid::inverse
