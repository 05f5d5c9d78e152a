// SPDX-License-Identifier: Apache-2.0
// Smoothed caustics on a floor that fills the lower part of the picture and a wall that fills the upper, from made
// pictures.
#include "photons/block_smoothing.h"
#include "photons/pixel_surfaces.h"
#include "photons/smoothing.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::smoothing_test {

constexpr int size = 48;

struct FloorAndWall {
  FloorAndWall() {
    preset::Preset p;
    p.source = "p.json";
    p.scene.materials["wall"];
    p.scene.objects = {shape_object("floor", preset::Shape::Type::quad, "wall", {.scale = {20, 1, 20}}),
                       shape_object("wall", preset::Shape::Type::quad, "wall", {{20, 1, 20}, {90, 0, 0}, {0, 0, -2}})};
    p.scene.camera = {.position = {0, 2, 3}, .target = {0, 0, -2}, .resolution = {size, size}};
    scene = scene::load_scene(p);
    bvh = scene::build_bvh(scene.geometry);
  }
  scene::Scene scene;
  scene::Bvh bvh;
};

/// What two halves of a film would hold of grey photons, each of worth 1 in the mean of both, `density` of them a
/// pixel.
struct Photons {
  std::vector<float> rgb, error_draw;
};

using Density = std::function<double(int x, int y)>;

Photons scatter(const Density& density, unsigned seed) {
  std::mt19937 random(seed);
  Photons photons;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double mean = density(x, y);
      int a = 0, b = 0;
      if (mean > 0) {
        std::poisson_distribution<int> half(mean / 2);
        a = half(random);
        b = half(random);
      }
      for (int c = 0; c < 3; ++c) {
        photons.rgb.push_back(static_cast<float>(a + b));
        photons.error_draw.push_back(static_cast<float>(a - b));
      }
    }
  return photons;
}

