// SPDX-License-Identifier: Apache-2.0
// The layer "background" against closed forms: exact colours, which way up and round a map is, radiance that glass
// keeps, Beer's law in a plate, and Snell's law in a prism that takes white light apart.
#include "image/image.h"
#include "optics/fresnel.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

#include <numeric>

namespace nephroid::background_test {

preset::Preset with_constant(const preset::Vec3& colour, int resolution, double radiance = 1) {
  preset::Preset p = empty_preset(resolution);
  spectral::settings(p).caustic = false;
  spectral::settings(p).pixel_samples = 4;
  p.stop.passes = 4;
  p.scene.environment.emplace();
  p.scene.environment->type = preset::Environment::Type::constant;
  p.scene.environment->colour = colour;
  p.scene.environment->radiance = radiance;
  return p;
}

preset::Preset with_map(const std::filesystem::path& folder, int width, int height, const std::vector<float>& rgb,
                        int resolution) {
  preset::Preset p = with_constant({0, 0, 0}, resolution);
  p.scene.environment->type = preset::Environment::Type::file;
  p.scene.environment->file = (folder / "map.exr").string();
  image::write_exr(p.scene.environment->file, {width, height, {"R", "G", "B"}, rgb, {}});
  return p;
}

void look_along(preset::Camera& camera, const preset::Vec3& direction, double fov_deg) {
  camera.position = {0, 0, 0};
  camera.target = direction;
  camera.up = std::abs(direction[1]) > 0.9 ? preset::Vec3{0, 0, -1} : preset::Vec3{0, 1, 0};
  camera.fov_deg = fov_deg;
}

glm::dvec3 mean_of(const std::vector<float>& rgb) {
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < rgb.size(); i += 3) sum += glm::dvec3(rgb[i], rgb[i + 1], rgb[i + 2]);
  return sum / (static_cast<double>(rgb.size()) / 3);
}

/// The direction of a latitude-longitude map's place, u to the right and v down, both 0..1: the contract's words as a
/// formula.
glm::dvec3 direction_at(double u, double v) {
  const double azimuth = 2 * M_PI * (u - 0.5), zenith = M_PI * v; // azimuth from -z to +x
  return {std::sin(zenith) * std::sin(azimuth), std::cos(zenith), -std::sin(zenith) * std::cos(azimuth)};
}

TEST(Background, AConstantIsExactlyItsColour) {
  preset::Preset p = with_constant({0.2, 0.5, 0.9}, 8, 3);
  p.white = 2;
  const job::Snapshot snapshot = render(p);
  const std::vector<float>& rgb = layer(snapshot, "background").rgb;
  double worst = 0;
  for (std::size_t i = 0; i < rgb.size(); ++i)
    worst = std::max(worst, std::abs(rgb[i] / (p.scene.environment->colour[i % 3] * 1.5) - 1));
  expect_truth("background, one colour seen directly: worst channel", worst, 0, 2e-6);
  EXPECT_EQ(snapshot.picture->rgb, rgb); // the only layer
}

