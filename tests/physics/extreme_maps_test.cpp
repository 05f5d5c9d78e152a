// SPDX-License-Identifier: Apache-2.0
// Extreme settings of photon maps: radii from a millionth of a pixel to 10^9 scenes, alpha next to 0 and to 1, single photons, single
// pixels. docs/notebook/extremes.md has the table.
#include "tests/support/extreme_waves.h"

namespace nephroid::extreme_maps_test {

using Estimator = spectral::Settings::Estimator;
using Effort = spectral::Settings::Effort;

/// Splats, which have no radius.
const std::vector<Estimate>& truth()
{
  static const std::vector<Estimate> colour = colour_by_passes(caustic_of_ball());
  return colour;
}

/// Whole clusters: with jitter a turn in sppm has one wavelength, and a short run is of few colours.
preset::Preset gathered(int passes = 2)
{
  preset::Preset p = caustic_of_ball();
  spectral::settings(p).estimator = Estimator::sppm;
  spectral::settings(p).threshold_deg = 2;
  spectral::settings(p).jitter = false;
  p.stop.passes = passes;
  return p;
}

Outcome gathers_the_same(const preset::Preset& p, int runs = 24) { return same_colour(colour_by_runs(p, runs), truth(), 0.01); }

/// The scene `factor` times as large in its own unit of length, with its power.
preset::Preset scaled(preset::Preset p, double factor)
{
  const auto grow = [factor](preset::Vec3& v) { v = {factor * v[0], factor * v[1], factor * v[2]}; };
  grow(p.scene.camera.position), grow(p.scene.camera.target), grow(p.scene.lights[0].position);
  for (preset::Object& o : p.scene.objects) grow(o.transform.scale), grow(o.transform.translate);
  return p;
}

std::string notes_of(const preset::Preset& p)
{
  const scene::Scene scene = scene::load_scene(p);
  std::string lines;
  for (const std::string& note : spectral::make_plan(p, scene, scene::build_bvh(scene.geometry)).notes)
    lines += (lines.empty() ? "" : " / ") + note;
  return lines;
}

/// The plan notes exactly this line, and the largest number of the picture is finite and at most that share of the caustic's.
Outcome noted(const preset::Preset& p, const std::string& line, double most)
{
  const job::Snapshot snapshot = render(p);
  double largest = 0;
  for (const float v : snapshot.picture->rgb) largest = std::max(largest, std::isfinite(v) ? std::abs(double(v)) : INFINITY);
  return both(says(notes_of(p), line), at_most(largest / truth()[1].mean, most));
}

const std::vector<Extreme> extremes = {
    {"RadiusTiny", "sppm, radius 1e-9 of the scene", "no photon is met",
     [] {
       preset::Preset p = scaled(gathered(), 1000);
       spectral::settings(p).sppm.radius = 1e-6;
       return noted(p,
                    "spectral.sppm.radius: 1e-06 units are 4.42e-09 pixels: hardly a photon lies so near, and caustics are black but for "
                    "rare bright dots; choose about 452, two pixels, or leave it out",
                    0);
     }},
    {"RadiusHuge", "sppm, radius 1e9 of the scene", "its light is spread over 1e18 scenes",
     [] {
       preset::Preset p = scaled(gathered(1), 0.01);
       spectral::settings(p).sppm.radius = 1e7;
       spectral::settings(p).photons_per_pass = 1 << 10;
       return noted(p,
                    "spectral.sppm.radius: 10000000 units are 4.42e+09 pixels: caustics are blurred away, and gathering is slow; choose "
                    "about 0.00452, two pixels, or leave it out",
                    1e-9);
     }},
    {"RadiusZero", "sppm.radius 0", "refused",
     [] {
       return refused_json(R"("spectral":{"sppm":{"radius":0}})",
                           "/spectral/sppm/radius: is 0; expected a number from 1e-06 to 10000000 length units");
     }},
    {"AlphaTiny", "sppm, alpha 1e-9", "noted: the estimate is right in the mean, but rare bright dots",
     [] {
       preset::Preset p = gathered();
       spectral::settings(p).sppm.alpha = 1e-9;
       return says(notes_of(p), "spectral.sppm.alpha: 1e-09 shrinks a radius from 2 to 6.32e-05 pixels at its first photons, and hardly "
                                "another one lies so near: caustics grow darker from pass to pass; choose 0.667 or so");
     }},
    {"AlphaSmall", "sppm, alpha 0.01", "the caustic of splats",
     [] {
       preset::Preset p = gathered();
       spectral::settings(p).sppm.alpha = 0.01;
       return gathers_the_same(p);
     }},
    {"AlphaAlmostOne", "sppm, alpha 1 - 1e-9: the radius stays", "the same",
     [] {
       preset::Preset p = gathered();
       spectral::settings(p).sppm.alpha = 1 - 1e-9;
       return gathers_the_same(p);
     }},
    {"AlphaOne", "sppm.alpha 1", "refused",
     [] {
       return refused_json(R"("spectral":{"sppm":{"alpha":1}})", "/spectral/sppm/alpha: is 1; expected a number above 0 and below 1");
     }},
    {"OneCluster", "sppm, importance, one cluster", "the caustic of splats",
     [] {
       preset::Preset p = gathered(8);
       spectral::settings(p).threshold_deg = 89.9;
       spectral::settings(p).effort = Effort::importance;
       return gathers_the_same(p);
     }},
    {"OneClusterAtRandom", "sppm, a random cluster of one", "the same",
     [] {
       preset::Preset p = gathered(8);
       spectral::settings(p).threshold_deg = 89.9;
       spectral::settings(p).effort = Effort::random;
       return gathers_the_same(p);
     }},
    {"OnePhoton", "sppm, one photon a pass, 1024 passes", "the same",
     [] {
       preset::Preset p = gathered(1024);
       spectral::settings(p).threshold_deg = 89.9;
       spectral::settings(p).photons_per_pass = 1;
       return gathers_the_same(p);
     }},
    {"OnePixel", "sppm, a picture of one pixel", "the same",
     [] {
       preset::Preset p = gathered(256);
       p.scene.camera.resolution = {1, 1};
       spectral::settings(p).sppm.radius = 0.2;
       spectral::settings(p).photons_per_pass = 1 << 9;
       return gathers_the_same(p);
     }},
};

class Maps : public testing::TestWithParam<Extreme> {};
TEST_P(Maps, IsRight) { expect_right(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Extremes, Maps, testing::ValuesIn(extremes), [](const auto& tested) { return tested.param.name; });

} // namespace nephroid::extreme_maps_test
