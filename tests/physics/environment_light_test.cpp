// SPDX-License-Identifier: Apache-2.0
// The environment as a light: colours and irradiance of a map against sums over its texels, one hot texel against
// directional light of the same irradiance, the balance of energy, and runs that go on with the same bits. White
// furnaces under a sky: white_furnace_test.cpp.
#include "image/image.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::environment_light_test {

constexpr int pixels = 24, group = 4, groups = pixels / group;
const Screen screen{{0, -1, 0}, 3, pixels};

/// A white floor from above, and a ball over it.
preset::Preset floor_and_ball(const preset::Material& material) {
  preset::Preset p = empty_preset();
  p.scene.materials["white"] = white();
  p.scene.materials["ball"] = material;
  p.scene.objects = {object("floor", quad(60, 60), "white", at(screen.centre)),
                     object("ball", check::ball(0.5), "ball")};
  p.scene.objects[1].normals = preset::Object::Normals::smooth;
  screen.fill(p.scene.camera, 0.4); // below the ball
  spectral::settings(p).direct = true;
  spectral::settings(p).background = false;
  spectral::settings(p).photons_per_pass = 1 << 16;
  spectral::settings(p).pixel_samples = p.stop.passes.emplace(32);
  return p;
}

preset::Environment sky_of(const preset::Vec3& colour, double radiance) {
  preset::Environment sky;
  sky.type = preset::Environment::Type::constant;
  sky.colour = colour;
  sky.radiance = radiance;
  sky.lights = true;
  return sky;
}

preset::Environment map_of(const TemporaryFolder& folder, int width, const std::vector<float>& rgb) {
  preset::Environment sky;
  sky.file = (folder.path() / "map.exr").string();
  sky.lights = true;
  image::write_exr(sky.file, {width, static_cast<int>(rgb.size() / 3) / width, {"R", "G", "B"}, rgb, {}});
  return sky;
}

/// Of layers, each channel's means over squares of the floor, the layers added up.
std::vector<double> squares_of(const job::Snapshot& snapshot, const std::vector<const char*>& layers) {
  std::vector<double> sums(3 * groups * groups, 0.0);
  for (const char* name : layers) {
    const std::vector<float>& rgb = layer(snapshot, name).rgb;
    for (std::size_t i = 0; i < screen.count(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        sums[3 * (i / pixels / group * groups + i % pixels / group) + c] +=
            static_cast<double>(rgb[3 * i + c]) / (group * group);
  }
  return sums;
}

glm::dvec3 mean_of_squares(const std::vector<double>& squares) {
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < squares.size(); ++i) sum[static_cast<int>(i % 3)] += squares[i];
  return sum / (static_cast<double>(squares.size()) / 3);
}

// pi L on a floor that sees half of an even sky, whose colour it has.
TEST(EnvironmentLight, AFloorUnderOneColourHasIt) {
  preset::Preset p = floor_and_ball(glass(1.5));
  p.scene.objects.pop_back();
  p.scene.materials["white"].reflectance.value = 0.5;
  p.scene.environment = sky_of({0.7, 0.4, 0.02}, 3);
  p.white = 2;
  const std::vector<Estimate> estimates =
      render_passes(p, [](const job::Snapshot& snapshot) { return squares_of(snapshot, {"direct"}); });
  double worst = 1;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const double truth = 0.5 * p.scene.environment->colour[i % 3] * 3 / 2;
    EXPECT_LT(tolerance(estimates[i]) / truth, 0.25);
    worst = std::min(worst, p_value(estimates[i], truth, 1e-5 * truth));
  }
  EXPECT_GT(sidak(worst, static_cast<double>(estimates.size())), false_alarm);
}