// A map whose colour is the direction itself, 0.5 + 0.5 d: so each of six directions, and any other, says what it
// should look like. Bilinear steps of 360 / 64 degrees are off by (2 pi / 64)^2 / 8 / 2 = 6e-4 at most.
TEST(Background, MapsAreTheRightWayUpAndRound) {
  constexpr int width = 64, height = 32;
  std::vector<float> map;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const glm::dvec3 d = 0.5 + 0.5 * direction_at((column + 0.5) / width, (row + 0.5) / height);
      for (int c = 0; c < 3; ++c) map.push_back(static_cast<float>(d[c]));
    }
  TemporaryFolder temporary;
  preset::Preset p = with_map(temporary.path(), width, height, map, 2);
  double worst = 0;
  for (const double turn : {0.0, 30.0})
    for (const preset::Vec3& way :
         {preset::Vec3{0, 0, -1}, {1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, 2, 3}, {-0.01, 0, 1}}) {
      p.scene.environment->rotate_deg = turn;
      look_along(p.scene.camera, way, 0.1);
      // The surroundings turned by +30 degrees about +y, so that what was in front is to the left: d there was R(-30) d
      // before.
      const glm::dvec3 d = glm::normalize(glm::dvec3(way[0], way[1], way[2]));
      const double c = std::cos(turn * degree), s = std::sin(turn * degree);
      const glm::dvec3 before(c * d.x - s * d.z, d.y, s * d.x + c * d.z);
      const glm::dvec3 figure = mean_of(layer(render(p), "background").rgb);
      for (int i = 0; i < 3 && std::abs(d.y) < 1; ++i)
        worst = std::max(worst, std::abs(figure[i] - (0.5 + 0.5 * before[i])));
      EXPECT_LT(glm::length(figure - (0.5 + 0.5 * before)), std::abs(d.y) == 1 ? 0.025 : 2e-3)
          << way[0] << " " << way[1] << " " << way[2] << " turned " << turn;
    }
  expect_truth("background, directions of a map: worst channel", worst, 0, 1.5e-3);
  // A quarter of a turn to the left brings what was on the right (+x, red) to the front.
  p.scene.environment->rotate_deg = 90;
  look_along(p.scene.camera, {0, 0, -1}, 0.1);
  EXPECT_GT(mean_of(layer(render(p), "background").rgb).x, 0.99);
}

// Four columns of unlike colours: at 180 degrees, between the last and the first, the picture is as smooth as
// everywhere.
TEST(Background, TheSeamIsBilinearToo) {
  constexpr int width = 4, height = 2, pixels = 48;
  const std::vector<float> map{1, 0, 0, 0, 2, 0, 0, 0, 3, 4, 0, 1, 0, 0, 5, 3, 1, 0, 0, 2, 2, 1, 0, 0};
  TemporaryFolder temporary;
  preset::Preset p = with_map(temporary.path(), width, height, map, pixels);
  spectral::settings(p).pixel_samples = p.stop.passes.emplace(16);
  look_along(p.scene.camera, {0, 0, 1}, 100);
  const job::Snapshot snapshot = render(p);
  const std::vector<float>& rgb = layer(snapshot, "background").rgb;
  double worst = 0;
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column) {
      const double t = std::tan(50 * degree), right = (2 * (column + 0.5) / pixels - 1) * t,
                   up = (1 - 2 * (row + 0.5) / pixels) * t;
      const glm::dvec3 d = glm::normalize(glm::dvec3(-right, up, 1)); // looking along +z, -x is on the right
      const double x = (std::atan2(d.x, -d.z) / (2 * M_PI) + 0.5) * width - 0.5;
      const double y = std::clamp(std::acos(d.y) / M_PI * height - 0.5, 0.0, height - 1.0);
      const auto texel = [&](double r, double c, int channel) {
        const int around = (static_cast<int>(c) + width) % width;
        return double(map[static_cast<std::size_t>(3 * (static_cast<int>(r) * width + around) + channel)]);
      };
      const double left = std::floor(x), top = std::floor(y), next = std::min(top + 1, height - 1.0);
      for (int c = 0; c < 3; ++c) {
        const double upper = texel(top, left, c) + (x - left) * (texel(top, left + 1, c) - texel(top, left, c));
        const double lower = texel(next, left, c) + (x - left) * (texel(next, left + 1, c) - texel(next, left, c));
        const double truth = upper + (y - top) * (lower - upper);
        worst = std::max(worst, std::abs(rgb[static_cast<std::size_t>(3 * (row * pixels + column) + c)] - truth));
      }
    }
  // A pixel is up to 4 degrees wide, a texel 90: colours change by 5 * 4 / 90 in a pixel at most, of which 16 samples
  // know the mean to a 14th; at a kink the middle is another eighth off.
  expect_truth("background, bilinear around the seam: worst pixel", worst, 0,
               5 * 4 / 90.0 * (6.2 / std::sqrt(12 * 16.0) + 0.125));
}

