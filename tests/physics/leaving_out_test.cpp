// SPDX-License-Identifier: Apache-2.0
// Leaving out what a scene does not need changes no picture: a run that leaves out all it can against one with the
// general kernels and with this omission turned back on; and it is not made in scenes that come close to not needing
// it.
#include "lights/lights.h"
#include "spectral/engine.h"
#include "tests/support/leaving_out_scenes.h"
#include "tests/support/passes.h"

namespace nephroid::leaving_out_test {

plan::Decision pass_of(const preset::Preset& p, std::string name, const LeaveOut& leave_out = {}) {
  std::replace(name.begin(), name.end(), '_', ' ');
  const scene::Scene scene = scene::load_scene(p);
  for (const plan::Decision& pass :
       spectral::make_plan(p, scene, scene::build_bvh(scene.geometry), leave_out).decisions)
    if (pass.name == name) return pass;
  return {"", false, "no pass " + name, "", false};
}

/// Luminance of the layer "caustic" in 4 x 4 blocks of pixels, and the power that came down.
std::vector<double> caustic_blocks(const job::Snapshot& snapshot) {
  const std::vector<float>& rgb = layer(snapshot, "caustic").rgb;
  const int size = snapshot.picture->width, block = size / 4;
  std::vector<double> figures(17);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      figures[static_cast<std::size_t>(4 * (row / block) + column / block)] +=
          rgb[3 * static_cast<std::size_t>(row * size + column) + 1];
  figures[16] = photons::energy_of(snapshot).deposited_w;
  return figures;
}

class LeavingOut : public testing::TestWithParam<Omission> {};

TEST_P(LeavingOut, ThePlanSaysWhyAndWhatTurnsItBackOn) {
  const Omission& o = GetParam();
  const plan::Decision out = pass_of(o.scene, o.key), in = pass_of(o.scene, o.key, all_but(o));
  EXPECT_FALSE(out.runs);
  EXPECT_GT(out.reason.size(), 10u) << out.reason;
  EXPECT_EQ(out.field, "/leave_out");
  EXPECT_FALSE(out.run_value);
  EXPECT_TRUE(in.runs) << in.reason;
  EXPECT_THAT(in.reason, testing::HasSubstr("but leave_out is false"));
}

// Where the same photons fly, the sums are the same bits. Where others do, both pictures have the same expectation: of
// the worst of 17 figures, the chance to differ as much, Sidak-corrected, may not be below 1e-9.
TEST_P(LeavingOut, ThePictureIsTheSame) {
  const Omission& o = GetParam();
  const auto with = [&](const preset::Preset& p) { return general_job(plain(p), all_but(o), shared_context()); };
  if (o.same_bits) {
    const job::Snapshot out = render(*specialised_job_of(o.scene, LeaveOut{})), in = render(*with(o.scene));
    EXPECT_EQ(out.picture->rgb, in.picture->rgb);
    EXPECT_EQ(photons::energy_of(out).deposited_w, photons::energy_of(in).deposited_w);
    return;
  }
  preset::Preset other_seed = o.scene;
  other_seed.seed = 1000;
  const auto blocks = [](job::Job& job) { return caustic_blocks(job.snapshot()); };
  const std::vector<Estimate> out = step_passes(*specialised_job_of(o.scene, LeaveOut{}), blocks),
                              in = step_passes(*with(other_seed), blocks);
  double smallest = 1, out_variance = 0, in_variance = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Estimate difference{out[i].mean - in[i].mean, out[i].variance + in[i].variance,
                              std::min(out[i].degrees, in[i].degrees)};
    if (difference.variance > 0) smallest = std::min(smallest, p_value(difference, 0));
    if (i < 16) out_variance += out[i].variance, in_variance += in[i].variance;
  }
  EXPECT_GT(out[16].mean, 50 * out[16].error()); // enough photons to tell
  EXPECT_GT(sidak(smallest, 17), false_alarm);
  // What another way of sending photons is for.
  EXPECT_LT(out_variance, in_variance);
  RecordProperty("variance_ratio", std::to_string(in_variance / out_variance));
}

INSTANTIATE_TEST_SUITE_P(Omissions, LeavingOut, testing::ValuesIn(omissions()),
                         [](const testing::TestParamInfo<Omission>& parameter) { return parameter.param.key; });

/// Scenes that only just need a thing: the plan may not leave it out.
TEST(NotLeftOut, WhereTheSceneNeedsIt) {
  preset::Preset p = ball_scene();
  p.scene.objects[0].shape->type = preset::Shape::Type::cylinder; // a ball has no normals to interpolate
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  EXPECT_TRUE(pass_of(p, "smooth_normals").runs);
  EXPECT_TRUE(pass_of(p, "bending").runs && pass_of(p, "photons").runs && pass_of(p, "direct").runs);
  EXPECT_TRUE(pass_of(line_light_scene(), "mirrors").runs);
  EXPECT_TRUE(pass_of(line_light_scene(), "attenuation").runs);

  p = ball_scene(); // n = 1 but near one end of the spectrum
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::table;
  p.scene.materials["glass"].dispersion.table = {{380, 1.001}, {381, 1}, {780, 1}};
  EXPECT_TRUE(pass_of(p, "bending").runs);

  p = ball_scene();
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["glass"].dispersion.file = "N-SF66"; // absorbs
  EXPECT_TRUE(pass_of(p, "attenuation").runs);
  p.scene.materials["glass"].absorption = false;
  EXPECT_FALSE(pass_of(p, "attenuation").runs);

  p = ball_scene();
  using Type = preset::Light::Type;
  for (const Type type : {Type::spot, Type::directional, Type::area, Type::mesh}) {
    EXPECT_FALSE(pass_of(p, "light_types").runs);
    p.scene.lights.push_back(p.scene.lights[0]);
    p.scene.lights.back().type = type;
    if (type == Type::mesh) p.scene.lights.back().object = p.scene.objects[0].name;
  }
  EXPECT_FALSE(pass_of(p, "light_types").runs);
  p.scene.environment.emplace().type = preset::Environment::Type::constant;
  EXPECT_FALSE(pass_of(p, "light_types").runs);
  p.scene.environment->lights = true;
  EXPECT_TRUE(pass_of(p, "light_types").runs);
}

