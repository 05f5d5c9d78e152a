// SPDX-License-Identifier: Apache-2.0
// Files say of a dielectric's surface what is on either side of it; a preset says what its inside is. Here the one
// becomes the other.
#pragma once
#include "formats/import/description.h"

#include <cmath>

namespace nephroid::formats {

/// Makes the materials of the description's dielectrics. Where one lies in another, its index is its own, and its
/// priority is higher. A lone one that the file has in another medium gets the ratio of both. Thin ones become sheets
/// of a thickness. Notes say what was done.
void settle_dielectrics(Description& description);

/// Open surfaces between media become bodies, where one of them parts two that are no air. settle_dielectrics() does
/// this first.
void join_interfaces(Description& description);

/// Whether both are the same medium for a file's rounded numbers.
inline bool alike(double n, double m) { return std::abs(n - m) < 1e-3 * m; }
using Place = std::array<float, 3>;
inline Place place_of(const glm::vec3& p) { return {p.x, p.y, p.z}; }
/// How far a body reaches into another that it touches, over its size: so no path sees air between them.
inline constexpr double reach = 2e-4;
/// Moves the vertices that are at one of these places outwards, or all.
void reach_out(scene::Mesh& body, const std::set<Place>* places = nullptr);

/// At 587.6 nm.
double middle_index(const preset::Dispersion& dispersion);

/// A dispersion file in the form of refractiveindex.info, with the n of `clear` and the k of this absorption a metre.
std::string absorbing_glass_file(const preset::Dispersion& clear, const optics::Spectrum& absorption,
                                 const std::string& comments);

/// A conductor with these n and k, held where they are 0 at the ends. A file of the import, named like the material,
/// has every tenth. Nothing where n is 0 between, or where they are none that a run takes.
std::optional<preset::Material> metal_of(Description& description, const std::string& name,
                                         const optics::Spectrum& file_n, const optics::Spectrum& file_k);
/// A conductor by a dispersion file or a shipped metal.
preset::Material metal_of(const std::string& file);
/// The mirror that a conductor of metal_of is head on, times `factor`; its reflectance is the same at all angles. A
/// file of the import that the conductor was made by is taken back.
preset::Material mirror_of(Description& description, const preset::Material& conductor, const DescribedColour& factor);
/// The shipped metal of that chemical formula: Au, Ag, Cu, Al, CuZn.
std::optional<preset::Material> metal_of_element(std::string_view element);

} // namespace nephroid::formats