/// The floor's colour under a map: irradiance over pi by the midpoint rule in every texel.
glm::dvec3 colour_under(const std::vector<float>& rgb, int width) {
  constexpr int places = 32;
  const int height = static_cast<int>(rgb.size() / 3) / width;
  glm::dvec3 sum(0);
  for (int row = 0; row < height * places; ++row)
    for (int column = 0; column < width;
         ++column) { // the cosine to +y does not hang on the azimuth, nor on how the map is turned
      const double zenith = M_PI * (row + 0.5) / (height * places);
      const double weight =
          std::max(std::cos(zenith), 0.0) * std::sin(zenith) * M_PI / (height * places) * 2 * M_PI / width;
      const float* texel = rgb.data() + 3 * (static_cast<std::size_t>(row / places) * static_cast<std::size_t>(width) +
                                             static_cast<std::size_t>(column));
      sum += weight * glm::dvec3(texel[0], texel[1], texel[2]);
    }
  return sum / M_PI;
}

/// Saturated colours, black texels, a yellow sun.
std::vector<float> coloured_map(int width) {
  std::vector<float> rgb;
  for (int i = 0; i < width * width / 2; ++i) {
    const int kind = (i * 7 + i / width * 3) % 5;
    for (int c = 0; c < 3; ++c) rgb.push_back(kind == c ? 1.5f : kind == 3 ? 0.0f : 0.2f);
  }
  for (int c = 0; c < 3; ++c) rgb[static_cast<std::size_t>(3 * (width + 3) + c)] = static_cast<float>(200 - 60 * c);
  return rgb;
}

// A ball of n = 1 bends nothing, so what it hides is sent through it: direct and caustic light together are those of
// the bare floor.
TEST(EnvironmentLight, ThroughNothingAMapLightsTheFloorAllTheSame) {
  TemporaryFolder folder;
  constexpr int width = 16;
  const std::vector<float> rgb = coloured_map(width);
  preset::Preset p = floor_and_ball(glass(1));
  p.scene.environment = map_of(folder, width, rgb);
  p.scene.environment->rotate_deg = 40;
  glm::dvec3 direct(0);
  const std::vector<Estimate> estimates = render_passes(p, [&](const job::Snapshot& snapshot) {
    direct = mean_of_squares(squares_of(snapshot, {"direct"}));
    std::vector<double> figures = squares_of(snapshot, {"direct", "caustic"});
    const glm::dvec3 mean = mean_of_squares(figures);
    for (int c = 0; c < 3; ++c) figures.push_back(mean[c]);
    return figures;
  });
  const glm::dvec3 truth = colour_under(rgb, width);
  EXPECT_LT(direct.y, 0.97 * truth.y);
  double worst = 1;
  for (std::size_t i = 0; i < estimates.size(); ++i)
    worst = std::min(worst, p_value(estimates[i], truth[static_cast<int>(i % 3)], 1e-4 * truth.y));
  EXPECT_GT(sidak(worst, static_cast<double>(estimates.size())), false_alarm);
  for (std::size_t c = 0; c < 3; ++c) {
    const Estimate& mean = estimates[estimates.size() - 3 + c];
    const double of = truth[static_cast<int>(c)];
    expect_truth("environment light through n = 1, channel " + std::to_string(c), mean.mean / of, 1,
                 tolerance(mean) / of + 1e-3);
    EXPECT_LT(tolerance(mean) / of, 0.05);
  }
}

/// Luminance of the squares, of one layer.
std::vector<double> luminance_of(const std::vector<double>& rgb) {
  std::vector<double> y;
  for (std::size_t i = 0; i < rgb.size(); i += 3)
    y.push_back(optics::linear_srgb_to_xyz({rgb[i], rgb[i + 1], rgb[i + 2]})[1]);
  return y;
}

class HotTexel : public testing::TestWithParam<double> {};

