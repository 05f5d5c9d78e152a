// SPDX-License-Identifier: Apache-2.0
// A lens as one closed solid in millimetres: a smooth surface in triangles, sides, and the flat front at z = thickness.
#pragma once
#include "inverse/facets/solid.h"

#include <algorithm>

namespace nephroid::inverse {

/// The layout whose facets the mesh is made of: long facets are cut into nearly square ones.
Layout mesh_layout(Layout layout);

/// How many parts each of mesh_layout()'s facets has along a side, a power of two up to 64. With so many, flat
/// triangles send light at most mesh_error cells from where the surface sends it, in the mean of squares over the
/// light, which counts as it is seen: as its place is bright, but less where light is gathered. A triangle is as steep
/// as the surface half a part's side away from its corners at most. The mesh has the fewest triangles with parts in
/// proportion to the square root of what a whole facet would miss by, and to the fourth root of the brightness.
std::vector<int> mesh_parts(const Layout& layout, const Surface& surface, double mesh_error);

/// So far astray, triangles leave an even grey even: with facets of a cell and of half a cell, beside a disc of twice
/// the grey, the judge's cells differ by 1.3 % (rays' noise: .6 %).
inline constexpr double even_mesh_error = 0.025;

/// The error for a picture that comes so close to what is wanted, in rel_l2, where none is set. Triangles add a third
/// of their cells astray to rel_l2, measured; more of them than this gain nothing where the picture itself is worse.
inline double default_mesh_error(double rel_l2) { return std::max(even_mesh_error, rel_l2); }

std::uint64_t count_triangles(const Layout& layout, const std::vector<int>& parts);

inline std::uint64_t stl_bytes(std::uint64_t triangles) { return 84 + 50 * triangles; }
inline constexpr std::uint64_t most_stl_bytes = 4'000'000'000;
/// Throws bad_input for so many triangles. `own` is where the settings stand.
[[noreturn]] void refuse_mesh(const Location& own, double mesh_error, std::uint64_t triangles);

/// Each part becomes triangles about its middle, with its neighbours' corners on its sides; all are on the surface.
Solid make_smooth_solid(const Layout& layout, const Surface& surface, const std::vector<int>& parts);

/// Cuts a relief over the whole rectangle, which is all that `solid` has, along the ellipse within it, and closes it by
/// its side and front (outline.cpp). Triangles with no corner within the ellipse are left out, the others cut. Corners
/// close to the ellipse are moved onto it first, so that no triangle becomes much thinner than it was.
void cut_round(const Layout& layout, const Surface& surface, Solid& solid);

} // namespace nephroid::inverse
