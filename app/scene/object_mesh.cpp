// SPDX-License-Identifier: Apache-2.0
#include "scene/object_mesh.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::scene {
namespace {

constexpr double min_extent = 1e-6; ///< smaller triangles have squared areas near the smallest floats

/// The scale is along the shape's axes, before the turn, so the half axes stay perpendicular. All of one length: a
/// sphere, whose axes may be any, so that a turn moves nothing.
Ellipsoid transformed(const Ellipsoid& ellipsoid, const Placement& placement, const glm::dvec3& offset) {
  Ellipsoid result = ellipsoid;
  result.centre = placement.linear * glm::dvec3(ellipsoid.centre) + offset;
  for (glm::vec3& axis : result.half_axes) axis = placement.linear * glm::dvec3(axis);
  const double longest = longest_half_axis(result);
  if (longest - shortest_half_axis(result) > 0x1p-20 * longest) return result;
  const auto radius =
      static_cast<float>(longest_half_axis(ellipsoid) * std::cbrt(std::abs(glm::determinant(placement.linear))));
  result.half_axes = {{{radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}};
  return result;
}

Mesh transformed(const Mesh& mesh, const Placement& placement, const glm::dvec3& origin) {
  const glm::dvec3 offset = placement.offset - origin;
  const glm::dmat3 normal_transform = glm::transpose(glm::inverse(placement.linear));
  Mesh result;
  result.positions.resize(mesh.positions.size());
  result.normals.resize(mesh.normals.size());
  for_ranges(mesh.positions.size(), 1 << 14, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      result.positions[i] = placement.linear * glm::dvec3(mesh.positions[i]) + offset;
      if (!mesh.normals.empty()) result.normals[i] = glm::normalize(normal_transform * glm::dvec3(mesh.normals[i]));
    }
  });
  result.triangles = mesh.triangles;
  result.texcoords = mesh.texcoords;
  result.mended_normals = mesh.mended_normals;
  for (const Ellipsoid& ellipsoid : mesh.ellipsoids)
    result.ellipsoids.push_back(transformed(ellipsoid, placement, offset));
  if (glm::determinant(placement.linear) < 0) turn_triangles(result);
  return result;
}

void check_extent(const Bounds& bounds, const glm::dvec3& origin, const Location& where, PlacedMesh& placed) {
  const glm::dvec3 edges = bounds.high - bounds.low;
  const double farthest = largest_coordinate({bounds.low - origin, bounds.high - origin}),
               extent = std::max({edges.x, edges.y, edges.z});
  if (!(farthest <= max_coordinate))
    throw bad_input(where,
                    fmt::format("reaches {:g} units away from the refracting and mirroring objects' middle", farthest),
                    fmt::format("at most {:g}", max_coordinate), "choose a larger unit or move it closer");
  if (!(extent >= min_extent))
    throw bad_input(where, fmt::format("is {:g} units across", extent), fmt::format("at least {:g}", min_extent),
                    "choose a smaller unit");
  const double spacing = farthest * 0x1p-23;
  if (spacing > 1e-4 * extent)
    placed.warnings.push_back(
        fmt::format("is {:g} units across but {:g} away from the refracting and mirroring objects' middle: single "
                    "precision moves its vertices by up to {:g}",
                    extent, farthest, spacing / 2));
}

void refuse_thinner(double thickness, double largest, const Location& where) {
  const double thinnest = 0x1p-20 * largest;
  if (thickness < thinnest)
    throw bad_input(where, fmt::format("is {:.3g} units thick, too little for single precision", thickness),
                    fmt::format("at least {:.3g} for what is {:.3g} units long", thinnest, largest),
                    "make it thicker or smaller");
}

/// Rays start some 2^-21 of a triangle's coordinates off it (kernels/tracing/surface.h): glass thinner than that would
/// be stepped over, and light go on inside it for ever. Twice the volume over the area is the thickness of a plate or a
/// shell.
void check_thickness(const Mesh& mesh, double volume, const Location& where) {
  double area = 0, largest = 0;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[triangle.x], ab = glm::dvec3(mesh.positions[triangle.y]) - a,
                     ac = glm::dvec3(mesh.positions[triangle.z]) - a;
    area += 0.5 * glm::length(glm::cross(ab, ac));
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max({largest, std::abs(a[axis]), std::abs(ab[axis]), std::abs(ac[axis])});
  }
  refuse_thinner(2 * std::abs(volume) / area, largest, where);
}

/// What is left of a place on an ellipsoid in single precision is the spacing of its coordinates.
void check_thickness(const Ellipsoid& ellipsoid, const Location& where) {
  refuse_thinner(2 * shortest_half_axis(ellipsoid), largest_coordinate(bounds_of(ellipsoid)), where);
}