// A texel of 0.18 degrees is a sun: the floor has the direct and the caustic light of parallel light from there. Turned
// with the map.
TEST_P(HotTexel, IsDirectionalLight) {
  constexpr int width = 2048, row = 300, column = 900;
  constexpr double zenith = M_PI * (row + 0.5) / (width / 2);
  constexpr double steradians = 2 * M_PI / width * 4 * M_PI / width / 2; // of a texel on the equator
  TemporaryFolder folder;
  std::vector<float> rgb(3 * width * width / 2, 0.0f);
  for (std::size_t c = 0; c < 3; ++c) rgb[3 * (row * width + column) + c] = 1e5f;
  preset::Preset sky = floor_and_ball(glass(1.5));
  sky.scene.environment = map_of(folder, width, rgb);
  sky.scene.environment->rotate_deg = GetParam();
  preset::Preset sun = floor_and_ball(glass(1.5));
  const double azimuth = 2 * M_PI * ((column + 0.5) / width - 0.5) - GetParam() * degree;
  sun.scene.lights = {
      parallel_light({-std::sin(zenith) * std::sin(azimuth), -std::cos(zenith), std::sin(zenith) * std::cos(azimuth)})};
  // White has Y = 1 for each unit of the map.
  sun.scene.lights[0].irradiance_w_m2 =
      1e5 * steradians * std::sin(zenith) / optics::to_xyz(spectrum_of(sun.scene.lights[0]))[1];
  const std::vector<const char*> layers{"direct", "caustic"};
  const auto figures = [&](const job::Snapshot& snapshot) {
    std::vector<double> squares;
    for (const char* name : layers) {
      const std::vector<double> of_layer = luminance_of(squares_of(snapshot, {name}));
      squares.insert(squares.end(), of_layer.begin(), of_layer.end());
    }
    return squares;
  };
  const std::vector<Estimate> all_of_sky = render_passes(sky, figures), all_of_sun = render_passes(sun, figures);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto of_layer = [&](const std::vector<Estimate>& all) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(i * groups * groups);
      return std::vector<Estimate>(begin, begin + groups * groups);
    };
    const std::vector<Estimate> of_sky = of_layer(all_of_sky), of_sun = of_layer(all_of_sun);
    const auto sum = [](const std::vector<Estimate>& estimates) {
      return std::accumulate(estimates.begin(), estimates.end(), 0.0,
                             [](double s, const Estimate& e) { return s + e.mean; });
    };
    // The sun is 0.18 degrees wide: edges of the shadow and the caustic are blurred by 1 % of a square or so.
    std::vector<double> bias;
    for (const Estimate& e : of_sun) bias.push_back(0.01 * sum(of_sun) / groups / groups + 0.01 * e.mean);
    EXPECT_GT(same_expectations(of_sky, of_sun, bias), false_alarm) << layers[i];
    expect_truth(std::string("hot texel over directional light, ") + layers[i], sum(of_sky) / sum(of_sun), 1, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Turned, HotTexel, testing::Values(0.0, 130.0));

// Of a sky with a hot texel photons have the light above the mean. Each target gets pi r^2 of its flux, of all
// wavelengths that white has.
TEST(EnvironmentLight, EnergyIsAccountedFor) {
  constexpr int width = 32, row = 3;
  constexpr double hot = 1000;
  TemporaryFolder folder;
  std::vector<float> rgb(3 * width * width / 2, 1.0f);
  for (std::size_t c = 0; c < 3; ++c) rgb[3 * row * width + c] = hot;
  preset::Preset p = floor_and_ball(glass(1.5));
  p.scene.environment = map_of(folder, width, rgb);
  spectral::settings(p).direct = false;
  p.stop.passes = 2;
  const photons::EnergyBalance e = photons::energy_of(render(p));
  const double steradians = scene::texel_steradians(*scene::load_scene(p).environment, row),
               mean = 1 + (hot - 1) * steradians / (4 * M_PI);
  double watts = 0;
  for (const optics::Spectrum& primary : optics::primary_spectra())
    watts += std::accumulate(primary.begin(), primary.end(), 0.0);
  expect_truth("environment light, sent towards a ball, over its closed form",
               e.emitted_w / ((hot - mean) * steradians * p.scene.environment->radiance * watts * M_PI * 0.25), 1,
               1e-4);
  EXPECT_EQ(e.refused_contributions, 0u);
  EXPECT_GT(e.deposited_w, 0);
  EXPECT_GT(e.escaped_w, 0);
  EXPECT_NEAR((e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w) / e.emitted_w, 1, 1e-12);
}