double sum(const std::vector<float>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

/// Of the pixels of rows [from, to) that are more than `margin` pixels from the picture's sides: their mean and
/// variance in a channel, R.
struct Moments {
  double mean = 0, variance = 0;
};
Moments moments(const std::vector<float>& rgb, int from, int to, int margin, std::size_t channel = 0) {
  double n = 0, s = 0, s2 = 0;
  for (int y = from; y < to; ++y)
    for (int x = margin; x < size - margin; ++x) {
      const double v = rgb[3 * static_cast<std::size_t>(y * size + x) + channel];
      n += 1, s += v, s2 += v * v;
    }
  return {s / n, s2 / n - s * s / (n * n)};
}

photons::Smoothing smoothing_of(const scene::Scene& scene, const scene::Bvh& bvh, photons::Smoothing::Spread spread,
                                photons::Smoothing::FindTexture find_texture = {}) {
  return {photons::Smoothing::view_of(scene, bvh), scene.camera.width, scene.camera.height, spread,
          std::move(find_texture)};
}

class Smoothing : public testing::Test, protected FloorAndWall {
protected:
  photons::Smoothing smoothing = smoothing_of(scene, bvh, photons::Smoothing::Spread::everywhere);
};

TEST_F(Smoothing, leaves_what_shows_a_texture_as_it_is) {
  scene.materials[0].texture = std::make_shared<scatter::Texture>();
  Photons photons = scatter([](int, int) { return 2.0; }, 1);
  const std::vector<float> before = photons.rgb;
  smoothing_of(scene, bvh, photons::Smoothing::Spread::everywhere).spread(photons.rgb, photons.error_draw);
  EXPECT_EQ(photons.rgb, before);
}

// Even light of 2 photons a pixel on stripes, two pixels wide, of 1 and 1/4, below a coat.
TEST_F(Smoothing, spreads_light_on_a_texture_without_it) {
  scene.materials[0].type = preset::Material::Type::plastic;
  scene.materials[0].texture = std::make_shared<scatter::Texture>();
  std::vector<float> texture;
  for (int i = 0; i < size * size; ++i) texture.insert(texture.end(), 3, i / 2 % 2 == 0 ? 1.0f : 0.25f);
  Photons photons = scatter([](int, int) { return 2.0; }, 1);
  const Moments before = moments(photons.rgb, size / 2 + 8, size - 8, 8);
  for (std::size_t i = 0; i < texture.size(); ++i) photons.rgb[i] *= texture[i], photons.error_draw[i] *= texture[i];
  smoothing_of(scene, bvh, photons::Smoothing::Spread::everywhere, [&] {
    return texture;
  }).spread(photons.rgb, photons.error_draw);
  for (std::size_t i = 0; i < texture.size(); ++i) photons.rgb[i] /= texture[i];
  const Moments light = moments(photons.rgb, size / 2 + 8, size - 8, 8);
  EXPECT_NEAR(light.mean, before.mean, 0.1);
  EXPECT_LT(light.variance, before.variance / 4); // not where stripes are spread, or stay in what is spread
}

TEST_F(Smoothing, keeps_power_and_draws_a_quarter_of_the_noise_and_less) {
  Photons photons = scatter([](int, int) { return 2.0; }, 1);
  const double power = sum(photons.rgb);
  const Moments before = moments(photons.rgb, size / 2 + 8, size - 8, 8);
  smoothing.spread(photons.rgb, photons.error_draw);
  EXPECT_NEAR(sum(photons.rgb), power, 1e-5 * power);
  // 16 photons lie in 8 pixels: the closest kernel of whole rings is of 9. The mean of 9 Poisson numbers of mean 2 has
  // the variance 2 / 9. Those of neighbours hang together, so it is known to some 20 % only.
  const Moments after = moments(photons.rgb, size / 2 + 8, size - 8, 8),
                error = moments(photons.error_draw, size / 2 + 8, size - 8, 8);
  EXPECT_NEAR(before.variance, 2, 0.6);
  EXPECT_LT(after.variance, before.variance / 4);
  EXPECT_NEAR(after.mean, before.mean, 0.1);
  // The draw still tells what noise there is.
  EXPECT_NEAR(error.variance, after.variance, 0.5 * after.variance);
}

TEST_F(Smoothing, keeps_power_in_pictures_of_any_size) {
  // A corner is dark, so that its kernels are the largest.
  for (const auto& [width, height] : {std::array{27, 19}, {50, 37}, {13, 10}, {1, 16}, {16, 1}}) {
    std::mt19937 random(3);
    std::poisson_distribution<int> many(20.0), few(0.05);
    std::vector<float> rgb, draw;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        auto& half = y > height - 4 ? few : many;
        const int a = half(random), b = half(random);
        rgb.insert(rgb.end(), 3, static_cast<float>(a + b));
        draw.insert(draw.end(), 3, static_cast<float>(a - b));
      }
    photons::Smoothing of(photons::Smoothing::view_of(scene, bvh), width, height,
                          photons::Smoothing::Spread::everywhere);
    const double before = sum(rgb);
    of.spread(rgb, draw);
    EXPECT_NEAR(sum(rgb) / before, 1, 1e-5) << width << " x " << height;
  }
}

// The samples of a pixel that sees the floor's far edge are few, and its middle sees nothing.
TEST_F(Smoothing, spreads_what_pixels_beside_an_object_hold_along_its_outline) {
  scene.objects.pop_back(); // the wall
  scene.geometry.triangles.resize(scene.geometry.triangles.size() / 2);
  bvh = scene::build_bvh(scene.geometry);
  int edge = 0;
  while (photons::surfaces_of_pixel(scene, bvh, scene.camera, size / 2, edge + 1).first.object < 0) ++edge;
  Photons photons = scatter([&](int, int y) { return y >= edge - 1 ? 2.0 : 0.0; }, 5);
  const double power = sum(photons.rgb);
  const Moments before = moments(photons.rgb, edge, edge + 1, 0), beyond = moments(photons.rgb, edge - 1, edge, 0);
  smoothing_of(scene, bvh, photons::Smoothing::Spread::everywhere).spread(photons.rgb, photons.error_draw);
  const Moments after = moments(photons.rgb, edge, edge + 1, 0);
  EXPECT_NEAR(after.mean, before.mean, 1e-5) << "it stays in that row";
  EXPECT_LT(after.variance, before.variance / 4);
  EXPECT_EQ(moments(photons.rgb, edge - 1, edge, 0).variance, beyond.variance) << "nothing is beside it";
  EXPECT_NEAR(sum(photons.rgb), power, 1e-5 * power);
}

