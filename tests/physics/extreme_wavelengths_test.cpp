// SPDX-License-Identifier: Apache-2.0
// Extreme ways to deal with wavelengths: one cluster and 401, efforts that have nothing to choose from, curves that
// jump at every nanometre, photons one at a time and lights by the thousand, streaks at grazing incidence and beside
// total reflection, layers for any light. docs/notebook/extremes.md sums it up.
#include "photons/clusters/clusters.h"
#include "photons/clusters/scene_clusters.h"
#include "spectral/settings.h"
#include "tests/support/extreme_waves.h"

namespace nephroid::extreme_wavelengths_test {

using Effort = photons::Settings::Effort;
using Method = photons::Settings::Method;

/// Every wavelength on its own, each with as many photons, without jitter, by plain random numbers.
preset::Preset one_by_one(preset::Preset p) {
  spectral::settings(p).method = Method::brute_force;
  spectral::settings(p).effort = Effort::equal;
  spectral::settings(p).jitter = spectral::settings(p).low_discrepancy = false;
  p.seed = 1000;
  return p;
}

const std::vector<Estimate>& truth() {
  static const std::vector<Estimate> colour = colour_by_passes(one_by_one(caustic_of_ball()));
  return colour;
}

Outcome is_the_ball(const preset::Preset& p) { return same_colour(colour_by_passes(p), truth()); }

/// The ball in clusters of this threshold.
preset::Preset in_clusters(double threshold_deg, Effort effort = Effort::power) {
  preset::Preset p = caustic_of_ball();
  spectral::settings(p).threshold_deg = threshold_deg;
  spectral::settings(p).effort = effort;
  return p;
}

std::size_t clusters_of(const preset::Preset& p) {
  return photons::scene_clusters(spectral::settings(p), scene::load_scene(p)).size();
}

/// So many clusters, and the right caustic.
Outcome clusters_and_colour(const preset::Preset& p, double clusters) {
  return both(exactly(static_cast<double>(clusters_of(p)), clusters), is_the_ball(p));
}

/// n is 1.5 and 1.9 in turn, from nanometre to nanometre.
preset::Preset battlements() {
  preset::Preset p = caustic_of_ball();
  preset::Dispersion& d = p.scene.materials["glass"].dispersion;
  d.type = preset::Dispersion::Type::table;
  for (int nm = 380; nm <= 780; ++nm) d.table.push_back({double(nm), nm % 2 == 0 ? 1.5 : 1.9});
  return p;
}

/// Control points that fall from 1.9 to 1.5 by ten steps, each within a nanometre.
preset::Preset stairs() {
  preset::Preset p = caustic_of_ball();
  preset::Dispersion& d = p.scene.materials["glass"].dispersion;
  d.type = preset::Dispersion::Type::points;
  for (int i = 0; i < 10; ++i) {
    d.table.push_back({380 + 40.0 * i, 1.9 - 0.04 * i});
    d.table.push_back({419 + 40.0 * i, 1.9 - 0.04 * i});
  }
  return p;
}

/// A prism in a white room. Light normal to its right side meets its left side at the critical angle of 550 nm.
preset::Preset critical_prism() {
  preset::Preset p = caustic_of_ball(32);
  const double apex = std::asin(1 / (1.5 + 0.01 / 0.3025));
  preset::Shape prism, room = box(4, 4, 4);
  prism.type = preset::Shape::Type::prism;
  prism.apex_deg = apex / degree;
  prism.side = prism.height = 0.5;
  room.inwards = true;
  p.scene.materials["white"] = white(0.5);
  p.scene.objects = {object("prism", prism, "glass"), object("room", room, "white")};
  p.scene.camera.up = {0, 1, 0};
  return p;
}

/// Sine and cosine of half the apex angle: the sides' normals are (cos, 0, sin) and (-cos, 0, sin).
std::array<double, 2> half_apex(const preset::Preset& p) {
  const double half = p.scene.objects[0].shape->apex_deg / 2 * degree;
  return {std::sin(half), std::cos(half)};
}

/// Longer waves leave the prism along its left side, shorter ones are reflected. The camera sees where what left goes.
preset::Preset leaving_at_the_critical_angle() {
  preset::Preset p = critical_prism();
  const auto [s, c] = half_apex(p);
  p.scene.lights[0] = pencil({0.5 * c, 0, 0.5 * s + 0.1}, {-c, 0, -s}, 0.01);
  p.scene.lights[0].spectrum = {};
  p.scene.camera.position = {-0.6, 0, 0};
  p.scene.camera.target = {-0.6 - s, 0, -c};
  p.scene.camera.fov_deg = 100;
  return p;
}

/// The way back: a pencil that meets the left side at 89.99 degrees, of which one photon in a thousand gets in. Of 2^22
/// some 4000 do, a mean known to 2 % (over 20 seeds of half of the photons it scattered by 2.5 %).
preset::Preset entering_at_grazing_incidence() {
  preset::Preset p = critical_prism();
  const auto [s, c] = half_apex(p);
  const double glancing = 0.01 * degree, along = std::cos(glancing), into = std::sin(glancing);
  const preset::Vec3 way{along * s + into * c, 0, along * c - into * s};
  p.scene.lights[0] = pencil({-0.25 * s - 0.1 * way[0], 0, -0.1 * way[2]}, way, 0.01);
  p.scene.lights[0].spectrum = {};
  p.scene.camera.position = {0.5, 0.8, 0};
  p.scene.camera.target = {2, 0, 2 * s / c};
  spectral::settings(p).photons_per_pass = 1 << 16;
  p.stop.passes = 64;
  spectral::settings(p).max_surfaces = 200;
  return p;
}

Outcome stretched_is_the_same(const preset::Preset& p) {
  return same_colour(colour_by_passes(p), colour_by_passes(one_by_one(p)));
}

/// Many lamps in one place that have the power of one together.
preset::Preset lamps(std::size_t count) {
  preset::Preset p = in_clusters(89.9);
  p.scene.lights[0].power_w /= static_cast<double>(count);
  p.scene.lights.assign(count, p.scene.lights[0]);
  return p;
}

/// A run with layers takes on another light; its picture is that of a run under 1 W, times its power.
Outcome relit(double own_w, double other_w, Method method, double most = 1e-6) {
  preset::Preset p = caustic_of_ball();
  spectral::settings(p).direct = spectral::settings(p).relight = true;
  spectral::settings(p).method = method;
  spectral::settings(p).threshold_deg = 89.9;
  p.stop.passes = 2;
  const job::Snapshot truth = render(p);
  p.scene.lights[0].power_w = own_w;
  const auto job = job_of(p);
  while (!job->finished()) job->advance();
  p.scene.lights[0].power_w = other_w;
  EXPECT_TRUE(job->adopt(p));
  const job::Snapshot gave = job->snapshot();
  return at_most(largest_difference(gave.picture->rgb, truth.picture->rgb, 1 / other_w), most);
}

const std::vector<Extreme> extremes = {
    {"ThresholdTiny", "threshold 1e-4 degrees", "401 wavelengths one by one",
     [] { return clusters_and_colour(in_clusters(1e-4), 401); }},
    {"ThresholdHuge", "threshold 89.9 degrees: jitter in one cluster", "the same",
     [] { return clusters_and_colour(in_clusters(89.9), 1); }},
    {"JitterOfOne", "jitter in 401 clusters of one wavelength", "the same",
     [] {
       preset::Preset p = caustic_of_ball();
       spectral::settings(p).method = Method::brute_force;
       return clusters_and_colour(p, 401);
     }},
    {"Battlements", "n(lambda) 1.5 and 1.9 in turn, from nanometre to nanometre",
     "the same, of that glass; two clusters and the jump between",
     [] {
       const preset::Preset p = battlements();
       return both(exactly(static_cast<double>(clusters_of(p)), 3), stretched_is_the_same(p));
     }},
    {"Stairs", "control points that make ten stairs", "the same, of that glass",
     [] { return stretched_is_the_same(stairs()); }},
    {"EqualOfOne", "effort equal, one cluster", "401 wavelengths one by one",
     [] { return is_the_ball(in_clusters(89.9, Effort::equal)); }},
    {"ImportanceOfOne", "effort importance, one cluster", "the same",
     [] { return is_the_ball(in_clusters(89.9, Effort::importance)); }},
    {"RadziszewskiOfOne", "effort radziszewski, one cluster", "the same",
     [] { return is_the_ball(in_clusters(89.9, Effort::radziszewski)); }},
    {"VarianceOfOne", "effort variance, one cluster", "the same",
     [] { return same_colour(colour_by_runs(in_clusters(89.9, Effort::variance), 16), truth()); }},
    {"VarianceOfOnePhoton", "effort variance, one photon a pass, one cluster, 4096 passes", "the same",
     [] {
       preset::Preset p = in_clusters(89.9, Effort::variance);
       spectral::settings(p).photons_per_pass = 1;
       p.stop.passes = 1 << 12;
       return same_colour(colour_by_runs(p, 16), truth());
     }},
    {"VarianceOfNothing", "effort variance, a camera that looks away", "black",
     [] {
       preset::Preset p = in_clusters(0.2, Effort::variance);
       p.scene.camera.target = {0, 9, 0.001};
       return black(p);
     }},
    {"ImportanceOfNothing", "effort importance, nothing reflects", "refused",
     [] {
       preset::Preset p = in_clusters(0.2, Effort::importance);
       p.scene.materials["white"] = white(0);
       return refused([&] { render(p); }, "p.json#/spectral/effort: the importance (4.15) is 0 at every wavelength: "
                                          "nothing around the caustic objects reflects "
                                          "a wavelength that the lights have; expected a light on the caustic objects "
                                          "and something around them that reflects "
                                          "it; change the scene, or choose another effort");
     }},
    {"OnePhoton", "low discrepancy, one photon a pass, 16384 passes", "401 wavelengths one by one",
     [] {
       preset::Preset p = in_clusters(89.9);
       spectral::settings(p).photons_per_pass = 1;
       p.stop.passes = 1 << 14;
       return is_the_ball(p);
     }},
    {"OnePhotonForAll", "one photon a pass, 401 clusters", "raised, and said",
     [] {
       preset::Preset p = in_clusters(1e-4);
       spectral::settings(p).photons_per_pass = 1;
       const photons::RunPlan plan = plan_of(p);
       return says(plan.notes.empty() ? "" : plan.notes[0],
                   "spectral.photons_per_pass: raised from 1 to 401, one for each cluster of each light");
     }},
    {"ThousandLamps", "low discrepancy, a thousand lamps in one place, of 1/1000 of its power each", "one lamp",
     [] { return is_the_ball(lamps(1000)); }},
    {"GrazingStretched", "differentials, light that meets a prism at 89.99 degrees", "points, one wavelength each",
     [] { return stretched_is_the_same(entering_at_grazing_incidence()); }},
    {"CriticalStretched",
     "differentials at the critical angle: half of the spectrum reflected, the rest leaving along the glass",
     "the same", [] { return stretched_is_the_same(leaving_at_the_critical_angle()); }},
    {"RelitTiny", "layers: a light of 1 W becomes one of 1e-30 W", "a run under 1 W",
     [] { return relit(1, 1e-30, Method::optimal); }},
    {"RelitHuge", "layers: a light of 1e-30 W becomes one of 1e9 W, 401 clusters", "the same",
     [] { return relit(1e-30, 1e9, Method::brute_force); }},
    {"RelitFromDark", "layers: a light of 0 W becomes one of 1 W", "the same",
     [] { return relit(0, 1, Method::optimal); }},
};

class Wavelengths : public testing::TestWithParam<Extreme> {};
TEST_P(Wavelengths, IsRight) { expect_right(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Extremes, Wavelengths, testing::ValuesIn(extremes),
                         [](const auto& tested) { return tested.param.name; });

} // namespace nephroid::extreme_wavelengths_test
