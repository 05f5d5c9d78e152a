// SPDX-License-Identifier: Apache-2.0
// The solid as files: meshes in millimetres, and for a workshop the figures, the facets as a list and a height map.
#pragma once
#include "image/image.h"
#include "inverse/facets/solid.h"

namespace nephroid::inverse {

inline constexpr const char* mesh_title = "Nephroid: inverse caustics, millimetres";

void write_obj(const scene::Mesh& mesh, ByteSink& to); ///< Wavefront
void write_stl(const scene::Mesh& mesh, ByteSink& to); ///< binary

/// 3MF (core specification 1.3), in millimetres: vertices are shared, so that it is as closed as the mesh.
void write_3mf(const scene::Mesh& mesh, ByteSink& to);
/// What a 3MF, a zip archive whose parts are below 4 GiB, is sure to hold.
inline constexpr std::uint64_t most_3mf_triangles = 30'000'000;

/// How the object is made, in millimetres; empty: not said.
struct Manufacturing {
  std::optional<double> tool_radius, layer;
};

/// The figures as a page of Markdown. `material` is in words, with its index.
std::string workshop_page(const Layout& layout, const Solid& solid, const std::string& material,
                          const Manufacturing& making = {});

/// JSON: the grid's size, what a facet's numbers are, and a line of them for each facet, row by row from the top.
void write_facets(const Layout& layout, const Solid& solid, ByteSink& to);

/// The object's thickness in millimetres, seen from the facets' side: +x is at the left, +y at the top. Pixels are
/// square, some 1024 across the object and at least 4 across a facet. It knows no draft, and says so.
image::Image height_map(const Layout& layout, const Solid& solid);
void write_height_exr(const Layout& layout, const Solid& solid, ByteSink& to); ///< 32 bits
void write_height_png(const Layout& layout, const Solid& solid, ByteSink& to); ///< 16 bits; 0: the deepest point

} // namespace nephroid::inverse
