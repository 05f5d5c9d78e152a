// SPDX-License-Identifier: Apache-2.0
#include "inverse/finished.h"

#include "inverse/bending.h"
#include "inverse/light.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

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

/// Sums over the facets, each by the area that a triangle has of it, as seen from above.
template <class Value>
struct OverFacets {
  std::vector<Value> sums;
  std::vector<double> areas;

  OverFacets(const Layout& layout, const Solid& solid, const auto& value)
      : sums(layout.facet_count(), Value(0)), areas(layout.facet_count()) {
    for (std::size_t i = 0; i < solid.parts.size(); ++i) {
      if (solid.parts[i] != Part::facet) continue;
      const Triangle triangle = triangle_of(solid.mesh, i);
      const std::size_t facet = facet_at(layout, glm::dvec2(triangle.middle));
      sums[facet] += -triangle.across.z * value(facet, triangle);
      areas[facet] += -triangle.across.z;
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (areas[i] > 0) sums[i] /= areas[i];
  }
};

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
  // A lattice of corners, from rim to rim: at the rim that of the pixel beside it.
  const glm::ivec2 corners = pixels + 1;
  const auto add_layer = [&](const auto& z) {
    for (int y = 0; y < corners.y; ++y)
      for (int x = 0; x < corners.x; ++x) {
        glm::dvec2 p(layout.size.x * (static_cast<double>(x) / pixels.x - 0.5),
                     layout.size.y * (0.5 - static_cast<double>(y) / pixels.y));
        solid.add({p, z(x, y)});
      }
  };
  add_layer([&](int x, int y) {
    double of = 0;
    int count = 0;
    for (int v = std::max(0, y - 1); v <= std::min(pixels.y - 1, y); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(pixels.x - 1, x); ++u, ++count) of += at(u, v);
    return mean - of / count;
  });
  add_layer([&](int, int) { return mean; });
  const auto id = [&](int x, int y, bool is_top) {
    return static_cast<std::uint32_t>(index_at(x, y, corners.x) + (is_top ? index_at(0, corners.y, corners.x) : 0));
  };
  const auto add_quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, Part part) {
    solid.add(a, b, c, part);
    solid.add(a, c, d, part);
  };
  for (int y = 0; y < pixels.y; ++y)
    for (int x = 0; x < pixels.x; ++x) {
      add_quad(id(x, y, false), id(x + 1, y, false), id(x + 1, y + 1, false), id(x, y + 1, false), Part::facet);
      add_quad(id(x, y, true), id(x, y + 1, true), id(x + 1, y + 1, true), id(x + 1, y, true), Part::front);
    }
  const auto add_side = [&](const glm::ivec2& from, const glm::ivec2& to) {
    add_quad(id(from.x, from.y, false), id(from.x, from.y, true), id(to.x, to.y, true), id(to.x, to.y, false),
             Part::side);
  };
  for (int x = 0; x < pixels.x; ++x) {
    add_side({x + 1, 0}, {x, 0});
    add_side({x, pixels.y}, {x + 1, pixels.y});
  }
  for (int y = 0; y < pixels.y; ++y) {
    add_side({0, y}, {0, y + 1});
    add_side({pixels.x, y + 1}, {pixels.x, y});
  }
  for (std::size_t i = 0; i < solid.parts.size(); ++i)
    if (solid.parts[i] == Part::facet) solid.parts[i] = part_of(layout, triangle_of(solid.mesh, i), mean);
  measure(solid);
  return solid;
}

Solid read_finished(const Layout& layout, const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".exr" || ending == ".tif" || ending == ".tiff" || ending == ".pfm")
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
  const auto slope = [&](std::size_t facet, const Triangle& triangle) { return slope_of(layout, facet, triangle); };
  const OverFacets<glm::dvec2> wanted(layout, design, slope);
  const OverFacets<double> squares(layout, made, [&](std::size_t facet, const Triangle& triangle) {
    const glm::dvec2 off =
        (slope_of(layout, facet, triangle) - wanted.sums[facet]) * layout.distances[receiver] / layout.cell();
    return glm::dot(off, off);
  });
  Deviation found;
  std::vector<double> known;
  for (std::size_t i = 0; i < squares.sums.size(); ++i) {
    found.cells.push_back(std::sqrt(squares.sums[i]));
    if (squares.areas[i] > 0 && wanted.areas[i] > 0) known.push_back(found.cells.back());
  }
  if (known.empty()) return found;
  found.part_off = static_cast<double>(std::ranges::count_if(known, [](double cells) { return cells > 1; })) /
                   static_cast<double>(known.size());
  const auto half = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), half, known.end());
  found.median = *half;
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