/// Two lights have the wavelengths of both.
TEST(NotLeftOut, WavelengthsOfAnyLight) {
  preset::Preset p = line_light_scene();
  p.scene.lights.push_back(p.scene.lights[0]);
  p.scene.lights[1].spectrum = line(500);
  EXPECT_THAT(pass_of(p, "unlit_wavelengths").reason, testing::HasSubstr("397 of the 401"));
  p.scene.lights[1].power_w = 0;
  EXPECT_THAT(pass_of(p, "unlit_wavelengths").reason, testing::HasSubstr("398 of the 401"));
  EXPECT_THAT(pass_of(p, "dark_lights").reason, testing::HasSubstr("1 of 2 lights"));
  p.scene.lights[0].power_w = 0; // nothing to see, nothing to send
  EXPECT_FALSE(pass_of(p, "photons").runs);
  EXPECT_FALSE(pass_of(p, "direct").runs);
  EXPECT_EQ(render(p).picture->rgb, std::vector<float>(3 * 24 * 24, 0.0f));
}

TEST(NotLeftOut, TheLookBackWhereSomethingMayBlockIt) {
  EXPECT_TRUE(pass_of(ball_scene(), "occlusion").runs);
  preset::Preset p = floor_scene();
  EXPECT_FALSE(pass_of(p, "occlusion").runs);
  p.scene.camera.fov_deg =
      44; // the upper edge of the view is 0.2 degrees above the horizon, the ball 0.1 / 2.5 = 2.3 degrees
  EXPECT_FALSE(pass_of(p, "occlusion").runs);
  p.scene.camera.fov_deg = 52; // 4.2 degrees above
  EXPECT_TRUE(pass_of(p, "occlusion").runs);

  // Walls of a room, seen from inside: none stands before another. Moved towards the eye, the wall hides a part of the
  // floor.
  p = floor_scene();
  p.scene.objects.push_back(object("wall", quad(8, 8), "white", at({0, 4, -4}, {90, 0, 0})));
  EXPECT_FALSE(pass_of(p, "occlusion").runs);
  p.scene.objects.back().transform.translate[2] = -1;
  EXPECT_TRUE(pass_of(p, "occlusion").runs);
  // What is flat but for one corner may stand before itself.
  p = floor_scene();
  p.scene.objects[1].shape = box(8, 0.01, 8);
  EXPECT_TRUE(pass_of(p, "occlusion").runs);
}

// From (0, 3, 0) the ball "beside" of radius 0.9 at (3, 1, 0) is seen from 56.31 degrees off the axis to its tangent at
// 56.31 - asin(0.9 / sqrt(13)) = 41.86 degrees.
TEST(NotLeftOut, WhatASpotsConeGrazes) {
  EXPECT_EQ(pass_of(spot_scene(41.5), "unreached_targets").runs, false);
  EXPECT_THAT(pass_of(spot_scene(41.5), "unreached_targets").reason, testing::HasSubstr("outside of a spot's cone"));
  EXPECT_THAT(pass_of(spot_scene(42), "unreached_targets").reason, testing::HasSubstr("no pass"));
}

TEST(NotLeftOut, WhatAnAreaLightsPlaneCuts) {
  scene::Light light;
  light.type = preset::Light::Type::area;
  light.direction = {0, -1, 0};
  EXPECT_TRUE(lights::model(light).reaches(light, {{5, -1, 0}, 0.5f}));
  EXPECT_TRUE(lights::model(light).reaches(light, {{5, 0.49f, 0}, 0.5f}));
  EXPECT_FALSE(lights::model(light).reaches(light, {{5, 0.51f, 0}, 0.5f}));
  light.type = preset::Light::Type::spot;
  light.cos_half_angle = -1; // the whole sphere
  EXPECT_TRUE(lights::model(light).reaches(light, {{0, 9, 0}, 0.5f}));
  light.cos_half_angle = 0.999999;
  EXPECT_FALSE(lights::model(light).reaches(light, {{0, 9, 0}, 0.5f}));
  EXPECT_TRUE(lights::model(light).reaches(light, {{0, 0.3f, 0}, 0.5f})); // the light is inside
  light.type = preset::Light::Type::directional;
  EXPECT_TRUE(lights::model(light).reaches(light, {{0, 9, 0}, 0.5f}));
  light.type = preset::Light::Type::point;
  EXPECT_TRUE(lights::model(light).reaches(light, {{0, 9, 0}, 0.5f}));
}

} // namespace nephroid::leaving_out_test
