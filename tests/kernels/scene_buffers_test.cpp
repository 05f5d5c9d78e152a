// SPDX-License-Identifier: Apache-2.0
// What the plan says of a scene's memory is what its tables take on the device.
#include "tests/support/plans.h"
#include "tests/support/test_kernels.h"
#include "tracing/world.h"

namespace nephroid::scene_buffers_test {

void expect_planned(const preset::Preset& preset) {
  const scene::Scene scene = scene::load_scene(preset);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  const photons::RunPlan plan = spectral::make_plan(preset, scene, bvh);
  static const TestKernels kernels("");
  const tracing::SceneBuffers buffers = tracing::upload(kernels.context(), scene, bvh, plan.tables);
  std::uint64_t planned = 0;
  for (const plan::PlannedBuffer& row : tracing::planned_buffers(scene, bvh, plan.tables)) {
    planned += row.bytes;
    EXPECT_TRUE(std::ranges::any_of(plan.buffers, [&](const plan::PlannedBuffer& buffer) {
      return buffer.name == row.name && buffer.bytes == row.bytes && !buffer.on_host;
    })) << row.name;
  }
  EXPECT_EQ(planned, buffers.geometry.bytes() + buffers.tables.bytes());
}

TEST(SceneBuffers, AreWhatThePlanSays) {
  preset::Preset p = empty_preset();
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["glass"].dispersion = {.type = preset::Dispersion::Type::cauchy, .coefficients = {1.5, 0.01}};
  p.scene.materials["white"] = white(0.5);
  p.scene.objects = {object("ball", {}, "glass"), object("floor", quad(10, 10), "white", at({0, -2, 0}))};
  p.scene.lights = {{.position = {0, 5, 0}}};
  expect_planned(p);
  p.scene.environment = preset::Environment{.type = preset::Environment::Type::constant, .lights = true};
  expect_planned(p);
}

} // namespace nephroid::scene_buffers_test