// Where the same radiance is everywhere, nothing that takes no light can be seen: each path ends at the environment, by
// whatever way. That is the same with the number of every sample, so there is no noise unless glass takes colours
// apart.
struct Thing {
  const char* name;
  std::function<void(preset::Preset&)> place;
  bool disperses;
  double lost; ///< the share of light that total reflection keeps for ever, at most
};

class BackgroundFurnace : public testing::TestWithParam<Thing> {};

TEST_P(BackgroundFurnace, GlassCannotBeSeen) {
  constexpr int pixels = 12;
  preset::Preset p = with_constant({0.7, 0.4, 0.2}, pixels);
  p.scene.camera.position = {0.2, 0.3, 2};
  p.scene.camera.fov_deg = 25;
  spectral::settings(p).max_surfaces = 1000;
  spectral::settings(p).pixel_samples = p.stop.passes.emplace(GetParam().disperses ? 256 : 64);
  GetParam().place(p);
  const std::vector<Estimate> estimates = render_passes(p, [&](const job::Snapshot& snapshot) {
    const std::vector<float>& rgb = layer(snapshot, "background").rgb;
    const glm::dvec3 mean = mean_of(rgb);
    return std::vector<double>{mean.x, mean.y, mean.z};
  });
  const std::string name = std::string("background, white furnace, ") + GetParam().name;
  for (std::size_t c = 0; c < 3; ++c) {
    const double truth = p.scene.environment->colour[c];
    const double slack = 2e-6 + GetParam().lost + (GetParam().disperses ? tolerance(estimates[c]) / truth : 0);
    expect_truth(name + ": channel " + std::to_string(c), estimates[c].mean / truth, 1, slack);
    EXPECT_LT(slack, 0.05);
  }
}

preset::Material shipped_glass(const std::string& file) {
  preset::Material m = glass(1);
  m.dispersion.type = preset::Dispersion::Type::file;
  m.dispersion.file = file;
  m.absorption = false;
  return m;
}

INSTANTIATE_TEST_SUITE_P(
    Things, BackgroundFurnace,
    testing::Values(
        Thing{"glass_ball",
              [](preset::Preset& p) {
                p.scene.materials["glass"] = glass(1.5);
                p.scene.objects = {object("ball", check::ball(0.4), "glass")};
                p.scene.objects[0].normals = preset::Object::Normals::smooth;
              },
              false, 0},
        Thing{"nested_and_mirror",
              [](preset::Preset& p) {
                p.scene.materials = {{"glass", glass(1.5)}, {"dense", glass(2.4)}, {"mirror", check::mirror(1)}};
                p.scene.objects = {object("ball", check::ball(0.4), "glass"),
                                   object("core", check::ball(0.15), "dense"),
                                   object("mirror", quad(0.5, 0.5), "mirror", at({0.3, 0, -0.6}, {70, 10, 0}))};
                p.scene.objects[1].priority = 1;
                for (preset::Object& o : p.scene.objects) o.normals = preset::Object::Normals::smooth;
              },
              false, 1e-3},
        Thing{"dispersing_ball",
              [](preset::Preset& p) {
                p.scene.materials["glass"] = shipped_glass("N-SF66");
                p.scene.objects = {object("ball", check::ball(0.4), "glass")};
              },
              true, 1e-4}),
    [](const testing::TestParamInfo<Thing>& parameter) { return std::string(parameter.param.name); });