// Where the wall meets the floor, or beside glass, other light is in a pixel. Its noise is none of the floor's.
TEST_F(Smoothing, leaves_light_without_noise_beside_an_outline_alone) {
  Photons photons = scatter([](int, int) { return 0.0; }, 4);
  const std::size_t row = 3 * size, outline = (size / 2 - 1) * row;
  std::fill(photons.rgb.begin(), photons.rgb.end(), 2.0f);
  std::mt19937 random(4);
  for (std::size_t i = outline; i < outline + 2 * row; ++i)
    photons.error_draw[i] = std::uniform_real_distribution<float>(-2, 2)(random);
  const std::vector<float> before = photons.rgb;
  smoothing.spread(photons.rgb, photons.error_draw);
  photons.rgb.erase(photons.rgb.begin() + outline, photons.rgb.begin() + outline + 2 * row);
  EXPECT_EQ(photons.rgb, std::vector<float>(before.begin() + 2 * row, before.end()));
}

TEST_F(Smoothing, leaves_pixels_that_hold_enough_photons_alone) {
  Photons photons = scatter([](int, int) { return 400.0; }, 2);
  const std::vector<float> before = photons.rgb;
  smoothing.spread(photons.rgb, photons.error_draw);
  EXPECT_EQ(photons.rgb, before);
}

TEST_F(Smoothing, does_not_carry_light_from_one_surface_to_another) {
  // Where the wall meets the floor: y = 0, z = -2 is the middle row.
  Photons photons = scatter([](int, int y) { return y >= size / 2 ? 1.0 : 0.0; }, 3);
  smoothing.spread(photons.rgb, photons.error_draw);
  const auto row_sum = [&](int y) {
    return std::accumulate(photons.rgb.begin() + 3 * size * y, photons.rgb.begin() + 3 * size * (y + 1), 0.0);
  };
  for (int y = 0; y < size / 2; ++y) EXPECT_EQ(row_sum(y), 0) << "row " << y;
  EXPECT_GT(row_sum(size / 2), 0);
}

TEST_F(Smoothing, leaves_even_light_even_where_kernels_are_cut) {
  // Where the two surfaces meet and at the picture's sides kernels are cut. Were a pixel's light just shared out
  // evenly, the outermost row would keep some 70 % of its light and the row that is a kernel away have 120 %.
  constexpr double density = 0.25;
  constexpr unsigned pictures = 200;
  std::vector<double> rows(size), columns(size);
  for (unsigned seed = 0; seed < pictures; ++seed) {
    Photons photons = scatter([](int, int) { return density; }, seed);
    smoothing.spread(photons.rgb, photons.error_draw);
    for (std::size_t y = 0; y < size; ++y)
      for (std::size_t x = 0; x < size; ++x) {
        rows[y] += photons.rgb[3 * (y * size + x)];
        columns[x] += photons.rgb[3 * (y * size + x)];
      }
  }
  // 2400 photons a row, so one in a million of ninety-six is farther off than 6 / sqrt(2400) = .12; light that is
  // spread scatters less.
  for (std::size_t i = 0; i < size; ++i) {
    EXPECT_NEAR(rows[i] / (size * density * pictures), 1, 0.12) << "row " << i;
    EXPECT_NEAR(columns[i] / (size * density * pictures), 1, 0.12) << "column " << i;
  }
}

TEST_F(Smoothing, keeps_the_light_of_an_outline_in_it) {
  // The floor's last row before the wall may hold light of both: it stays in that row.
  Photons photons = scatter([](int, int y) { return y == size / 2 ? 1.0 : 0.0; }, 8);
  const std::vector<float> before = photons.rgb;
  smoothing.spread(photons.rgb, photons.error_draw);
  EXPECT_NE(photons.rgb, before);
  for (int y = 0; y < size; ++y) {
    if (y == size / 2) continue;
    for (int i = 3 * size * y; i < 3 * size * (y + 1); ++i)
      EXPECT_EQ(photons.rgb[static_cast<std::size_t>(i)], 0) << "row " << y;
  }
}

