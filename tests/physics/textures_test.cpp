// SPDX-License-Identifier: Apache-2.0
// Pictures that make surfaces rough, tint glass and lean normals. A picture of one value does what the plain number
// does. A normal map of one normal lights a flat board as one that leans so, within what falls on it.
#include "optics/primary_reflectances.h"
#include "scatter/spectra.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

namespace nephroid::textures_test {

using Rgb = preset::Vec3;

/// Of two by two fields.
preset::Texture board(const Rgb& colour0, const Rgb& colour1) {
  preset::Texture texture;
  texture.type = preset::Texture::Type::checkerboard;
  texture.colour0 = colour0;
  texture.colour1 = colour1;
  return texture;
}

preset::Texture even(double value) { return board({value, value, value}, {value, value, value}); }

/// A board that fills the picture, x to the right and -z up in it; the textures' u and v are these too.
preset::Preset above_a_board(const preset::Material& material, int resolution = 16) {
  preset::Preset p = empty_preset(resolution);
  p.scene.materials["board"] = material;
  p.scene.objects = {object("board", quad(2, 2), "board")};
  p.scene.camera.position = {0, 5, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 2 * std::atan(0.2) / degree;
  spectral::settings(p).caustic = false;
  spectral::settings(p).direct = true;
  p.stop.passes = spectral::settings(p).pixel_samples = 4;
  return p;
}

preset::Light sun(const preset::Vec3& direction) {
  preset::Light light;
  light.type = preset::Light::Type::directional;
  light.direction = direction;
  return light;
}

double mean_light(const job::Snapshot& snapshot, const char* name) {
  const std::vector<double> y = luminance(layer(snapshot, name));
  return std::accumulate(y.begin(), y.end(), 0.0) / static_cast<double>(y.size());
}

/// Means of the fields of a checkerboard of the first colour and of the second, without the pixels between them.
std::array<Rgb, 2> means_of_fields(const job::Layer& layer, std::size_t width) {
  std::array<Rgb, 2> sums{};
  const double count = 2.0 * static_cast<double>((width / 2 - 1) * (width / 2 - 1));
  for (std::size_t i = 0; i < layer.rgb.size() / 3; ++i) {
    const std::size_t x = i % width, y = i / width, middle = width / 2;
    if (x == middle || x + 1 == middle || y == middle || y + 1 == middle) continue;
    for (std::size_t c = 0; c < 3; ++c)
      sums[(x < middle) == (y < middle) ? 1 : 0][c] += double(layer.rgb[3 * i + c]) / count;
  }
  return sums;
}

// ---- Roughness

/// A mirror or a plate of glass over a white floor, in a lamp's light and below an even sky.
preset::Preset rough_thing(bool glassy, double roughness, const std::optional<preset::Texture>& texture) {
  preset::Material material = glassy ? glass(1.5) : check::mirror(0.9);
  material.roughness = roughness;
  material.roughness_texture = texture;
  preset::Preset p = above_a_board(material);
  if (glassy) p.scene.objects[0].shape = box(2, 0.1, 2);
  p.scene.materials["floor"] = white(0.7);
  p.scene.objects.push_back(object("floor", quad(6, 6), "floor", at({0, -1, 0})));
  p.scene.lights = {sun({0.2, -1, 0.1})};
  p.scene.environment = preset::Environment{.type = preset::Environment::Type::constant, .lights = true};
  spectral::settings(p).caustic = true;
  return p;
}

TEST(RoughnessTextures, OfOneValueAreThePlainNumber) {
  for (const bool glassy : {false, true}) {
    const std::vector<float> plain = render_as_it_is(rough_thing(glassy, 0.4, {})).picture->rgb;
    EXPECT_EQ(render_as_it_is(rough_thing(glassy, 0.4, even(1))).picture->rgb, plain) << "the same bits";
    // Half of 0.8 differs from 0.4 by 1 / 65535.
    const std::vector<float> half = render_as_it_is(rough_thing(glassy, 0.8, even(0.5))).picture->rgb;
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < plain.size(); ++i)
      difference += std::abs(half[i] - plain[i]), sum += std::abs(plain[i]);
    EXPECT_LT(difference / sum, 2e-3);
    EXPECT_GT(difference, 0) << "it is looked up";
  }
}

TEST(RoughnessTextures, OfZeroAndNextToItArePolished) {
  for (const bool glassy : {false, true}) {
    const std::vector<float> polished = render_as_it_is(rough_thing(glassy, 0, {})).picture->rgb;
    for (const double value : {0.0, 0.009}) { // the least alpha is that of 0.01
      const std::vector<float> black = render_as_it_is(rough_thing(glassy, 1, even(value))).picture->rgb;
      ASSERT_EQ(black.size(), polished.size());
      for (std::size_t i = 0; i < black.size(); ++i) ASSERT_NEAR(black[i], polished[i], 1e-5f + 1e-5f * polished[i]);
    }
    const job::Snapshot rough = render_as_it_is(rough_thing(glassy, 1, even(0.011)));
    for (const float value : rough.picture->rgb) ASSERT_TRUE(std::isfinite(value));
  }
}

/// The white furnace: a perfect mirror shows the sky, but for what its facets lose by their roughness.
TEST(RoughnessTextures, EachFieldLosesWhatItsRoughnessDoes) {
  const auto below_a_sky = [](double roughness, const std::optional<preset::Texture>& texture) {
    preset::Material material = check::mirror(1);
    material.roughness = roughness;
    material.roughness_texture = texture;
    preset::Preset p = above_a_board(material);
    p.scene.environment = preset::Environment{.type = preset::Environment::Type::constant};
    spectral::settings(p).background = true;
    spectral::settings(p).direct = false;
    p.stop.passes = spectral::settings(p).pixel_samples = 512;
    return p;
  };
  const job::Snapshot fields = render(below_a_sky(0.9, board({1, 1, 1}, {0.2, 0.5, 0.8})));
  const std::array<Rgb, 2> seen = means_of_fields(layer(fields, "background"), 16);
  for (const std::size_t field : {0u, 1u}) {
    const double roughness = field == 0 ? 0.9 : 0.45, // by the green
        plain = mean_light(render(below_a_sky(roughness, {})), "background");
    expect_truth(field == 0 ? "rough field" : "less rough field", seen[field][1], plain, 5e-3);
    EXPECT_LT(seen[field][1], 1);
  }
  EXPECT_LT(seen[0][1], seen[1][1] - 0.1) << "the fields are seen";
}

// ---- Tint

TEST(TintTextures, ColourWhatPassesEachFace) {
  const Rgb colours[] = {{0.75, 0.5, 0.125}, {0.25, 0.05, 1.0}};
  for (const bool thin : {true, false})
    for (const std::optional<double>& nm : {std::optional<double>(), std::optional(500.0), std::optional(620.0)}) {
      const auto through = [&](const std::optional<preset::Texture>& texture) {
        preset::Material window = glass(1.5);
        window.thin = thin;
        window.tint.value = 0.8;
        window.tint_texture = texture;
        preset::Preset p = above_a_board(white());
        p.scene.materials["window"] = window;
        p.scene.objects.push_back(
            object("window", thin ? quad(0.4, 0.4) : box(0.4, 0.01, 0.4), "window", at({0, 8, 0})));
        p.scene.lights.resize(1);
        p.scene.lights[0].position = {0, 9, 0};
        if (nm) p.scene.lights[0].spectrum = check::line(*nm);
        spectral::settings(p).direct = false;
        spectral::settings(p).caustic = true;
        spectral::settings(p).low_discrepancy = true;
        p.stop.passes = 32;
        return means_of_fields(layer(render(p), "caustic"), 16);
      };
      const std::array<Rgb, 2> clear = through({}), seen = through(board(colours[0], colours[1]));
      for (const std::size_t field : {0u, 1u}) {
        if (thin && !nm) // under D65 white has the colour of the field
          for (std::size_t c = 0; c < 3; ++c)
            expect_truth("tint under daylight", seen[field][c] / clear[field][c], colours[field][c], 0.02);
        if (!nm) continue;
        const auto passes = [&](const Rgb& colour) {
          double part = 0;
          for (std::size_t c = 0; c < 3; ++c)
            part += colour[c] * optics::primary_reflectances()[c][static_cast<std::size_t>(*nm - 380)];
          return part;
        };
        // The fields of the face below lie the other way round; light that is reflected within is a hundredth.
        const double truth = thin ? passes(colours[field]) : passes(colours[0]) * passes(colours[1]);
        const auto y = [&](const Rgb& rgb) { return optics::linear_srgb_to_xyz(rgb)[1]; };
        expect_truth("tint of a line", y(seen[field]) / y(clear[field]), truth, 0.01);
      }
    }
}

TEST(TintTextures, OfOneGreyAreThePlainNumber) {
  preset::Material plain = glass(1.5), textured = glass(1.5);
  plain.tint.value = 0.4;
  textured.tint.value = 0.8;
  textured.tint_texture = even(0.5);
  const auto light_below = [&](const preset::Material& material) {
    preset::Preset p = rough_thing(true, 0, {});
    p.scene.materials["board"] = material;
    p.stop.passes = 16;
    return mean_light(render(p), "caustic");
  };
  const double truth = light_below(plain);
  expect_truth("grey tint", light_below(textured) / truth, 1, 5e-3);
}

TEST(TintTextures, PassTheSameLightOfACluster) {
  preset::Preset p = rough_thing(true, 0, {});
  p.scene.materials["board"].tint_texture = even(0.5);
  p.stop.passes = 16;
  const double truth = mean_light(render(p), "caustic");
  spectral::settings(p).jitter = false;
  expect_truth("tint of whole clusters", mean_light(render(p), "caustic") / truth, 1, 5e-3);
}

// ---- Normal maps

preset::Texture normals(const preset::Vec3& normal) {
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  Rgb colour{};
  for (std::size_t i = 0; i < 3; ++i) colour[i] = (1 + normal[i] / length) / 2;
  return board(colour, colour);
}

preset::Material leaning(const preset::Texture& map) {
  preset::Material material = white();
  material.normal_map = map;
  return material;
}

/// What a matt surface takes of light from `to_light`, over what falls on a surface that faces it: the cosine to the
/// normal, bounded by that to the true surface over that between both (docs/materials.md).
double taken(const glm::dvec3& to_light, const glm::dvec3& normal) {
  const glm::dvec3 up(0, 1, 0);
  const double falls = glm::dot(to_light, up), takes = glm::dot(to_light, normal);
  if (falls <= 0 || takes <= 0) return 0;
  return std::min(takes, falls / glm::dot(normal, up));
}

TEST(NormalMaps, LightABoardAsOneThatLeans) {
  const auto light_of = [&](const glm::dvec3& to_light, const preset::Material& material) {
    preset::Preset p = above_a_board(material);
    p.scene.lights = {sun(scene::to_vec3(-to_light))};
    return mean_light(render(p), "direct");
  };
  const double straight_down = light_of({0, 1, 0}, white());
  const glm::dvec3 lights[] = {{0, 1, 0}, {0.5, 1, 0}, {-0.5, 1, 0.3}, {0.2, 1, -0.7},
                               {3, 1, 0}, {-3, 1, 0},  {20, 1, 0},     {3, -0.5, 0}}; // the last from behind
  for (const glm::dvec3& given : lights)
    for (const double lean_deg : {0.0, 20.0, 50.0}) {
      const glm::dvec3 to_light = glm::normalize(given);
      const double s = std::sin(lean_deg * degree), c = std::cos(lean_deg * degree);
      // To the right in the picture is +x, and up is -z.
      for (const auto& [map, normal] :
           {std::pair(normals({s, 0, c}), glm::dvec3(s, c, 0)), std::pair(normals({0, s, c}), glm::dvec3(0, c, -s))})
        expect_truth("a normal map in the sun", light_of(to_light, leaning(map)) / straight_down,
                     taken(to_light, normal), 2e-4);
    }
}

TEST(NormalMaps, FollowTheirTextureAndScale) {
  const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.3, 1, -0.2));
  const auto light_of = [&](const preset::Material& material, bool mirrored = false) {
    preset::Preset p = above_a_board(material);
    if (mirrored) p.scene.objects[0].transform.scale = {-1, 1, 1}; // mirrored: +x in the picture is -x
    p.scene.lights = {sun(scene::to_vec3(-to_light))};
    return mean_light(render(p), "direct");
  };
  const double flat = light_of(white()) / to_light.y, s = std::sin(0.4), c = std::cos(0.4);
  // To the right and upwards in the picture.
  const double x = 0.6 * s, y = 0.8 * s;
  preset::Texture map = normals({x, y, c});
  const auto expect_normal = [&](const char* what, const preset::Material& material, const glm::dvec3& normal,
                                 bool mirrored = false) {
    expect_truth(what, light_of(material, mirrored) / flat, taken(to_light, glm::normalize(normal)), 2e-4);
  };
  expect_normal("mirrored mesh", leaning(map), {-x, c, -y}, true);
  map.rotate_deg = 90; // the picture's right is then at -v, which is +z, and its top at u
  expect_normal("turned map", leaning(map), {y, c, x});
  map.rotate_deg = 0;
  map.scale = {-2, 3};
  expect_normal("mirrored map", leaning(map), {-x, c, -y});
  map.scale = {1, 1};
  preset::Material scaled = leaning(map);
  for (const double scale : {0.0, 0.5, 3.0, -1.0}) {
    scaled.normal_scale = scale;
    expect_normal("scaled map", scaled, {scale * x, c, -scale * y});
  }
  expect_normal("one that looks into the surface is none", leaning(normals({0.5, 0, -0.5})), {0, 1, 0});
}

