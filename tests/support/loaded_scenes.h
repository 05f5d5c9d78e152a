// SPDX-License-Identifier: Apache-2.0
// What the tests of scene loading start from and ask of a loaded scene.
#pragma once
#include "preset/preset.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace nephroid::test {

inline preset::Object shape_object(const std::string& name, preset::Shape::Type type, const std::string& material)
{
  preset::Object object;
  object.name = name;
  object.shape = preset::Shape{};
  object.shape->type = type;
  object.material = material;
  return object;
}

/// A glass ball of diameter 1 at the origin over a wall, a point light above.
inline preset::Preset ball_over_floor()
{
  preset::Preset preset;
  preset.source = "p.json";
  preset.scene.materials["glass"].type = preset::Material::Type::dielectric;
  preset.scene.materials["mirror"].type = preset::Material::Type::mirror;
  preset.scene.materials["wall"];
  preset.scene.objects = {shape_object("ball", preset::Shape::Type::sphere, "glass"),
                          shape_object("floor", preset::Shape::Type::quad, "wall")};
  preset.scene.objects[0].shape->segments = 32;
  preset.scene.objects[1].transform.scale = {10, 1, 10};
  preset.scene.objects[1].transform.translate = {0, -1, 0};
  preset.scene.lights.resize(1);
  preset.scene.lights[0].position = {0, 3, 0};
  return preset;
}

/// The error line that loading the scene gives, which must be of bad input.
inline std::string refusal(const preset::Preset& preset)
{
  return refusal_of([&] { scene::load_scene(preset); });
}

/// Lowest and highest corner of an object's triangles in the preset's coordinates.
inline std::pair<glm::dvec3, glm::dvec3> world_bounds(const scene::Scene& scene, std::size_t index)
{
  const scene::Object& object = scene.objects[index];
  glm::dvec3 low(1e300), high(-1e300);
  for (std::uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count; ++t)
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 p = scene.origin + glm::dvec3(scene.geometry.positions[scene.geometry.triangles[t][i]]);
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  return {low, high};
}

/// What an object's triangles enclose, in cubic units.
inline double volume(const scene::Scene& scene, std::size_t index)
{
  return scene::signed_volume(scene.geometry, scene.objects[index].first_triangle, scene.objects[index].triangle_count);
}

inline void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6)
{
  EXPECT_LT(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

} // namespace nephroid::test
