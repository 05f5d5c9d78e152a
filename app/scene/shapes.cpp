// SPDX-License-Identifier: Apache-2.0
// Shapes from their closed forms, in double until the last step. around(angle) runs from +x towards -z:
// counter-clockwise seen from above, so sides and caps face outwards when their corners are taken in rising order.
#include "scene/scene.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace nephroid::scene {
namespace {

/// Adds a flat convex polygon, counter-clockwise seen from outside, as a fan with vertices and one normal of its own.
/// A texture fills the rectangle about it. Its up is +y; on a facet that looks up or down its right is +x.
void add_facet(Mesh& mesh, std::span<const glm::dvec3> corners) {
  // Newell's sum: the polygon's area vector, whichever corners lie close together.
  glm::dvec3 area(0);
  for (std::size_t i = 0; i < corners.size(); ++i) area += glm::cross(corners[i], corners[(i + 1) % corners.size()]);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const glm::dvec3 normal = glm::normalize(area);
  const glm::dvec3 right =
      std::abs(normal.y) > 0.999 ? glm::dvec3(1, 0, 0) : glm::normalize(glm::cross({0, 1, 0}, normal));
  const glm::dmat2x3 axes(right, glm::cross(normal, right));
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& corner : corners) {
    mesh.positions.emplace_back(corner);
    mesh.normals.emplace_back(normal);
    low = glm::min(low, corner * axes);
    high = glm::max(high, corner * axes);
  }
  const auto texcoord = [&](std::uint32_t i) { return glm::vec2((corners[i] * axes - low) / (high - low)); };
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    mesh.triangles.emplace_back(first, first + i - 1, first + i);
    mesh.texcoords.push_back({texcoord(0), texcoord(i - 1), texcoord(i)});
  }
}

using Quad = std::array<glm::dvec3, 4>;

Mesh make_quad(double x, double z) {
  Mesh mesh;
  add_facet(mesh, Quad{{{-x / 2, 0, -z / 2}, {-x / 2, 0, z / 2}, {x / 2, 0, z / 2}, {x / 2, 0, -z / 2}}});
  return mesh;
}

/// A prism along y over a convex polygon in the plane y = 0 that runs counter-clockwise seen from above.
Mesh extrude(std::span<const glm::dvec3> outline, double height) {
  const glm::dvec3 up(0, height / 2, 0);
  std::vector<glm::dvec3> top, bottom;
  for (const glm::dvec3& corner : outline) {
    top.push_back(corner + up);
    bottom.insert(bottom.begin(), corner - up);
  }
  Mesh mesh;
  add_facet(mesh, top);
  add_facet(mesh, bottom);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    add_facet(mesh, Quad{a + up, a - up, b - up, b + up});
  }
  return mesh;
}

Mesh make_box(const preset::Vec3& size) {
  const double x = size[0] / 2, z = size[2] / 2;
  return extrude(Quad{{{x, 0, -z}, {-x, 0, -z}, {-x, 0, z}, {x, 0, z}}}, size[1]);
}

Mesh make_prism(double apex_deg, double side, double height) {
  const double half_apex = apex_deg / 2 * std::numbers::pi / 180;
  const double half_base = side * std::sin(half_apex), half_depth = side * std::cos(half_apex) / 2;
  return extrude(
      std::array<glm::dvec3, 3>{{{0, 0, half_depth}, {half_base, 0, -half_depth}, {-half_base, 0, -half_depth}}},
      height);
}

glm::dvec3 around(int step, int steps) {
  const double angle = 2 * std::numbers::pi * step / steps;
  return {std::cos(angle), 0, -std::sin(angle)};
}

Mesh make_cylinder(double radius, double height, int segments) {
  const glm::dvec3 up(0, height / 2, 0);
  std::vector<glm::dvec3> top, bottom;
  for (int i = 0; i < segments; ++i) top.push_back(radius * around(i, segments) + up);
  for (int i = segments; i-- > 0;) bottom.push_back(radius * around(i, segments) - up);
  Mesh mesh;
  add_facet(mesh, top);
  add_facet(mesh, bottom);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < segments; ++i) {
    for (const glm::dvec3& end : {up, -up}) {
      mesh.positions.emplace_back(radius * around(i, segments) + end);
      mesh.normals.emplace_back(around(i, segments));
    }
  }
  for (int i = 0; i < segments; ++i) {
    const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % segments);
    const float u = static_cast<float>(i) / static_cast<float>(segments),
                next_u = static_cast<float>(i + 1) / static_cast<float>(segments);
    mesh.triangles.emplace_back(a, a + 1, b + 1);
    mesh.triangles.emplace_back(a, b + 1, b);
    mesh.texcoords.push_back({{{u, 1}, {u, 0}, {next_u, 0}}});
    mesh.texcoords.push_back({{{u, 1}, {next_u, 0}, {next_u, 1}}});
  }
  return mesh;
}