/// A camera that looks down on a mirror or a pane, which shows a wall on the left and another on the right, of two
/// objects that meet where x = 0.
scene::Scene two_walls(const preset::Object& between, double wall_height) {
  preset::Preset p;
  p.source = "p.json";
  p.scene.materials["wall"];
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["glass"].type = preset::Material::Type::dielectric;
  const auto half = [&](const char* name, double x) {
    return shape_object(name, preset::Shape::Type::quad, "wall",
                        {.scale = {40, 1, 80}, .translate = {x, wall_height, 0}});
  };
  p.scene.objects = {between, half("left", -20), half("right", 20)};
  p.scene.camera = {.position = {0, 5, 0.5}, .target = {0, 0, 0}, .resolution = {size, size}};
  return scene::load_scene(p);
}

/// Where photons are on the right alone they stay there, and are spread.
void expect_no_light_on_the_left(const scene::Scene& scene) {
  photons::Smoothing smoothing =
      smoothing_of(scene, scene::build_bvh(scene.geometry), photons::Smoothing::Spread::everywhere);
  Photons photons = scatter([](int x, int) { return x >= size / 2 ? 1.0 : 0.0; }, 9);
  const std::vector<float> before = photons.rgb;
  smoothing.spread(photons.rgb, photons.error_draw);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size / 2; ++x)
      EXPECT_EQ(photons.rgb[3 * static_cast<std::size_t>(y * size + x)], 0) << x << ", " << y;
  EXPECT_NE(photons.rgb, before);
}

TEST_F(Smoothing, knows_what_a_mirror_shows) {
  expect_no_light_on_the_left(
      two_walls(shape_object("mirror", preset::Shape::Type::quad, "mirror", {.scale = {20, 1, 20}}), 10));
}

TEST_F(Smoothing, knows_what_a_window_shows) {
  expect_no_light_on_the_left(
      two_walls(shape_object("pane", preset::Shape::Type::box, "glass", {{20, 0.2, 20}, {30, 0, 0}, {0, 2, 0}}), 0));
}

/// What a ball shows is torn apart: there the ball itself says how far light is spread, as its picture is no more even
/// than that.
TEST_F(Smoothing, spreads_within_curved_glass) {
  const scene::Scene glass = two_walls(
      shape_object("ball", preset::Shape::Type::sphere, "glass", {.scale = {8, 8, 8}, .translate = {0, -4, 0}}), -20);
  photons::Smoothing within =
      smoothing_of(glass, scene::build_bvh(glass.geometry), photons::Smoothing::Spread::everywhere);
  Photons photons = scatter([](int, int) { return 1.0; }, 11);
  const double variance = moments(photons.rgb, 16, size - 16, 16).variance, power = sum(photons.rgb);
  within.spread(photons.rgb, photons.error_draw);
  EXPECT_LT(moments(photons.rgb, 16, size - 16, 16).variance, variance / 4);
  EXPECT_NEAR(sum(photons.rgb), power, 1e-5 * power);
}

/// Stripes that are narrower than the kernels are washed out: most of the error is that, not noise, and the draw takes
/// it in. It tells a little too little: kernels follow the noise, which the draw does not know, and what does not stand
/// out from the noise is not counted. A draw of noise alone would be half the error.
TEST_F(Smoothing, draws_how_far_light_was_moved) {
  const auto stripes = [](int x, int) { return x % 6 < 3 ? 3.0 : 0.0; };
  double drawn = 0, error = 0;
  for (unsigned seed = 100; seed < 132; ++seed) {
    Photons photons = scatter(stripes, seed);
    smoothing.spread(photons.rgb, photons.error_draw);
    for (int y = size / 2 + 8; y < size - 8; ++y)
      for (int x = 8; x < size - 8; ++x) {
        const std::size_t i = 3 * static_cast<std::size_t>(y * size + x);
        drawn += std::pow(photons.error_draw[i], 2);
        error += std::pow(photons.rgb[i] - stripes(x, y), 2);
      }
  }
  EXPECT_GT(std::sqrt(drawn / error), 0.7);
  EXPECT_LT(std::sqrt(drawn / error), 1.1);
}