/// Everything that a run can have with this light, on glass that disperses and absorbs.
preset::Preset whole(const TemporaryFolder& folder) {
  preset::Material flint = glass(1);
  flint.dispersion.type = preset::Dispersion::Type::file;
  flint.dispersion.file = "N-SF66.yml";
  preset::Preset p = floor_and_ball(flint);
  p.scene.environment = map_of(folder, 16, coloured_map(16));
  p.scene.lights = {parallel_light({1, -1, 0})};
  p.scene.camera.position = {0, 1, 4};
  spectral::settings(p).background = true;
  spectral::settings(p).indirect = true;
  spectral::settings(p).estimator = photons::Settings::Estimator::points;
  spectral::settings(p).effort = photons::Settings::Effort::automatic;
  spectral::settings(p).smoothing = photons::Settings::Smoothing::automatic;
  spectral::settings(p).low_discrepancy = true;
  spectral::settings(p).photons_per_pass = 1 << 12;
  spectral::settings(p).indirect_photons_per_pass = 1 << 10;
  p.stop.passes = 12;
  return p;
}

TEST(EnvironmentLight, ARunThatIsResumedHasTheSameBits) {
  TemporaryFolder folder;
  const preset::Preset p = whole(folder);
  const job::Snapshot straight = render_as_it_is(p);
  for (const int steps : {3, 29}) {
    const auto first = job_as_it_is(p);
    for (int step = 0; step < steps && !first->finished(); ++step) first->advance();
    const std::vector<std::byte> state = saved(*first);
    const auto second = job_as_it_is(p);
    EXPECT_TRUE(load(*second, state));
    EXPECT_EQ(render(*second).picture->rgb, straight.picture->rgb);
  }
}

// Photons and their numbers are the same whatever code is left out.
TEST(EnvironmentLight, GeneralKernelsMakeTheSamePicture) {
  TemporaryFolder folder;
  preset::Preset p = whole(folder);
  p.stop.passes = 3;
  tracing::LeaveOut code;
  code.light_types = code.mirrors = code.attenuation = code.smooth_normals = code.occlusion = false;
  EXPECT_EQ(render(*job_as_it_is(p, code)).picture->rgb, render_as_it_is(p).picture->rgb);
}

// It is only seen unless the preset says otherwise, and black is no light.
TEST(EnvironmentLight, IsAskedFor) {
  preset::Preset p = floor_and_ball(glass(1.5));
  p.scene.environment = sky_of({1, 1, 1}, 1);
  p.scene.environment->lights = false;
  EXPECT_FALSE(preset::Environment{}.lights);
  EXPECT_TRUE(scene::load_scene(p).lights.empty());
  const auto row = [&] {
    const auto plan = plan_of(p);
    const auto found = std::find_if(plan.decisions.begin(), plan.decisions.end(),
                                    [](const auto& pass) { return pass.name == "environment light"; });
    return found == plan.decisions.end() ? std::string("no row") : (found->runs ? "runs: " : "") + found->reason;
  };
  EXPECT_EQ(row(), "scene.environment.lights is false: it is only seen");
  p.scene.environment->lights = true;
  EXPECT_EQ(scene::load_scene(p).lights.size(), 1u);
  EXPECT_EQ(row(), "runs: one colour all around: sends photons and lights diffuse surfaces, each texel by its flux");
  p.scene.environment->radiance = 0;
  EXPECT_TRUE(scene::load_scene(p).lights.empty());
  EXPECT_EQ(row(), "the environment is black");
  p.scene.environment.reset();
  EXPECT_EQ(row(), "no row");
}

} // namespace nephroid::environment_light_test
