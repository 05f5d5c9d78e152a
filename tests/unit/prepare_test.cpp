// SPDX-License-Identifier: Apache-2.0
// A prepared run that another edit may share: the tree of the same triangles is not built again.
#include "preset/read.h"
#include "run/prepare.h"
#include "tests/support/test.h"

namespace nephroid::prepare_test {

TEST(Prepare, LendsTheTreeWhereTheTrianglesAreTheSame) {
  using run::prepare;
  const auto preset = preset::read_preset("spectral/plate");
  const auto first = prepare(preset);
  auto seen_from_above = preset;
  seen_from_above.scene.camera.position = {0, 30, 0.1};
  const auto second = prepare(seen_from_above, &first);
  EXPECT_EQ(second.loaded->bvh, first.loaded->bvh);
  const auto fresh = prepare(seen_from_above);
  EXPECT_NE(fresh.loaded->bvh, first.loaded->bvh);
  EXPECT_EQ(second.loaded->scene.camera.position, fresh.loaded->scene.camera.position) << "the camera is the new one";
  EXPECT_NE(second.loaded->scene.camera.position, first.loaded->scene.camera.position);

  auto brighter = preset;
  brighter.scene.lights[0].irradiance_w_m2 *= 2;
  EXPECT_EQ(prepare(brighter, &first).loaded->bvh, first.loaded->bvh);
  EXPECT_EQ(prepare(brighter, &first).loaded->scene.lights[0].irradiance_w_m2,
            brighter.scene.lights[0].irradiance_w_m2);

  auto turned = preset;
  turned.scene.objects[0].transform.rotate_deg = {0, 10, 0};
  EXPECT_NE(prepare(turned, &first).loaded->bvh, first.loaded->bvh);
}

} // namespace nephroid::prepare_test