Mesh make_sphere(float radius) {
  Mesh mesh;
  mesh.ellipsoids.push_back({glm::vec3(0), {{{radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}}, false});
  return mesh;
}

// The round brilliant cut with 57 facets: table, 8 stars, 8 bezels, 16 upper girdle, 16 lower girdle, 8 pavilion mains;
// pointed culet. The two angles and the table are Tolkowsky's (Diamond Design, 1919); star and lower-girdle lengths are
// common today (Gemological Institute of America, "Estimating a round brilliant's cut grade"). The girdle is a prism of
// 16 flat sides, so that the upper and lower girdle facets end in straight edges.
constexpr double radians = std::numbers::pi / 180;
constexpr double crown_angle = 34.5 * radians;
constexpr double pavilion_angle = 40.75 * radians;
constexpr double table = 0.53;         ///< corner to opposite corner, over the girdle's diameter
constexpr double star = 0.5;           ///< horizontal length over the way from table edge to girdle
constexpr double lower_girdle = 0.8;   ///< horizontal length over the way from girdle to axis
constexpr double girdle_height = 0.06; ///< over the radius: 3 % of the diameter

/// A point at `step` times 22.5 degrees around the axis; the same bits again after a whole turn.
glm::dvec3 around_stone(int step, double radius, double y) {
  const double angle = (step + 16) % 16 * 22.5 * radians;
  return {radius * std::cos(angle), y, -radius * std::sin(angle)};
}

/// Height over the girdle at `radius` and 22.5 degrees beside the middle of a facet that starts at radius 1 with
/// `slope`: where the facet meets its neighbour, which lies 45 degrees on.
double height_between(double radius, double slope) { return (1 - radius * std::cos(22.5 * radians)) * std::tan(slope); }

Mesh make_brilliant() {
  // Heights over the girdle's middle. The bezel (kite) facet rises from a girdle corner to a table corner; two
  // neighbours meet in a line on which the star's tip lies. The pavilion mains fall from the girdle's corners to the
  // culet in the same way.
  const double top = girdle_height / 2, bottom = -girdle_height / 2;
  const double table_y = top + (1 - table) * std::tan(crown_angle);
  const double culet_y = bottom - std::tan(pavilion_angle);
  const double table_edge = table * std::cos(22.5 * radians);
  const double star_radius = table_edge + star * (1 - table_edge);
  const double star_y = top + height_between(star_radius, crown_angle);
  const double half_radius = 1 - lower_girdle;
  const double half_y = bottom - height_between(half_radius, pavilion_angle);
  const double centre_y = (table_y + culet_y) / 2;

  const auto corner = [&](int step) { return around_stone(step, table, table_y - centre_y); };
  const auto star_tip = [&](int step) { return around_stone(step, star_radius, star_y - centre_y); };
  const auto upper = [&](int step) { return around_stone(step, 1, top - centre_y); };
  const auto lower = [&](int step) { return around_stone(step, 1, bottom - centre_y); };
  const auto half_tip = [&](int step) { return around_stone(step, half_radius, half_y - centre_y); };
  const glm::dvec3 culet{0, culet_y - centre_y, 0};

  Mesh mesh;
  using Triangle = std::array<glm::dvec3, 3>;
  using Kite = std::array<glm::dvec3, 4>;
  std::array<glm::dvec3, 8> octagon;
  for (int i = 0; i < 8; ++i) octagon[i] = corner(2 * i);
  add_facet(mesh, octagon);
  for (int step = 0; step < 16; step += 2) {
    add_facet(mesh, Triangle{corner(step), star_tip(step + 1), corner(step + 2)});
    add_facet(mesh, Kite{corner(step), star_tip(step - 1), upper(step), star_tip(step + 1)});
    add_facet(mesh, Triangle{star_tip(step + 1), upper(step), upper(step + 1)});
    add_facet(mesh, Triangle{star_tip(step + 1), upper(step + 1), upper(step + 2)});
    add_facet(mesh, Kite{culet, half_tip(step + 1), lower(step), half_tip(step - 1)});
    add_facet(mesh, Triangle{half_tip(step + 1), lower(step + 1), lower(step)});
    add_facet(mesh, Triangle{half_tip(step + 1), lower(step + 2), lower(step + 1)});
  }
  for (int step = 0; step < 16; ++step)
    add_facet(mesh, Kite{upper(step), lower(step), lower(step + 1), upper(step + 1)});
  return mesh;
}

/// Panes are flat, each in the chord of its own part of the arc, or pillows: z = pillow (1 - u^2) (1 - v^2) over u and
/// v from -1 to 1. A pane has a texture of its own.
Mesh make_curtain_wall(const preset::Shape& shape) {
  constexpr int squares = 8; // along the edge of a pillow
  const double arc = shape.arc_deg * radians, width = shape.size[0], height = shape.size[1];
  const auto [columns, rows] = shape.panes;
  const double along = width / columns, upward = height / rows; // of a pane with its gap
  const double depth = arc == 0 ? 0 : width / arc * (1 - std::cos(arc / 2));
  const int edge = shape.pillow == 0 ? 1 : squares;
  Mesh mesh;
  for (int column = 0; column < columns; ++column) {
    // The pane's middle is on a chord of the arc.
    const double turn = arc * ((column + 0.5) / columns - 0.5), step = arc / columns;
    const double chord = arc == 0 ? along : 2 * width / arc * std::sin(step / 2);
    const glm::dvec3 right(std::cos(turn), 0, std::sin(turn)), out(-std::sin(turn), 0, std::cos(turn));
    glm::dvec3 middle((column + 0.5) * along - width / 2, 0, 0);
    if (arc != 0) {
      const double radius = width / arc;
      middle = glm::dvec3(0, 0, radius - depth / 2) - radius * std::cos(step / 2) * out;
    }
    const double half_x = (chord - shape.gap) / 2, half_y = (upward - shape.gap) / 2;
    for (int row = 0; row < rows; ++row) {
      const glm::dvec3 at = middle + glm::dvec3(0, height / 2 - (row + 0.5) * upward, 0);
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (int j = 0; j <= edge; ++j)
        for (int i = 0; i <= edge; ++i) {
          const double u = 2.0 * i / edge - 1, v = 2.0 * j / edge - 1, slope_x = -2 * u * (1 - v * v),
                       slope_y = -2 * v * (1 - u * u);
          mesh.positions.emplace_back(at + u * half_x * right + glm::dvec3(0, v * half_y, 0) +
                                      shape.pillow * (1 - u * u) * (1 - v * v) * out);
          mesh.normals.emplace_back(glm::normalize(out - shape.pillow * slope_x / half_x * right -
                                                   glm::dvec3(0, shape.pillow * slope_y / half_y, 0)));
        }
      const auto corner = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (edge + 1) + i); };
      const auto place = [&](int i, int j) { return glm::vec2(i, j) / static_cast<float>(edge); };
      for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i) {
          mesh.triangles.emplace_back(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
          mesh.triangles.emplace_back(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
          mesh.texcoords.push_back({place(i, j), place(i + 1, j), place(i + 1, j + 1)});
          mesh.texcoords.push_back({place(i, j), place(i + 1, j + 1), place(i, j + 1)});
        }
    }
  }
  return mesh;
}

Mesh make_outward(const preset::Shape& shape) {
  switch (shape.type) {
  case preset::Shape::Type::quad: return make_quad(shape.size[0], shape.size[2]);
  case preset::Shape::Type::box:
  case preset::Shape::Type::plate: return make_box(shape.size);
  case preset::Shape::Type::sphere: return make_sphere(static_cast<float>(shape.radius));
  case preset::Shape::Type::cylinder: return make_cylinder(shape.radius, shape.height, shape.segments);
  case preset::Shape::Type::prism: return make_prism(shape.apex_deg, shape.side, shape.height);
  case preset::Shape::Type::brilliant: {
    Mesh mesh = make_brilliant();
    for (glm::vec3& position : mesh.positions) position *= static_cast<float>(shape.radius);
    return mesh;
  }
  case preset::Shape::Type::curtain_wall: return make_curtain_wall(shape);
  case preset::Shape::Type::water:
  case preset::Shape::Type::relief: break; // heights.h
  }
  return {};
}

} // namespace

Mesh make_shape(const preset::Shape& shape) {
  Mesh mesh = make_outward(shape);
  if (shape.inwards) turn_round(mesh);
  return mesh;
}

} // namespace nephroid::scene