/// Mean square error of the floor, away from its borders, over a few pictures: plain, spread everywhere, and where it
/// helps.
struct Errors {
  double plain = 0, everywhere = 0, by_gain = 0;
};
Errors errors_of(const Density& density) {
  const FloorAndWall room;
  photons::Smoothing everywhere = smoothing_of(room.scene, room.bvh, photons::Smoothing::Spread::everywhere),
                     by_gain = smoothing_of(room.scene, room.bvh, photons::Smoothing::Spread::where_it_helps);
  const auto add_error = [&](const std::vector<float>& rgb, double& sum) {
    for (int y = size / 2 + 8; y < size - 8; ++y)
      for (int x = 8; x < size - 8; ++x)
        sum += std::pow(rgb[3 * static_cast<std::size_t>(y * size + x)] - density(x, y), 2);
  };
  Errors errors;
  for (unsigned seed = 200; seed < 232; ++seed) {
    const Photons plain = scatter(density, seed);
    Photons all = plain, some = plain;
    everywhere.spread(all.rgb, all.error_draw);
    by_gain.spread(some.rgb, some.error_draw);
    EXPECT_NEAR(sum(some.rgb), sum(plain.rgb), 1e-5 * sum(plain.rgb));
    add_error(plain.rgb, errors.plain);
    add_error(all.rgb, errors.everywhere);
    add_error(some.rgb, errors.by_gain);
  }
  return errors;
}

TEST_F(Smoothing, goes_by_what_it_gains) {
  // Even light is all noise: what is spread everywhere is the best there is.
  const Errors even = errors_of([](int, int) { return 1.0; });
  EXPECT_LT(even.everywhere, 0.2 * even.plain);
  EXPECT_LT(even.by_gain, 1.3 * even.everywhere);
  // Faint glints of some photons a pixel are washed out where all is spread.
  const Errors glints = errors_of([](int x, int y) { return x % 5 == 0 && y % 5 == 0 ? 40.0 : 0.2; });
  EXPECT_GT(glints.everywhere, 1.1 * glints.plain);
  EXPECT_LT(glints.by_gain, 1.02 * glints.plain);
  // Beside each other, each part is better than where all is treated alike.
  const Errors both = errors_of([](int x, int) { return x >= size / 2 ? 0.4 : x % 4 < 2 ? 8.0 : 0.5; });
  EXPECT_LT(both.by_gain, 0.95 * both.everywhere);
  EXPECT_LT(both.by_gain, 0.95 * both.plain);
}

TEST_F(Smoothing, keeps_a_bright_line_sharp_on_a_dim_floor) {
  Photons photons = scatter([](int x, int) { return x == size / 2 ? 1000.0 : 1.0; }, 4);
  const std::vector<float> before = photons.rgb;
  smoothing.spread(photons.rgb, photons.error_draw);
  double line = 0, was = 0;
  for (int y = size / 2; y < size; ++y) {
    const std::size_t at = 3 * static_cast<std::size_t>(y * size + size / 2);
    line += photons.rgb[at], was += before[at];
  }
  EXPECT_NEAR(line, was, 0.02 * was);
}

TEST_F(Smoothing, leaves_a_picture_of_one_pixel_alone) {
  preset::Preset p;
  p.source = "p.json";
  p.scene.camera.resolution = {1, 1};
  const scene::Scene empty = scene::load_scene(p);
  std::vector<float> rgb{3, -1, 2}, draw{1, 1, 1};
  smoothing_of(empty, scene::build_bvh(empty.geometry), photons::Smoothing::Spread::everywhere).spread(rgb, draw);
  EXPECT_EQ(rgb, (std::vector<float>{3, -1, 2}));
  EXPECT_EQ(draw, (std::vector<float>{1, 1, 1}));
}

