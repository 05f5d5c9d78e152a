// SPDX-License-Identifier: Apache-2.0
// Which wavelengths meet in a photon map. A photon and the path from the eye that gathers it have to be of one
// wavelength, or a prism before the camera shows one line's light where another line's image is.
#include "optics/fresnel.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::map_bands_test {

using Estimator = photons::Settings::Estimator;
using Effort = photons::Settings::Effort;

struct Line {
  double nm, n, share; ///< the prism's n; of the lamp's power
  double sppm_scatter; ///< standard deviation over 30 seeds of what sppm makes of radiance(), over it; the means were
                       ///< .999 and 1.001
};
constexpr std::array<Line, 2> lines{{{450, 2.0, 0.2, 0.0203}, {620, 1.3, 0.8, 0.0097}}};

constexpr double apex = 22 * degree, side = 0.1, screen_x = -1;

struct Place {
  double x, z;
};

/// Where a path meets the prism, on the middle of its right side, and where it leaves, on the left side: the way
/// between is at right angles to the right side.
Place entry() { return {side / 2 * std::sin(apex / 2), 0}; }
Place normal_of_entry() { return {std::cos(apex / 2), std::sin(apex / 2)}; }
Place exit_place() {
  const double inside = side / 2 * std::tan(apex);
  return {entry().x - inside * normal_of_entry().x, entry().z - inside * normal_of_entry().z};
}

/// Where the plane x = screen_x is met by a path of that index of refraction. It meets the left side at the apex angle
/// and leaves at b, sin(b) = n sin(apex), from the normal (-cos(apex / 2), 0, sin(apex / 2)) towards the base,
/// (-sin(apex / 2), 0, -cos(apex / 2)).
double landing_z(double n) {
  const double b = std::asin(n * std::sin(apex));
  const double along_x = -std::cos(apex / 2) * std::cos(b) - std::sin(apex / 2) * std::sin(b),
               along_z = std::sin(apex / 2) * std::cos(b) - std::cos(apex / 2) * std::sin(b);
  const Place from = exit_place();
  return from.z + (screen_x - from.x) * along_z / along_x;
}

/// The radiance of the stripe in a line over the lamp's irradiance in all: the light falls at 45 degrees, so E = cos(45
/// degrees) share, and two faces of the prism let it through.
double radiance(const Line& line) {
  return std::cos(45 * degree) * line.share / M_PI * (1 - optics::fresnel_reflectance(1, 1, line.n)) *
         (1 - optics::fresnel_reflectance(std::cos(apex), line.n, 1));
}

/// A white stripe along the prism's edge, where light of `line` lands that comes through the prism from the camera.
/// Before it stands a pane of n = 1, which makes a caustic of parallel light of two lines, and the camera looks at its
/// image in the one.
preset::Preset stripe_through_a_prism(const Line& line) {
  preset::Preset p = empty_preset(32);
  preset::Material& flint = p.scene.materials["flint"] = glass(1);
  flint.dispersion.type = preset::Dispersion::Type::table;
  flint.dispersion.table = {{lines[0].nm, lines[0].n}, {lines[1].nm, lines[1].n}};
  p.scene.materials["nothing"] = glass(1);
  p.scene.materials["white"] = white();
  preset::Shape prism;
  prism.type = preset::Shape::Type::prism;
  prism.apex_deg = apex / degree;
  prism.side = prism.height = side;
  const double z = landing_z(line.n);
  p.scene.objects = {object("prism", prism, "flint"),
                     object("pane", box(0.005, 0.1, 0.15), "nothing", at({screen_x + 0.01, 0, z})),
                     object("stripe", quad(0.2, 0.1), "white", at({screen_x, 0, z}, {0, 0, 90}))};
  preset::Light& lamp = p.scene.lights.emplace_back(parallel_light({-1, -1, 0}));
  lamp.spectrum.table = {{lines[0].nm, lines[0].share}, {lines[1].nm, lines[1].share}};
  p.scene.camera.position = {entry().x + normal_of_entry().x, 0, entry().z + normal_of_entry().z};
  p.scene.camera.target = {entry().x, 0, entry().z};
  p.scene.camera.fov_deg = 0.5;
  spectral::settings(p).threshold_deg = 80; // one cluster
  spectral::settings(p).sppm.radius = 0.015;
  spectral::settings(p).photons_per_pass = 1 << 13;
  p.stop.passes = 192;
  return p;
}

