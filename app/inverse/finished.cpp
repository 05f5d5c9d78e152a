// SPDX-License-Identifier: Apache-2.0
#include "inverse/finished.h"

#include "inverse/bending.h"
#include "inverse/light.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

struct Triangle {
  glm::dvec3 middle{0}, across{0}; ///< across: the outward normal, as long as twice the area
  double height_over_width() const { return -across.z / glm::length(across); }
};

Triangle triangle_of(const scene::Mesh& mesh, std::size_t i) {
  const glm::uvec3& t = mesh.triangles[i];
  const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return {(a + b + c) / 3.0, glm::cross(b - a, c - a)};
}

bool is_at_outline(const Layout& layout, const glm::dvec2& p) {
  constexpr double near = 1e-3;
  const glm::dvec2 part = glm::abs(2.0 * p / layout.size);
  return (layout.round ? glm::length(part) : std::max(part.x, part.y)) > 1 - near;
}

Part part_of(const Layout& layout, const Triangle& triangle, double top) {
  constexpr double flat_side = 1e-3, wall_deg = 55, side = 0.1; // of the thickness; cosine
  const double down = triangle.height_over_width();
  if (down < 0 && triangle.middle.z > top - flat_side * layout.thickness) return Part::front;
  if (std::abs(down) < side && is_at_outline(layout, glm::dvec2(triangle.middle))) return Part::side;
  return down < std::cos(glm::radians(wall_deg)) ? Part::wall : Part::facet;
}

void check_size(const Layout& layout, const scene::Mesh& mesh, const Location& where) {
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::vec3& p : mesh.positions) {
    low = glm::min(low, glm::dvec2(p));
    high = glm::max(high, glm::dvec2(p));
  }
  constexpr double about = 0.01;
  const glm::dvec2 size = high - low, off = glm::abs(size / layout.size - 1.0);
  if (off.x > about || off.y > about)
    throw bad_input(where,
                    fmt::format("is {:.6g} x {:.6g} mm, and the design {:.6g} x {:.6g} mm", size.x, size.y,
                                layout.size.x, layout.size.y),
                    "expected the whole object, in millimetres");
  const glm::dvec2 middle = glm::abs(low + high) / 2.0 / layout.size;
  if (middle.x > about || middle.y > about)
    throw bad_input(where,
                    fmt::format("has its middle at ({:.4g}, {:.4g}) mm", (low.x + high.x) / 2, (low.y + high.y) / 2),
                    "expected it at 0, as in a run's object.stl");
}

/// z of the relief's corners and its steepness, for who asks.
void measure(Solid& solid) {
  for (std::size_t i = 0; i < solid.parts.size(); ++i) {
    if (solid.parts[i] != Part::facet) continue;
    const Triangle triangle = triangle_of(solid.mesh, i);
    solid.lean(glm::dvec2(triangle.across) / -triangle.across.z);
    for (int k = 0; k < 3; ++k) solid.reach(solid.mesh.positions[solid.mesh.triangles[i][k]].z);
  }
}

/// The slope that a facet's light gets on a triangle's plane.
glm::dvec2 slope_of(const Layout& layout, std::size_t facet, const Triangle& triangle) {
  return facet_slope(glm::dvec2(triangle.across) / -triangle.across.z, layout.n, layout.sines_on(facet));
}

/// Calls f(facet, triangle, its area as seen from above) for what bends light.
template <class F>
void for_surface(const Layout& layout, const Solid& solid, const F& f) {
  for (std::size_t i = 0; i < solid.parts.size(); ++i)
    if (solid.parts[i] == Part::facet) {
      const Triangle triangle = triangle_of(solid.mesh, i);
      f(facet_at(layout, glm::dvec2(triangle.middle)), triangle, -triangle.across.z / 2);
    }
}

} // namespace

