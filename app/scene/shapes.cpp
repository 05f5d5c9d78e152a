// SPDX-License-Identifier: Apache-2.0
// Shapes from their closed forms, in double until the last step. around(angle) runs from +x towards -z: counter-clockwise seen
// from above, so sides and caps face outwards when their corners are taken in rising order.
#include "scene/shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::scene {

void add_facet(Mesh& mesh, std::span<const glm::dvec3> corners)
{
  // Newell's sum: the polygon's area vector, whichever corners lie close together.
  glm::dvec3 area(0);
  for (std::size_t i = 0; i < corners.size(); ++i) area += glm::cross(corners[i], corners[(i + 1) % corners.size()]);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec3& corner : corners) {
    mesh.positions.emplace_back(corner);
    mesh.normals.emplace_back(glm::normalize(area));
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i) mesh.triangles.emplace_back(first, first + i - 1, first + i);
}

namespace {

using Quad = std::array<glm::dvec3, 4>;

Mesh make_quad(double x, double z)
{
  Mesh mesh;
  add_facet(mesh, Quad{{{-x / 2, 0, -z / 2}, {-x / 2, 0, z / 2}, {x / 2, 0, z / 2}, {x / 2, 0, -z / 2}}});
  return mesh;
}

/// A prism along y over a convex polygon in the plane y = 0 that runs counter-clockwise seen from above.
Mesh extrude(std::span<const glm::dvec3> outline, double height)
{
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

Mesh make_box(const preset::Vec3& size)
{
  const double x = size[0] / 2, z = size[2] / 2;
  return extrude(Quad{{{x, 0, -z}, {-x, 0, -z}, {-x, 0, z}, {x, 0, z}}}, size[1]);
}

Mesh make_prism(double apex_deg, double side, double height)
{
  const double half_apex = apex_deg / 2 * std::numbers::pi / 180;
  const double half_base = side * std::sin(half_apex), half_depth = side * std::cos(half_apex) / 2;
  return extrude(std::array<glm::dvec3, 3>{{{0, 0, half_depth}, {half_base, 0, -half_depth}, {-half_base, 0, -half_depth}}}, height);
}

glm::dvec3 around(int step, int steps)
{
  const double angle = 2 * std::numbers::pi * step / steps;
  return {std::cos(angle), 0, -std::sin(angle)};
}

Mesh make_cylinder(double radius, double height, int segments)
{
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
    mesh.triangles.emplace_back(a, a + 1, b + 1);
    mesh.triangles.emplace_back(a, b + 1, b);
  }
  return mesh;
}

Mesh make_sphere(float radius)
{
  Mesh mesh;
  mesh.ellipsoids.push_back({glm::vec3(0), {{{radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}}, false});
  return mesh;
}

Mesh make_outward(const preset::Shape& shape)
{
  switch (shape.type) {
  case preset::Shape::Type::quad:
    return make_quad(shape.size[0], shape.size[2]);
  case preset::Shape::Type::box:
  case preset::Shape::Type::plate:
    return make_box(shape.size);
  case preset::Shape::Type::sphere:
    return make_sphere(static_cast<float>(shape.radius));
  case preset::Shape::Type::cylinder:
    return make_cylinder(shape.radius, shape.height, shape.segments);
  case preset::Shape::Type::prism:
    return make_prism(shape.apex_deg, shape.side, shape.height);
  case preset::Shape::Type::brilliant: {
    Mesh mesh = make_brilliant();
    for (glm::vec3& position : mesh.positions) position *= static_cast<float>(shape.radius);
    return mesh;
  }
  }
  return {};
}

} // namespace

Mesh make_shape(const preset::Shape& shape)
{
  Mesh mesh = make_outward(shape);
  if (shape.inwards) turn_round(mesh);
  return mesh;
}

} // namespace nephroid::scene