// Inside of glass radiance is n^2 times that outside (Nicodemus 1963).
TEST(Background, AnEyeInGlassSeesMore) {
  preset::Preset p = with_constant({0.3, 0.6, 0.1}, 8);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.objects = {object("ball", check::ball(1), "glass")};
  look_along(p.scene.camera, {0.3, 0.2, -1}, 60);
  const std::vector<float> rgb = layer(render(p), "background").rgb;
  double worst = 0;
  for (std::size_t i = 0; i < rgb.size(); ++i)
    worst = std::max(worst, std::abs(rgb[i] / (2.25 * p.scene.environment->colour[i % 3]) - 1));
  expect_truth("background, from inside glass, worst channel / n^2", worst, 0, 3e-6);
}

// A plate of absorbing glass, straight on: with R the reflectance of a face and a = exp(-4 pi k t / lambda), sums over
// all ways give
//   transmitted (1 - R)^2 a / (1 - R^2 a^2), reflected R + R (1 - R)^2 a^2 / (1 - R^2 a^2),
// for each wavelength of the colour's spectrum.
TEST(Background, APlateAbsorbsByBeersLaw) {
  constexpr double n = 1.5, k = 2e-5, thickness = 0.005;
  TemporaryFolder temporary;
  preset::Preset p = with_constant({0.2, 0.9, 0.4}, 4);
  p.scene.materials["glass"] = glass(n);
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["glass"].dispersion.file = write_constant_nk(temporary.path() / "dark.yml", n, k);
  p.scene.objects = {object("plate", box(2, 2, thickness), "glass", at({0, 0, -0.5}))};
  look_along(p.scene.camera, {0, 0, -1}, 1);
  spectral::settings(p).pixel_samples = p.stop.passes.emplace(256);
  const double r = std::pow((n - 1) / (n + 1), 2);
  optics::Spectrum left{};
  for (std::size_t w = 0; w < left.size(); ++w) {
    const double a = std::exp(-4 * M_PI * k * thickness / (optics::wavelength_nm(static_cast<int>(w)) * 1e-9));
    const double passes = (1 - r) * (1 - r) * a / (1 - r * r * a * a),
                 returns = r + r * (1 - r) * (1 - r) * a * a / (1 - r * r * a * a);
    for (std::size_t c = 0; c < 3; ++c)
      left[w] += p.scene.environment->colour[c] * optics::primary_spectra()[c][w] * (passes + returns);
  }
  const optics::Colour truth = optics::xyz_to_linear_srgb(optics::to_xyz(left));
  const std::vector<Estimate> estimates = render_passes(p, [&](const job::Snapshot& snapshot) {
    const glm::dvec3 mean = mean_of(layer(snapshot, "background").rgb);
    return std::vector<double>{mean.x, mean.y, mean.z};
  });
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LT(truth[c], 0.5 * p.scene.environment->colour[c]);
    expect_truth("background, absorbing plate: channel " + std::to_string(c), estimates[c].mean, truth[c],
                 tolerance(estimates[c]) + 1e-4);
  }
}

