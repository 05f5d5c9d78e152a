// SPDX-License-Identifier: Apache-2.0
// Runs with smoothed caustics beside the same runs without: the same power, less error.
#include "spectral/sight.h"
#include "tests/support/loaded_scenes.h"
#include "tests/support/render.h"

namespace nephroid::smoothing_test {

using Smooth = spectral::Settings::Smoothing;

preset::Preset ball(int passes, Smooth smoothing)
{
  preset::Preset p = test::ball_over_floor();
  p.scene.camera.position = {0, 2, 4};
  p.scene.camera.target = {0, -2, 0};
  p.scene.camera.resolution = {64, 64};
  p.scene.lights[0].position = {1, 3, 1};
  p.scene.objects[0].normals = preset::Object::Normals::smooth; // facets would cast a pattern of dots
  p.scene.objects[1].transform.translate = {0, -2, 0};          // beyond the focus: a disc, not a spot
  spectral::settings(p).photons_per_pass = 4096;
  spectral::settings(p).direct = false;
  spectral::settings(p).smoothing = smoothing;
  p.stop.passes = passes;
  return p;
}

double sum(const std::vector<float>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

double mean_distance(const std::vector<float>& a, const std::vector<float>& b)
{
  double all = 0;
  for (std::size_t i = 0; i < a.size(); ++i) all += std::abs(static_cast<double>(a[i]) - b[i]);
  return all / static_cast<double>(a.size());
}

plan::Pass smoothing_pass(const preset::Preset& preset)
{
  const scene::Scene scene = scene::load_scene(preset);
  for (const plan::Pass& pass : spectral::make_plan(preset, scene, scene::build_bvh(scene.geometry)).passes)
    if (pass.name == "smoothing") return pass;
  throw std::runtime_error("the plan does not tell of smoothing");
}

TEST(SmoothedRun, has_the_power_of_the_plain_one_and_less_error)
{
  const job::Snapshot plain = test::render(ball(4, Smooth::off)), smooth = test::render(ball(4, Smooth::on)),
                      truth = test::render(ball(256, Smooth::off));
  const std::vector<float>& caustic = test::layer(smooth, "caustic").rgb;
  const double power = sum(test::layer(plain, "caustic").rgb);
  ASSERT_GT(power, 0);
  EXPECT_NEAR(sum(caustic), power, 1e-4 * power);
  EXPECT_LT(mean_distance(caustic, truth.picture->rgb), 0.8 * mean_distance(plain.picture->rgb, truth.picture->rgb));
  // The run's own estimate sees less noise, too.
  const auto squares = [](const std::vector<float>& v) { return std::inner_product(v.begin(), v.end(), v.begin(), 0.0); };
  EXPECT_LT(squares(smooth.picture->error_draw), squares(plain.picture->error_draw));
}

/// A ball's light on a table and, past the table's edge, on a floor below, seen through a pane of glass that leans.
preset::Preset behind_a_window(Smooth smoothing)
{
  preset::Preset p = ball(4, smoothing);
  p.scene.camera.position = {0, 2, 4};
  p.scene.camera.target = {-0.3, -2.4, 0.2};
  p.scene.camera.fov_deg = 24; // the ball itself is not in the picture
  p.scene.lights[0].position = {0.5, 3, -0.5};
  p.scene.objects[1].transform.scale = {4, 1, 8};
  p.scene.objects[1].transform.translate = {-2.33, -2, 0};
  p.scene.objects.push_back(test::shape_object("lower", preset::Shape::Type::quad, "wall"));
  p.scene.objects.back().transform.scale = {12, 1, 12};
  p.scene.objects.back().transform.translate = {0, -2.8, 0};
  p.scene.objects.push_back(test::shape_object("window", preset::Shape::Type::box, "glass"));
  p.scene.objects.back().transform.scale = {4, 0.1, 4};
  p.scene.objects.back().transform.rotate_deg = {45, 0, 0};
  p.scene.objects.back().transform.translate = {0, 0.94, 2.94};
  spectral::settings(p).photons_per_pass = 2048;
  return p;
}

TEST(SmoothedRun, keeps_light_on_its_side_of_an_edge_behind_a_window)
{
  const preset::Preset p = behind_a_window(Smooth::on);
  const job::Snapshot plain = test::render(behind_a_window(Smooth::off)), smooth = test::render(p);
  const scene::Scene scene = scene::load_scene(p);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  constexpr std::size_t table = 1, lower = 2, window = 3;
  std::vector<double> before(scene.objects.size()), after(scene.objects.size());
  for (std::size_t i = 0; i < 64 * 64; ++i) {
    const spectral::Sight sight = spectral::look_through_pixel(scene, bvh, static_cast<int>(i) % 64, static_cast<int>(i) / 64);
    ASSERT_EQ(sight.first.object, static_cast<int>(window));
    const auto object = static_cast<std::size_t>(sight.last.object);
    ASSERT_TRUE(object == table || object == lower);
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) before[object] += plain.picture->rgb[c], after[object] += smooth.picture->rgb[c];
  }
  ASSERT_GT(before[lower], 0.01);
  ASSERT_GT(before[table], before[lower]);
  EXPECT_NEAR(after[table], before[table], 1e-5 * before[table]);
  EXPECT_NEAR(after[lower], before[lower], 1e-5 * before[lower]);
  EXPECT_GT(mean_distance(smooth.picture->rgb, plain.picture->rgb) * static_cast<double>(plain.picture->rgb.size()),
            0.2 * (before[table] + before[lower]));
}

TEST(SmoothedRun, leaves_other_layers_alone)
{
  preset::Preset plain = ball(2, Smooth::off), smooth = ball(2, Smooth::on);
  spectral::settings(plain).direct = spectral::settings(smooth).direct = true;
  const job::Snapshot a = test::render(plain), b = test::render(smooth);
  EXPECT_EQ(test::layer(a, "direct").rgb, test::layer(b, "direct").rgb);
  EXPECT_NE(test::layer(a, "caustic").rgb, test::layer(b, "caustic").rgb);
}

TEST(SmoothedRun, needs_halves_and_splats_and_says_so)
{
  EXPECT_TRUE(smoothing_pass(ball(2, Smooth::on)).runs);
  EXPECT_FALSE(smoothing_pass(ball(2, Smooth::off)).runs);
  EXPECT_FALSE(smoothing_pass(ball(1, Smooth::on)).runs);
  preset::Preset whole = ball(2, Smooth::on), sppm = ball(2, Smooth::on);
  whole.measure.estimate = false;
  EXPECT_FALSE(smoothing_pass(whole).runs);
  EXPECT_EQ(smoothing_pass(whole).field, "/measure/estimate");
  EXPECT_TRUE(smoothing_pass(whole).run_value);
  spectral::settings(sppm).estimator = spectral::Settings::Estimator::sppm;
  EXPECT_FALSE(smoothing_pass(sppm).runs);
  EXPECT_EQ(smoothing_pass(sppm).field, "");
}

} // namespace nephroid::smoothing_test