Solid solid_of_mesh(const Layout& layout, const scene::Mesh& mesh, const Location& where) {
  const scene::MeshReport report = scene::inspect(mesh);
  if (!report.closed())
    throw bad_input(
        where,
        fmt::format("has holes: {} edges have one triangle, {} more than two", report.open_edges, report.crowded_edges),
        "expected a closed mesh; a scan of the relief alone can be given as a map of its thickness");
  Solid solid;
  solid.mesh.positions = mesh.positions;
  solid.mesh.triangles = mesh.triangles;
  for (glm::vec3& p : solid.mesh.positions) p += glm::vec3(mesh.middle);
  if (report.signed_volume < 0) scene::turn_triangles(solid.mesh);
  scene::drop_useless(solid.mesh);
  check_size(layout, solid.mesh, where);
  double top = -std::numeric_limits<double>::infinity(), flat = 0;
  for (const glm::vec3& p : solid.mesh.positions) top = std::max(top, static_cast<double>(p.z));
  for (std::size_t i = 0; i < solid.mesh.triangles.size(); ++i) {
    const Triangle triangle = triangle_of(solid.mesh, i);
    solid.parts.push_back(part_of(layout, triangle, top));
    if (solid.parts.back() == Part::front) flat += triangle.across.z / 2;
  }
  const double wanted = layout.size.x * layout.size.y * (layout.round ? glm::pi<double>() / 4 : 1);
  if (flat < wanted / 2)
    throw bad_input(where, "has no flat side at the top (+z)",
                    "expected the object as in a run's object.stl: the relief looks down");
  measure(solid);
  return solid;
}

Solid solid_of_heights(const Layout& layout, const image::Image& thickness, const Location& where) {
  if (thickness.channels.size() != 1)
    throw bad_input(where, fmt::format("has {} channels", thickness.channels.size()),
                    "expected one: the thickness in mm");
  if (thickness.width < 2 || thickness.height < 2)
    throw bad_input(where, "has one row or column of pixels", "expected a map of the whole object");
  const glm::ivec2 pixels(thickness.width, thickness.height);
  std::size_t missing = 0, inside = 0;
  double sum = 0;
  const auto at = [&](int x, int y) {
    return static_cast<double>(thickness.data[index_at(pixels.x - 1 - x, y, pixels.x)]);
  };
  for (int y = 0; y < pixels.y; ++y)
    for (int x = 0; x < pixels.x; ++x) {
      if (layout.is_beside(Layout::middle_of(index_at(x, y, pixels.x), pixels, layout.size))) continue;
      if (const double value = at(x, y); value > 0 && std::isfinite(value)) {
        sum += value;
        ++inside;
      } else
        ++missing;
    }
  if (missing > 0)
    throw bad_input(where, fmt::format("has holes: {} of {} pixels have no thickness", missing, missing + inside),
                    "expected millimetres above 0 in every pixel of the object; fill the holes first");
  const double mean = sum / static_cast<double>(inside);
  Solid solid;
  // Corners are in the pixels' middles, the outermost at the rim, where the surface goes on as it is beside it.
  const auto placed = [](int i, int count) { return i == 0 ? 0.0 : i + 1 == count ? 1.0 : (i + 0.5) / count; };
  const auto along = [](int i, int count, const auto& value) {
    const int beside = i == 0 ? 1 : i + 1 == count ? i - 1 : i; // itself within
    return 1.5 * value(i) - 0.5 * value(beside);
  };
  const auto add_layer = [&](const auto& z) {
    for (int y = 0; y < pixels.y; ++y)
      for (int x = 0; x < pixels.x; ++x)
        solid.add({layout.size.x * (placed(x, pixels.x) - 0.5), layout.size.y * (0.5 - placed(y, pixels.y)), z(x, y)});
  };
  add_layer([&](int x, int y) {
    return mean - along(x, pixels.x, [&](int u) { return along(y, pixels.y, [&](int v) { return at(u, v); }); });
  });
  add_layer([&](int, int) { return mean; });
  const auto id = [&](int x, int y, bool is_top) {
    return static_cast<std::uint32_t>(index_at(x, y, pixels.x) + (is_top ? index_at(0, pixels.y, pixels.x) : 0));
  };
  const auto add_quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, Part part) {
    solid.add(a, b, c, part);
    solid.add(a, c, d, part);
  };
  const glm::ivec2 last = pixels - 1;
  for (int y = 0; y < last.y; ++y)
    for (int x = 0; x < last.x; ++x) {
      add_quad(id(x, y, false), id(x + 1, y, false), id(x + 1, y + 1, false), id(x, y + 1, false), Part::facet);
      add_quad(id(x, y, true), id(x, y + 1, true), id(x + 1, y + 1, true), id(x + 1, y, true), Part::front);
    }
  const auto add_side = [&](const glm::ivec2& from, const glm::ivec2& to) {
    add_quad(id(from.x, from.y, false), id(to.x, to.y, false), id(to.x, to.y, true), id(from.x, from.y, true),
             Part::side);
  };
  for (int x = 0; x < last.x; ++x) {
    add_side({x + 1, 0}, {x, 0});
    add_side({x, last.y}, {x + 1, last.y});
  }
  for (int y = 0; y < last.y; ++y) {
    add_side({0, y}, {0, y + 1});
    add_side({last.x, y + 1}, {last.x, y});
  }
  for (std::size_t i = 0; i < solid.parts.size(); ++i)
    if (solid.parts[i] == Part::facet) solid.parts[i] = part_of(layout, triangle_of(solid.mesh, i), mean);
  measure(solid);
  return solid;
}