/// Photons light it as the sun does, also as streaks of dispersed light.
TEST(NormalMaps, AreLitThroughGlassAsDirectly) {
  for (const double z : {1.0, 0.8}) {
    const auto light_of = [&](const preset::Material& material, bool through_glass) {
      preset::Preset p = above_a_board(material);
      p.scene.lights = {sun({1, -z, 0.2})};
      if (through_glass) {
        p.scene.materials["glass"] = glass(1.5);
        p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::cauchy;
        p.scene.materials["glass"].dispersion.coefficients = {1.5, 0.02}; // streaks
        p.scene.objects.push_back(object("pane", box(30, 0.1, 30), "glass", at({0, 2, 0})));
        p.scene.camera.position = {0, 1.9, 0};
        p.scene.camera.fov_deg = 2 * std::atan(0.2) / degree;
        spectral::settings(p).photons_per_pass = 1 << 18;
        p.stop.passes = 64;
      }
      spectral::settings(p).direct = !through_glass;
      spectral::settings(p).caustic = through_glass;
      return mean_light(render(p), through_glass ? "caustic" : "direct");
    };
    const double s = std::sin(0.6), c = std::cos(0.6);
    const double flat = light_of(white(), true) / light_of(white(), false);
    for (const double side : {-1.0, 1.0}) {
      const preset::Material map = leaning(normals({side * s, 0, c}));
      const double direct = light_of(map, false);
      ASSERT_GT(direct, 0);
      expect_truth("a normal map through a pane, over that in the sun", light_of(map, true) / direct / flat, 1, 0.02);
    }
  }
}

/// The furnace: below an even sky a white board sends back no more than the sky, but for the bound's one over the
/// cosine of both normals.
TEST(NormalMaps, TakeFromASkyWhatTheBoundLets) {
  for (const double lean_deg : {20.0, 60.0}) {
    const glm::dvec3 normal(std::sin(lean_deg * degree), std::cos(lean_deg * degree), 0);
    const auto light_of = [&](const preset::Material& material) {
      preset::Preset p = above_a_board(material);
      p.scene.environment = preset::Environment{.type = preset::Environment::Type::constant, .lights = true};
      p.stop.passes = spectral::settings(p).pixel_samples = 256;
      return mean_light(render(p), "direct");
    };
    double truth = 0;
    constexpr int steps = 1000;
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const double y = (i + 0.5) / steps, phi = 2 * M_PI * (j + 0.5) / steps, r = std::sqrt(1 - y * y);
        truth += taken({r * std::cos(phi), y, r * std::sin(phi)}, normal) * 2 / steps / steps;
      }
    const double seen = light_of(leaning(normals({normal.x, 0, normal.y}))) / light_of(white());
    expect_truth("a normal map below a sky", seen, truth, 3e-3);
    EXPECT_LT(seen, 1);
  }
}

} // namespace nephroid::textures_test