/// The mean radiance of the layer "caustic" in each line, from X and Z.
std::vector<double> radiance_in_lines(const job::Snapshot& snapshot) {
  const std::vector<float>& rgb = layer(snapshot, "caustic").rgb;
  optics::Colour mean{};
  for (std::size_t i = 0; i < rgb.size(); ++i) mean[i % 3] += rgb[i] / (static_cast<double>(rgb.size()) / 3);
  const optics::Colour xyz = optics::linear_srgb_to_xyz(mean);
  const auto colour = [](const Line& l) { return optics::to_xyz(optics::light_lines(line(l.nm).table)); };
  const optics::Colour a = colour(lines[0]), b = colour(lines[1]);
  const double determinant = a[0] * b[2] - b[0] * a[2];
  return {(xyz[0] * b[2] - b[0] * xyz[2]) / determinant, (a[0] * xyz[2] - xyz[0] * a[2]) / determinant};
}

struct Way {
  const char* name;
  photons::Settings::Estimator estimator;
  photons::Settings::Method method;
};

class MapBands : public testing::TestWithParam<Way> {};

// Each image has the light of its own line, and nothing of the other, whose paths pass the stripe by. One wavelength a
// path and pass, or a cluster for each, of which the eye's paths are allocated unequal parts. All of a pass of sppm has
// one wavelength, by steps of the golden ratio, and the radius shrinks from pass to pass: they are not independent, and
// how far its figure may be off is known from other seeds.
TEST_P(MapBands, AStripeHasOneImageForEachLine) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    preset::Preset p = stripe_through_a_prism(lines[i]);
    spectral::settings(p).estimator = GetParam().estimator;
    spectral::settings(p).method = GetParam().method;
    const std::vector<Estimate> figures = render_passes(p, radiance_in_lines);
    const double truth = radiance(lines[i]);
    const bool hang_together = GetParam().estimator == photons::Settings::Estimator::sppm;
    const double error =
        hang_together ? tolerance_over_seeds(lines[i].sppm_scatter, 30) : tolerance(figures[i]) / truth + 1e-3;
    expect_truth(
        fmt::format("stripe through a prism, {} nm, {}: radiance over its truth", lines[i].nm, GetParam().name),
        figures[i].mean / truth, 1, error);
    EXPECT_LE(error, 0.13) << "such a check would see too little";
    EXPECT_NEAR(figures[1 - i].mean / truth, 0, 1e-4) << "light of " << lines[1 - i].nm << " nm";
  }
}

INSTANTIATE_TEST_SUITE_P(
    , MapBands,
    testing::Values(Way{"points", photons::Settings::Estimator::points, photons::Settings::Method::optimal},
                    Way{"sppm", photons::Settings::Estimator::sppm, photons::Settings::Method::optimal},
                    Way{"clusters", photons::Settings::Estimator::points, photons::Settings::Method::brute_force}),
    [](const auto& way) { return std::string(way.param.name); });

// Runs with photon maps: the same bits however they are cut or resumed, iterations by importance, energy, and what the
// plan says.