Solid read_finished(const Layout& layout, const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".exr" || ending == ".tif" || ending == ".tiff")
    return solid_of_heights(layout, image::read_image(file), file.string());
  return solid_of_mesh(layout, scene::load_mesh(file), file.string());
}

double top_of(const Solid& solid) {
  double top = -std::numeric_limits<double>::infinity();
  for (const glm::vec3& p : solid.mesh.positions) top = std::max(top, static_cast<double>(p.z));
  return top;
}

void move_top(Solid& solid, double z) {
  std::vector<bool> moved(solid.mesh.positions.size());
  for (std::size_t i = 0; i < solid.parts.size(); ++i)
    if (solid.parts[i] == Part::front)
      for (int k = 0; k < 3; ++k) moved[solid.mesh.triangles[i][k]] = true;
  const auto by = static_cast<float>(z - top_of(solid));
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i]) solid.mesh.positions[i].z += by;
}

Deviation deviation(const Layout& layout, const Solid& design, const Solid& made, std::size_t receiver) {
  const std::size_t count = layout.facet_count();
  std::vector<glm::dvec2> wanted(count);
  std::vector<double> areas(count);
  for_surface(layout, design, [&](std::size_t facet, const Triangle& triangle, double area) {
    wanted[facet] += area * slope_of(layout, facet, triangle);
    areas[facet] += area;
  });
  struct Piece {
    double cells = 0, area = 0;
  };
  std::vector<Piece> pieces;
  std::vector<double> made_areas(count);
  Deviation found{std::vector<double>(count), 0, 0};
  double whole = 0, before = 0;
  for_surface(layout, made, [&](std::size_t facet, const Triangle& triangle, double area) {
    if (areas[facet] == 0) return;
    const glm::dvec2 off = slope_of(layout, facet, triangle) - wanted[facet] / areas[facet];
    pieces.push_back({glm::length(off * layout.distances[receiver] / layout.cell()), area});
    made_areas[facet] += area;
    whole += area;
    if (pieces.back().cells > 1) found.off[facet] += area;
  });
  for (std::size_t i = 0; i < count; ++i) {
    found.part_off += found.off[i];
    if (made_areas[i] > 0) found.off[i] /= made_areas[i];
  }
  if (whole > 0) found.part_off /= whole;
  std::ranges::sort(pieces, {}, &Piece::cells);
  for (const Piece& piece : pieces)
    if (before += piece.area; before >= whole / 2) {
      found.median_cells = piece.cells;
      break;
    }
  return found;
}

Layout through_focus(const Layout& layout, double part, int steps) {
  Layout through = layout;
  through.frames.clear();
  through.distances.clear();
  through.offsets.emplace();
  through.light_of.clear();
  through.weights.reset();
  for (std::size_t j = 0; j < layout.distances.size(); ++j)
    for (int k = 0; k < steps; ++k) {
      through.distances.push_back(layout.distances[j] * (1 + part * (2.0 * k / (steps - 1) - 1)));
      through.offsets->push_back(layout.offset(j));
      if (!layout.own_lights.empty()) through.light_of.push_back(layout.light_index(j));
    }
  return through;
}

std::vector<Target> through_focus(const std::vector<Target>& targets, int steps) {
  std::vector<Target> all;
  for (const Target& target : targets) all.insert(all.end(), static_cast<std::size_t>(steps), target);
  return all;
}

} // namespace nephroid::inverse