TEST_F(Smoothing, spreads_coloured_photons_as_far_as_their_noise_asks) {
  const auto spread_of = [&](bool green) {
    Photons photons = scatter([](int, int) { return 2.0; }, 7);
    if (green)
      for (std::size_t i = 0; i < photons.rgb.size(); i += 3)
        photons.rgb[i] = photons.rgb[i + 2] = photons.error_draw[i] = photons.error_draw[i + 2] = 0;
    smoothing.spread(photons.rgb, photons.error_draw);
    return moments(photons.rgb, size / 2 + 8, size - 8, 8, 1).variance;
  };
  // The mean of R, G and B is a third of G, and the mean variance a third of G's: three times the relative variance, so
  // three times the pixels.
  EXPECT_LT(spread_of(true), 0.6 * spread_of(false));
}

// What hardly is noisy is neither left in the blocks of a preview, nor as noisy as it came where it is even.
TEST_F(Smoothing, in_blocks_keeps_what_a_pixel_shows_and_evens_what_is_even) {
  const auto is_glint = [](int x, int y) { return x % 12 == 5 && y % 12 == 5; };
  Photons photons = scatter([&](int x, int y) { return is_glint(x, y) && x < size / 2 ? 40000. : 400.; }, 9);
  photons::BlockSmoothing blocks(scene, bvh, photons::Smoothing::Spread::where_it_helps, 8, {});
  photons::LayerEstimate layer{photons.rgb, photons.error_draw};
  blocks.spread(layer);
  int glints = 0;
  double noise2 = 0, noise2_before = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const std::size_t red = 3 * static_cast<std::size_t>(y * size + x);
      if (x < size / 2 && is_glint(x, y)) {
        EXPECT_NEAR(layer.rgb[red], 40000, 0.03 * 40000) << x << ' ' << y;
        ++glints;
      }
      if (x > size / 2 + 14 && y > size / 2 + 6)
        noise2 += std::pow(layer.rgb[red] - 400, 2), noise2_before += std::pow(photons.rgb[red] - 400, 2);
    }
  EXPECT_EQ(glints, 8);
  EXPECT_LT(noise2, 0.25 * noise2_before);
}

// Photons of one colour each in bright and dark columns. The light keeps its columns, and grey is what they are.
TEST_F(Smoothing, in_blocks_evens_colours_further_than_light) {
  const auto density = [](int x, int) { return x % 6 < 3 ? 30.0 : 6.0; };
  Photons photons = scatter(density, 3);
  for (std::size_t c = 0; c < 3; ++c) {
    const Photons of_a_colour = scatter(density, 10 + static_cast<unsigned>(c));
    for (std::size_t i = c; i < photons.rgb.size(); i += 3)
      photons.rgb[i] = of_a_colour.rgb[i], photons.error_draw[i] = of_a_colour.error_draw[i];
  }
  photons::BlockSmoothing blocks(scene, bvh, photons::Smoothing::Spread::where_it_helps, 8, {});
  photons::LayerEstimate layer{photons.rgb, photons.error_draw};
  blocks.spread(layer);
  double colour2 = 0, light2 = 0, bright = 0, dark = 0;
  for (int y = size / 2 + 8; y < size - 8; ++y)
    for (int x = 8; x < size - 8; ++x) {
      const float* rgb = layer.rgb.data() + 3 * static_cast<std::size_t>(y * size + x);
      const double light = (double{rgb[0]} + rgb[1] + rgb[2]) / 3;
      for (int c = 0; c < 3; ++c) colour2 += std::pow(rgb[c] - light, 2), light2 += light * light;
      if (x % 6 == 1) bright += light;
      if (x % 6 == 4) dark += light;
    }
  EXPECT_LT(std::sqrt(colour2 / light2), 0.05);
  EXPECT_GT(bright, 3 * dark);
}

TEST_F(Smoothing, does_nothing_without_a_draw_or_in_the_dark) {
  Photons photons = scatter([](int, int) { return 1.0; }, 5);
  photons.error_draw.clear();
  const std::vector<float> before = photons.rgb;
  smoothing.spread(photons.rgb, photons.error_draw);
  EXPECT_EQ(photons.rgb, before);
  EXPECT_TRUE(photons.error_draw.empty());
  Photons dark = scatter([](int, int) { return 0.0; }, 6);
  smoothing.spread(dark.rgb, dark.error_draw);
  EXPECT_EQ(sum(dark.rgb), 0);
}

} // namespace nephroid::smoothing_test
