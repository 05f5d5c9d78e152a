// SPDX-License-Identifier: Apache-2.0
// An object whose surface shines.
#include "lights/lights.h"

#include "base/exact_cdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>

namespace nephroid::lights {
namespace {

using std::numbers::pi;

/// Places just outside of its surface: at most 64, even over its triangles.
std::vector<glm::dvec3> places_of_mesh(const scene::Scene& scene, const scene::Object& object) {
  std::vector<glm::dvec3> places;
  const std::span<const glm::uvec3> triangles = triangles_of(scene, object);
  const std::size_t step = triangles.size() / 64 + 1;
  for (std::size_t i = 0; i < triangles.size(); i += step) {
    const auto corner = [&](int c) { return glm::dvec3(scene.geometry.positions[triangles[i][c]]); };
    const glm::dvec3 a = corner(0), across = glm::cross(corner(1) - a, corner(2) - a);
    const double length = glm::length(across); // twice the area
    places.push_back((a + corner(1) + corner(2)) / 3.0 + 1e-3 / std::sqrt(length) * across);
  }
  for (const scene::Ellipsoid& ellipsoid : ellipsoids_of(scene, object))
    for (const double side : {1.001, -1.001})
      for (const glm::vec3& half_axis : ellipsoid.half_axes)
        places.push_back(glm::dvec3(ellipsoid.centre) + side * glm::dvec3(half_axis));
  return places;
}

bool is_ellipsoid(const shared::DevicePrimitive& primitive) {
  return (std::bit_cast<int>(primitive.corner.w) & 3) >= PRIMITIVE_ELLIPSOID;
}

/// In square units. Of an ellipsoid the mean of what kernels draw it by, over a fine grid of the unit sphere.
double area_of(const shared::DevicePrimitive& primitive) {
  const glm::dvec3 x = vector(primitive.edge_u), y = vector(primitive.edge_v), z = vector(primitive.normal);
  if (!is_ellipsoid(primitive)) return 0.5 * glm::length(glm::cross(x, y));
  constexpr int across = 512, around = 256;
  double sum = 0;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < around; ++j) {
      const double height = std::cos(pi * (i + 0.5) / across), radius = std::sin(pi * (i + 0.5) / across),
                   phi = 2 * pi * (j + 0.5) / around;
      sum += radius * glm::length(radius * std::cos(phi) * x + radius * std::sin(phi) * y + height * z);
    }
  const double steradians = 4 * std::sin(pi / (2 * across)) * pi / around; // of a cell, over its sine
  return sum * steradians / (glm::length(x) * glm::length(y) * glm::length(z));
}

class Mesh final : public Model {
public:
  void describe(preset::Fields& v, preset::Light& light) const override {
    describe_power(v, light);
    v.field("object", "The name of the object whose surface shines.", light.object,
            {.text = preset::Text::line, .names = preset::Names::object, .required = true});
  }

  /// Throws bad_input for an object that has no surface, or more triangles than a table of chances can tell.
  void load(const preset::Light& from, const Loading& loading, scene::Light& light) const override {
    constexpr std::uint32_t most_triangles = 1U << 22;
    const scene::Scene& scene = loading.scene;
    const Location where = loading.where / "object";
    const auto object = std::ranges::find(scene.objects, from.object, &scene::Object::name);
    if (object == scene.objects.end() || is_empty(*object))
      throw bad_input(where, fmt::format("object '{}' has no surface that could shine", from.object));
    if (object->triangle_count + object->ellipsoid_count > most_triangles)
      throw bad_input(where, fmt::format("object '{}' has {} triangles", from.object, object->triangle_count),
                      fmt::format("expected at most {} of one that shines", most_triangles), "make it coarser");
    light.object = static_cast<int>(object - scene.objects.begin());
    light.power_w = from.power_w;
    light.position = object->bounds.centre;
    light.inside = dielectrics_around(scene, places_of_mesh(scene, *object).front());
    std::erase(light.inside, light.object); // it shines to its outside
  }

  void set_row(const scene::Light&, shared::DeviceLight&) const override {}

  std::vector<float> table(const scene::Light&, const Surfaces& surfaces, shared::DeviceLight& row) const override {
    std::vector<double> areas;
    double area = 0;
    for (const shared::DevicePrimitive& primitive : surfaces.primitives) {
      areas.push_back(area_of(primitive));
      area += areas.back();
    }
    row.as.mesh.area = static_cast<float>(area);
    row.as.mesh.first_surface = static_cast<int>(surfaces.first);
    row.as.mesh.surfaces = static_cast<int>(areas.size());
    return exact_cdf(areas);
  }

  bool has_places(const shared::DeviceLight&) const override { return true; }

  glm::dvec3 place(const shared::DeviceLight& row, const float* table, const Surfaces& surfaces,
                   std::array<float, 2> u) const override {
    const auto [chosen, rest] = bin_of(table, static_cast<std::size_t>(row.as.mesh.surfaces), u[0]);
    const shared::DevicePrimitive& primitive = surfaces.primitives[chosen];
    const glm::dvec3 corner = vector(primitive.corner), x = vector(primitive.edge_u), y = vector(primitive.edge_v);
    if (is_ellipsoid(primitive)) {
      const glm::dvec3 z = vector(primitive.normal);
      const double height = 2 * rest - 1, radius = std::sqrt(std::max(1 - height * height, 0.0)), phi = 2 * pi * u[1];
      return corner + radius * std::cos(phi) / glm::dot(x, x) * x + radius * std::sin(phi) / glm::dot(y, y) * y +
             height / glm::dot(z, z) * z;
    }
    const double root = std::sqrt(rest);
    return corner + (1 - root) * x + u[1] * root * y;
  }

  std::vector<glm::dvec3> extent(const scene::Scene& scene, const scene::Light& light) const override {
    return places_of_mesh(scene, scene.objects[static_cast<std::size_t>(light.object)]);
  }

  double towards_w(const scene::Light& light, const std::vector<scene::Sphere>& spheres, double) const override {
    return surface_towards_w(light, spheres);
  }

  std::string_view left_out(const scene::Light&) const override {
    return "an object that shines is a point light in its middle, where it may hide it: give its material an emission "
           "in the other program";
  }
};

} // namespace

const Model& mesh() {
  static const Mesh made;
  return made;
}

} // namespace nephroid::lights