/// A ball of dispersive glass that absorbs, and a mirror behind it, in view; two lamps.
preset::Preset glass_in_view(Estimator estimator, Effort effort = Effort::power) {
  preset::Preset p = empty_preset(20);
  p.scene.materials = {{"floor", white(0.8)}, {"mirror", check::mirror(0.6)}, {"glass", glass(1.6)}};
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["glass"].dispersion.file = "N-SF66";
  p.unit = preset::Preset::Unit::cm;
  p.scene.objects = {object("ball", check::ball(0.5), "glass", at({0, 0.7, 0})), object("floor", quad(8, 8), "floor"),
                     object("mirror", quad(3, 2), "mirror", at({0, 1, -1.2}, {90, 0, 0}))};
  p.scene.lights = {{.power_w = 2, .position = {1, 3, 1}},
                    {.spectrum = {.illuminant = "A"}, .power_w = 2, .position = {-1, 2, 1}}};
  p.scene.camera.position = {0, 1.5, 4};
  p.scene.camera.target = {0, 0.5, 0};
  spectral::settings(p).direct = true;
  spectral::settings(p).estimator = estimator;
  spectral::settings(p).effort = effort;
  spectral::settings(p).threshold_deg = 3;
  spectral::settings(p).photons_per_pass = 1 << 15;
  p.stop.passes = 3;
  return p;
}

struct Case {
  const char* name;
  Estimator estimator;
  Effort effort;
  bool jitter;
};

class MapRuns : public testing::TestWithParam<Case> {
protected:
  static preset::Preset preset() {
    preset::Preset p = glass_in_view(GetParam().estimator, GetParam().effort);
    spectral::settings(p).jitter = GetParam().jitter;
    spectral::settings(p).low_discrepancy = GetParam().jitter;
    return p;
  }
};

// Steps are cut by the clock, so two runs differ in that; and a run that is saved after any step and loaded elsewhere
// ends with the bits of one that never was.
TEST_P(MapRuns, ResumedAnywhereTheyEndWithTheSameBits) {
  const auto make = [p = preset()] { return job_as_it_is(p); };
  const job::Snapshot truth = render(*make());

  auto job = make();
  int steps = 0;
  for (; !job->finished(); ++steps) {
    job->advance();
    if (steps % 3 != 1) continue;
    const std::vector<std::byte> saved = test::saved(*job);
    const job::Snapshot before = job->snapshot();
    job = make();
    test::load(*job, saved);
    EXPECT_EQ(job->snapshot().picture->rgb, before.picture->rgb) << "at step " << steps;
  }
  EXPECT_GT(steps, 12);
  const job::Snapshot resumed = job->snapshot();
  EXPECT_EQ(resumed.picture->rgb, truth.picture->rgb);
  EXPECT_EQ(resumed.picture->error_draw, truth.picture->error_draw);
  EXPECT_EQ(photons::energy_of(resumed).emitted_w, photons::energy_of(truth).emitted_w);
  EXPECT_EQ(truth.picture->error_draw.empty(), GetParam().estimator == Estimator::sppm);
  EXPECT_GT(*std::max_element(truth.picture->rgb.begin(), truth.picture->rgb.end()), 0);
  EXPECT_THROW(test::load(*make(), std::vector<std::byte>(100)), Error);
}