// A prism as a monochromator: the environment is black but for a slit, and the eye looks through the prism at it. By
// Snell's law only some wavelengths come from the slit, and what is seen is their part of white times what two faces
// let through.
TEST(Background, APrismTakesWhiteApart) {
  constexpr int width = 7200; // .05 degrees a texel
  constexpr double apex = 60 * degree;
  TemporaryFolder temporary;
  preset::Preset p = with_constant({0, 0, 0}, 4);
  p.scene.materials["glass"] = shipped_glass("N-SF11");
  preset::Shape prism;
  prism.type = preset::Shape::Type::prism;
  prism.apex_deg = 60;
  p.scene.objects = {object("prism", prism, "glass")};
  p.scene.materials["black"] = white(0);
  const optics::Spectrum n = scene::load_scene(p).materials[1].n;
  ASSERT_GT(n[0], 1.8);

  // The eye looks in the plane of the prism's triangle at an incidence of 60 degrees; its faces' outward normals are at
  // +-30 degrees off the x axis towards the apex, +z.
  const double incidence = 60 * degree;
  const glm::dvec3 first_normal(-std::cos(apex / 2), 0, std::sin(apex / 2)),
      second_normal(std::cos(apex / 2), 0, std::sin(apex / 2));
  const glm::dvec3 along(std::sin(apex / 2), 0, std::cos(apex / 2)); // of the first face, towards the apex
  const glm::dvec3 look = -std::cos(incidence) * first_normal + std::sin(incidence) * along;
  std::vector<double> azimuth(n.size(), 0.0), through(n.size(), 0.0);
  for (std::size_t w = 0; w < n.size(); ++w) {
    const double inside = std::asin(std::sin(incidence) / n[w]), at_second = apex - inside,
                 sine = n[w] * std::sin(at_second);
    ASSERT_LT(sine, 1);
    through[w] = (1 - optics::fresnel_reflectance(std::cos(incidence), 1, n[w])) *
                 (1 - optics::fresnel_reflectance(std::cos(at_second), n[w], 1));
    // Leaves at asin(sine) from the second normal, on the side away from the apex.
    const glm::dvec3 away(std::sin(apex / 2), 0, -std::cos(apex / 2));
    const glm::dvec3 out = std::sqrt(1 - sine * sine) * second_normal + sine * away;
    azimuth[w] = std::atan2(out.x, -out.z);
  }
  const auto column_of = [&](double a) { return (a / (2 * M_PI) + 0.5) * width; };
  // The slit takes 520 to 600 nm, roughly: from texel to texel.
  const int first = static_cast<int>(std::min(column_of(azimuth[140]), column_of(azimuth[220])));
  const int last = static_cast<int>(std::max(column_of(azimuth[140]), column_of(azimuth[220])));
  ASSERT_GT(last - first, 5);
  std::vector<float> map(3 * width, 0.0f);
  for (int column = first; column <= last; ++column)
    for (std::size_t c = 0; c < 3; ++c) map[3 * static_cast<std::size_t>(column) + c] = 1;
  p.scene.environment->type = preset::Environment::Type::file;
  p.scene.environment->file = (temporary.path() / "slit.exr").string();
  image::write_exr(p.scene.environment->file, {width, 1, {"R", "G", "B"}, map, {}});

  optics::Spectrum seen{};
  for (std::size_t w = 0; w < n.size(); ++w) {
    const double x = column_of(azimuth[w]) - 0.5, left = std::floor(x);
    const auto lit = [&](double column) { return column >= first && column <= last ? 1.0 : 0.0; };
    const double slit = lit(left) + (x - left) * (lit(left + 1) - lit(left));
    for (const optics::Spectrum& primary : optics::primary_spectra()) seen[w] += primary[w] * slit * through[w];
  }
  const optics::Colour truth = optics::to_xyz(seen);
  // The middle of the first face is where the eye's axis meets the prism.
  const glm::dvec3 middle = 0.2 * first_normal;
  const glm::dvec3 eye = middle - 3.0 * look;
  p.scene.camera.position = {eye.x, eye.y, eye.z};
  p.scene.camera.target = {middle.x, middle.y, middle.z};
  p.scene.camera.fov_deg = 0.01;
  spectral::settings(p).pixel_samples = p.stop.passes.emplace(256);
  const std::vector<Estimate> estimates = render_passes(p, [&](const job::Snapshot& snapshot) {
    const glm::dvec3 mean = mean_of(layer(snapshot, "background").rgb);
    const optics::Colour xyz = optics::linear_srgb_to_xyz({mean.x, mean.y, mean.z});
    return std::vector<double>(xyz.begin(), xyz.end());
  });
  for (std::size_t c = 0; c < 2; ++c) // there is little Z
    expect_truth(std::string("background, prism and slit: ") + "XYZ"[c], estimates[c].mean / truth[c], 1,
                 tolerance(estimates[c]) / truth[c] + 0.005);
}

