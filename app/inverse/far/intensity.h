// SPDX-License-Identifier: Apache-2.0
// A wanted intensity as light on a receiver so far away that only directions count. Cells there are even in the
// tangents of the angles, and get the intensity times the solid angle under which the object sees them.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// The distance in parts of the object's longer side: its size is a two-hundredth of a degree there.
inline constexpr double far_away = 1e4;

/// Of a lamp that does not say how many it has.
inline constexpr double default_lumens = 1000;

/// The tangents of half the width and height of all directions that are looked at: the target with a rim about it.
/// Throws bad_input for a luminaire's file that load_photometry() refuses, and for one that shines wider than 80
/// degrees.
glm::dvec2 far_half(const preset::Preset& preset);

/// The light of each cell. `notes` is as of make_target(). Throws bad_input as that and far_half(), and where the
/// lamp's lumens do not suffice for the candela that are wanted.
Target far_target(const preset::Preset& preset, const Layout& layout, std::vector<std::string>& notes);

/// The largest intensity that is wanted, in candela; empty: as large as the lamp makes it.
std::optional<double> wanted_candela(const preset::Preset& preset, const Layout& layout);

/// The part of the lamp's light that falls on the front: of a point, or a mesh, as if it shone evenly to all sides; of
/// an area as if it shone by Lambert's law to the front's side; 1 of parallel light.
double part_on_front(const Layout& layout, const Settings& settings);

/// The lamp's lumens that fall on the front: by default, of 1000.
double lumens_on_front(const Layout& layout, const Settings& settings);

/// The solid angle of a cell as the object sees it.
double steradians(const Layout& layout, std::size_t cell);

/// Sentences on a lamp whose size no edge of the target can be sharper than, and on light that is not needed.
std::vector<std::string> far_notes(const preset::Preset& preset, const Layout& layout);

} // namespace nephroid::inverse