// Whatever the estimator and however the clusters take turns: the same power leaves the lamps towards the ball and the
// mirror.
TEST_P(MapRuns, SendTheLampsPower) {
  preset::Preset splat = glass_in_view(Estimator::splat);
  preset::Preset p = preset();
  spectral::settings(splat).direct = spectral::settings(p).direct = false;
  const photons::EnergyBalance truth = photons::energy_of(render(splat)), energy = photons::energy_of(render(p));
  // The same spheres are aimed at, so every photon carries what is sent there, but for places where spheres overlap.
  EXPECT_NEAR((energy.deposited_w + energy.missed_w + energy.absorbed_w + energy.escaped_w + energy.lost_w) /
                  energy.emitted_w,
              1, 1e-6);
  EXPECT_EQ(energy.refused_contributions, 0u);
  if (GetParam().effort == Effort::random || GetParam().jitter)
    return; // what a pass stands for changes from pass to pass
  EXPECT_NEAR(energy.emitted_w / truth.emitted_w, 1, 0.03);
  EXPECT_NEAR(energy.deposited_w / truth.deposited_w, 1, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Estimators, MapRuns,
                         testing::Values(Case{"points", Estimator::points, Effort::power, false},
                                         Case{"jittered", Estimator::points, Effort::power, true},
                                         Case{"sppm", Estimator::sppm, Effort::importance, false},
                                         Case{"tiles", Estimator::tiles, Effort::power, true},
                                         Case{"random", Estimator::sppm, Effort::random, false}),
                         [](const auto& c) { return std::string(c.param.name); });

plan::Decision pass_of(const plan::Plan& plan, const std::string& name) {
  for (const plan::Decision& pass : plan.decisions)
    if (pass.name == name) return pass;
  return {};
}

std::uint64_t bytes_of(const plan::Plan& plan, const std::string& name) {
  for (const plan::PlannedBuffer& buffer : plan.buffers)
    if (buffer.name == name) return buffer.bytes;
  return 0;
}

TEST(MapPlan, SaysWhichEstimatorRunsAndWhy) {
  const plan::Plan points = plan_of(glass_in_view(Estimator::points)), splat = plan_of(glass_in_view(Estimator::splat)),
                   sppm = plan_of(glass_in_view(Estimator::sppm));
  EXPECT_TRUE(pass_of(points, "photons").runs && pass_of(points, "light on receivers").runs &&
              pass_of(points, "error estimate").runs);
  EXPECT_TRUE(pass_of(splat, "photons").runs && !pass_of(splat, "light on receivers").runs);
  EXPECT_THAT(pass_of(splat, "light on receivers").reason, testing::HasSubstr("left out"));
  EXPECT_TRUE(!pass_of(sppm, "photons").runs && pass_of(sppm, "photon maps").runs &&
              !pass_of(sppm, "error estimate").runs);
  preset::Preset away = glass_in_view(Estimator::points);
  away.scene.camera.target = {0, 1.5, 8};
  EXPECT_FALSE(pass_of(plan_of(away), "light on receivers").runs);
  away.scene.camera.position = {0, 0.7, 0}; // inside the ball
  EXPECT_TRUE(pass_of(plan_of(away), "light on receivers").runs);
}

TEST(MapPlan, SaysWhereARadiusLosesTheCaustics) {
  // Pixels cover some 0.1 units, and the scene is 8 units across.
  const auto notes = [](double radius, Estimator estimator) {
    preset::Preset p = glass_in_view(estimator);
    spectral::settings(p).sppm.radius = radius;
    std::vector<std::string> all = plan_of(p).notes;
    std::erase_if(all,
                  [](const std::string& note) { return !note.starts_with("spectral."); }); // N-SF66 starts at 390 nm
    return all;
  };
  EXPECT_THAT(notes(1e7, Estimator::sppm),
              testing::ElementsAre(testing::AllOf(testing::StartsWith("spectral.sppm.radius: 10000000 units are "),
                                                  testing::HasSubstr("blurred away"))));
  EXPECT_THAT(notes(1e-6, Estimator::sppm),
              testing::ElementsAre(testing::AllOf(testing::StartsWith("spectral.sppm.radius: 1e-06 units are "),
                                                  testing::HasSubstr("hardly a photon"))));
  for (const double usual : {0.03, 0.1, 0.5}) EXPECT_THAT(notes(usual, Estimator::sppm), testing::IsEmpty()) << usual;
  EXPECT_THAT(notes(0.1, Estimator::points), testing::ElementsAre(testing::HasSubstr("only sppm gathers")));
}

TEST(MapPlan, SppmTakesTwentyBytesForEachPixelInEachCluster) {
  preset::Preset p = glass_in_view(Estimator::sppm);
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  EXPECT_EQ(bytes_of(plan_of(p), "statistics of pixels"), 401u * 400 * 20);
  spectral::settings(p).effort = Effort::random;
  EXPECT_EQ(bytes_of(plan_of(p), "statistics of pixels"), 400u * 20);
}

} // namespace nephroid::map_bands_test
