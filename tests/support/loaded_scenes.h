// SPDX-License-Identifier: Apache-2.0
// What the tests of scene loading start from and ask of a loaded scene.
#pragma once
#include "scene/scene.h"
#include "tests/support/test.h"

namespace nephroid::test {

inline preset::Object shape_object(const std::string& name, preset::Shape::Type type, const std::string& material,
                                   const preset::Transform& transform = {}) {
  return {.name = name, .shape = preset::Shape{.type = type}, .material = material, .transform = transform};
}

/// A glass ball of diameter 1 at the origin over a wall, a point light above.
inline preset::Preset ball_over_floor() {
  preset::Preset preset{.source = "p.json"};
  preset.scene.materials["glass"].type = preset::Material::Type::dielectric;
  preset.scene.materials["mirror"].type = preset::Material::Type::mirror;
  preset.scene.materials["wall"];
  preset.scene.objects = {
      shape_object("ball", preset::Shape::Type::sphere, "glass"),
      shape_object("floor", preset::Shape::Type::quad, "wall", {.scale = {10, 1, 10}, .translate = {0, -1, 0}})};
  preset.scene.lights = {{.position = {0, 3, 0}}};
  return preset;
}

/// The error line that loading the scene gives, which must be of bad input.
inline std::string refusal(const preset::Preset& preset) {
  return refusal_of([&] { scene::load_scene(preset); });
}

/// Lowest and highest corner of the box about an object in the preset's coordinates.
inline std::pair<glm::dvec3, glm::dvec3> world_bounds(const scene::Scene& scene, std::size_t index) {
  const scene::Bounds bounds = bounds_of(scene, scene.objects[index]);
  return {scene.origin + bounds.low, scene.origin + bounds.high};
}

/// What an object encloses, in cubic units.
inline double volume(const scene::Scene& scene, std::size_t index) {
  double sum =
      scene::signed_volume(scene.geometry, scene.objects[index].first_triangle, scene.objects[index].triangle_count);
  for (const scene::Ellipsoid& ellipsoid : ellipsoids_of(scene, scene.objects[index]))
    sum += (ellipsoid.inwards ? -1 : 1) * volume_of(ellipsoid);
  return sum;
}

inline void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
  EXPECT_LT(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

} // namespace nephroid::test