/// The shape of a dielectric that its preset turns inside out has no inside to enter.
void check_turned(PlacedMesh& placed) {
  for (Ellipsoid& ellipsoid : placed.mesh.ellipsoids) {
    if (!ellipsoid.inwards) continue;
    ellipsoid.inwards = false;
    placed.damages.push_back({"is inside out", "its surface is turned round"});
  }
}

void check_surface(const MeshReport& report, bool dielectric, PlacedMesh& placed) {
  if (report.degenerate > 0)
    placed.warnings.push_back(counted(report.degenerate, "triangle") + " without area dropped");
  if (report.duplicated > 0) placed.warnings.push_back(counted(report.duplicated, "duplicated triangle") + " dropped");
  placed.closed = report.closed();
  if (!dielectric) return;
  if (placed.mesh.triangles.empty()) return check_turned(placed);
  if (report.open_edges > 0)
    placed.damages.push_back(
        {fmt::format("dielectric, but not closed: {} with one triangle", counted(report.open_edges, "edge")),
         "light that enters may never leave"});
  if (report.crowded_edges > 0)
    placed.damages.push_back(
        {fmt::format("dielectric, but its inside is not clear: {} with more than two triangles, or with two that "
                     "face opposite ways",
                     counted(report.crowded_edges, "edge")),
         {}});
  if (report.closed() && report.signed_volume < 0) {
    turn_round(placed.mesh);
    placed.damages.push_back({"is inside out", "its triangles are turned round"});
  }
  // A few are no sign of damage: at a spike a file's normal may oppose the mean of its triangles.
  if (2 * std::size_t{placed.mesh.mended_normals} > placed.mesh.positions.size())
    placed.damages.push_back(
        {"its vertex normals look to the wrong side of its triangles", "those of the triangles take their place"});
}

} // namespace

double largest_coordinate(const Bounds& bounds) {
  const glm::dvec3 largest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return std::max({largest.x, largest.y, largest.z});
}

glm::dmat3 rotation(const preset::Vec3& rotate_deg) {
  glm::dmat3 result(1);
  for (int axis = 0; axis < 3; ++axis) {
    const double angle = rotate_deg[static_cast<std::size_t>(axis)] * std::numbers::pi / 180;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    glm::dmat3 turn(1); // columns are the images of the axes
    turn[u][u] = turn[v][v] = std::cos(angle);
    turn[u][v] = std::sin(angle);
    turn[v][u] = -std::sin(angle);
    result = turn * result;
  }
  return result;
}

Placement make_placement(const preset::Transform& transform, const Mesh& mesh) {
  Placement placement;
  glm::dmat3 scale(1);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    scale[axis][axis] = transform.scale[i];
    placement.offset[axis] = transform.translate[i];
  }
  placement.linear = rotation(transform.rotate_deg) * scale;
  placement.offset += placement.linear * mesh.middle;
  return placement;
}

Bounds placed_bounds(const Mesh& mesh, const Placement& placement, const Location& where) {
  Bounds bounds;
  const auto add = [&](const glm::dvec3& p) {
    bounds = enclosing(bounds, {p, p});
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(p[axis]) < 1e30))
        throw bad_input(where, fmt::format("has a vertex at {:g}", p[axis]), "less than 1e30", "use a smaller scale");
  };
  for (const glm::vec3& p : mesh.positions) add(placement.linear * glm::dvec3(p) + placement.offset);
  for (const Ellipsoid& ellipsoid : mesh.ellipsoids) {
    const Bounds box = bounds_of(transformed(ellipsoid, placement, placement.offset));
    add(box.low);
    add(box.high);
  }
  return bounds;
}

PlacedMesh place(const Mesh& mesh, const Placement& placement, const Bounds& bounds, const glm::dvec3& origin,
                 bool dielectric, double crease_deg, const Location& where) {
  PlacedMesh placed;
  placed.has_own_normals = !mesh.normals.empty();
  check_extent(bounds, origin, where, placed);
  placed.mesh = transformed(mesh, placement, origin);
  const MeshReport report = inspect(placed.mesh);
  check_surface(report, dielectric, placed);
  if (report.degenerate + report.duplicated > 0) drop_useless(placed.mesh);
  if (dielectric && placed.closed && !placed.mesh.triangles.empty())
    check_thickness(placed.mesh, report.signed_volume, where);
  if (dielectric)
    for (const Ellipsoid& ellipsoid : placed.mesh.ellipsoids) check_thickness(ellipsoid, where);
  if (placed.mesh.triangles.empty() && placed.mesh.ellipsoids.empty())
    throw bad_input(where, "no triangle has an area after scaling", "a mesh with a surface", "use a scale closer to 1");
  if (!placed.has_own_normals) compute_smooth_normals(placed.mesh, crease_deg);
  placed.bounds = enclosing_sphere(placed.mesh, placed.mesh.triangles, placed.mesh.ellipsoids);
  return placed;
}

} // namespace nephroid::scene