/// A mirror ball far away, under a map that is black but for one texel at the horizon. Seen from afar the ball's disc
/// sends every direction equally much of its area: R^2 / 4 a steradian, for its curvature takes the angle from the axis
/// to twice that. The texel's colour is bilinear, so its flux is radiance * (2 pi / columns) (pi / rows) but for
/// (pi / rows)^2 / 12 of it.
struct SunInABall {
  static constexpr int columns = 256, rows = 128, pixels = 8;
  static constexpr double radius = 0.2, distance = 2000 * radius, side = 2.2 * radius, radiance = 1e5;
  static constexpr double truth = radius * radius / 4 * radiance * (2 * M_PI / columns) * (M_PI / rows) / (side * side);
  TemporaryFolder temporary;
  preset::Preset preset = [this] {
    std::vector<float> map(std::size_t{3} * columns * rows, 0.0f);
    for (std::size_t c = 0; c < 3; ++c) map[3 * (rows / 2 * columns + columns / 8) + c] = radiance;
    preset::Preset p = with_map(temporary.path(), columns, rows, map, pixels);
    p.scene.materials["mirror"] = check::mirror(1);
    p.scene.objects = {object("ball", check::ball(radius), "mirror")};
    p.scene.objects[0].normals = preset::Object::Normals::smooth;
    p.scene.camera.position = {0, 0, distance};
    p.scene.camera.target = {0, 0, 0};
    p.scene.camera.fov_deg = 2 * std::atan(side / 2 / distance) / degree;
    spectral::settings(p).direct = false;
    return p;
  }();

  /// The pictures' means of as many seeds, of so many samples a pixel. lit: the map is a light, so that it has peaks.
  std::vector<double> means(bool lit, int samples, int seeds) {
    preset.scene.environment->lights = lit;
    spectral::settings(preset).pixel_samples = preset.stop.passes.emplace(samples);
    std::vector<double> result;
    for (int seed = 1; seed <= seeds; ++seed) {
      preset.seed = static_cast<std::uint64_t>(seed);
      result.push_back(mean_of(layer(render(preset), "background").rgb).y);
    }
    return result;
  }
};

double mean_of_seeds(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation_of_seeds(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += std::pow(v - mean_of_seeds(values), 2);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

// The texel fills 5e-5 of the ball's disc. Pieces find it at once, and in the end with its whole light.
TEST(Background, ASunInABallIsItsShareOfAPiece) {
  SunInABall sun;
  constexpr int seeds = 24;
  const std::vector<double> points = sun.means(false, 16, seeds), pieces = sun.means(true, 16, seeds),
                            many = sun.means(true, 1024, 8);
  const double few_error = deviation_of_seeds(pieces) / sun.truth, many_error = deviation_of_seeds(many) / sun.truth;
  EXPECT_LT(few_error, 0.1 * deviation_of_seeds(points) / sun.truth);
  expect_truth("background, a sun in a mirror ball", mean_of_seeds(many) / sun.truth, 1,
               sigmas * many_error / std::sqrt(8) + 0.01);
}

TEST(Background, IsLeftOutWhereThereIsNothingToSee) {
  const auto pass = [](const preset::Preset& p) {
    for (const plan::Decision& candidate : plan_of(p).decisions)
      if (candidate.name == "background") return candidate;
    return plan::Decision{};
  };
  preset::Preset p = with_constant({1, 1, 1}, 4);
  EXPECT_TRUE(pass(p).runs);
  EXPECT_EQ(pass(p).field, "/spectral/background");
  spectral::settings(p).background = false;
  EXPECT_FALSE(pass(p).runs);
  EXPECT_TRUE(render(p).picture->layers.empty());
  p = with_constant({0, 0, 0}, 4);
  EXPECT_FALSE(pass(p).runs);
  p.scene.environment.reset();
  EXPECT_FALSE(pass(p).runs);
}

} // namespace nephroid::background_test
