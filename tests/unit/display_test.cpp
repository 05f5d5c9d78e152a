// SPDX-License-Identifier: Apache-2.0
// From light to a display's bytes: hues are kept, what sRGB has stays as it is, curves are those of their papers, lamps
// become white, and whatever a float can be has a byte.
#include "base/parallel.h"
#include "image/display.h"
#include "image/image.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "run/display.h"
#include "spectral/settings.h"
#include "tests/support/test.h"

#include <numbers>

namespace nephroid::display_test {

using image::Display;
using image::displayed;
using image::Showing;
using Rgb = std::array<float, 3>;
using Gamut = preset::Display::Gamut;
using Tone = preset::Display::Tone;

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();

Display of(Gamut gamut, Tone tone) {
  Display display;
  display.gamut = gamut;
  display.tone = tone;
  return display;
}

Rgb as_floats(const optics::Colour& c) {
  return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
}

struct Lch {
  double lightness, chroma, hue_deg;
};
/// OKLCh by the matrices from XYZ that its author printed; the program has those from linear sRGB.
Lch oklch(const Rgb& rgb) {
  const optics::Colour xyz = optics::linear_srgb_to_xyz({double(rgb[0]), double(rgb[1]), double(rgb[2])});
  constexpr double cones[3][3] = {{0.8189330101, 0.3618667424, -0.1288597137},
                                  {0.0329845436, 0.9293118715, 0.0361456387},
                                  {0.0482003018, 0.2643662691, 0.6338517070}},
                   lab[3][3] = {{0.2104542553, 0.7936177850, -0.0040720468},
                                {1.9779984951, -2.4285922050, 0.4505937099},
                                {0.0259040371, 0.7827717662, -0.8086757660}};
  double roots[3], result[3];
  for (int i = 0; i < 3; ++i) roots[i] = std::cbrt(cones[i][0] * xyz[0] + cones[i][1] * xyz[1] + cones[i][2] * xyz[2]);
  for (int i = 0; i < 3; ++i) result[i] = lab[i][0] * roots[0] + lab[i][1] * roots[1] + lab[i][2] * roots[2];
  return {result[0], std::hypot(result[1], result[2]), std::atan2(result[2], result[1]) * 180 / std::numbers::pi};
}

double degrees_between(double a, double b) { return std::abs(std::remainder(a - b, 360)); }

/// One wavelength of this OKLab lightness: a colour's cones grow by the cube of it.
Rgb wavelength(std::size_t w, double lightness) {
  const auto& eye = optics::cie_1931();
  const optics::Colour rgb = optics::xyz_to_linear_srgb({eye.x[w], eye.y[w], eye.z[w]});
  const double most = std::max({rgb[0], rgb[1], rgb[2]});
  const Rgb scaled = as_floats({rgb[0] / most, rgb[1] / most, rgb[2] / most});
  const double factor = std::pow(lightness / oklch(scaled).lightness, 3);
  return as_floats({factor * double(scaled[0]), factor * double(scaled[1]), factor * double(scaled[2])});
}

TEST(GamutMapping, KeepsHueAndLightnessOfAllWavelengths) {
  double most_turned = 0, most_off = 0, most_clipped = 0;
  for (const double lightness : {0.25, 0.45, 0.8, 0.95})
    for (std::size_t w = 0; w < optics::wavelength_count; ++w) {
      const Rgb colour = wavelength(w, lightness);
      const Lch before = oklch(colour), after = oklch(displayed(colour, {of(Gamut::oklch, Tone::clip)}));
      ASSERT_GT(after.chroma, 0.01) << w;
      most_turned = std::max(most_turned, degrees_between(before.hue_deg, after.hue_deg));
      most_off = std::max(most_off, std::abs(before.lightness - after.lightness));
      ASSERT_LE(after.chroma, before.chroma + 1e-6);
      const Rgb clipped = displayed(colour, {Display()});
      most_clipped = std::max(most_clipped, degrees_between(before.hue_deg, oklch(clipped).hue_deg));
    }
  EXPECT_LT(most_turned, 0.3) << "degrees";
  EXPECT_LT(most_off, 1e-3);
  RecordProperty("degrees", std::to_string(most_turned));
  EXPECT_GT(most_clipped, 20) << "what clipping does to them";
  RecordProperty("degrees_clipped", std::to_string(most_clipped));
}

TEST(GamutMapping, GoesNoFartherThanToTheEdge) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> which(0, optics::wavelength_count - 1);
  std::uniform_real_distribution<double> light(0.2, 0.9);
  std::uniform_real_distribution<float> white(0, 0.3f);
  int mapped = 0;
  for (int i = 0; i < 20000; ++i) { // two wavelengths and white
    const Rgb a = wavelength(which(random), light(random)), b = wavelength(which(random), light(random));
    const float grey = white(random);
    const Rgb colour{a[0] + b[0] + grey, a[1] + b[1] + grey, a[2] + b[2] + grey};
    const Lch before = oklch(colour);
    if (before.lightness > 0.98) continue;
    const Rgb shown = displayed(colour, {of(Gamut::oklch, Tone::clip)});
    if (*std::ranges::min_element(colour) >= 0 && *std::ranges::max_element(colour) <= 1) {
      ASSERT_EQ(shown, colour);
      continue;
    }
    ++mapped;
    const Lch after = oklch(shown);
    ASSERT_TRUE(*std::ranges::min_element(shown) < 2e-3f || *std::ranges::max_element(shown) > 1 - 2e-3f);
    ASSERT_NEAR(before.lightness, after.lightness, 3e-3);
    ASSERT_TRUE(after.chroma < 0.02 || degrees_between(before.hue_deg, after.hue_deg) < 0.5) << after.chroma;
  }
  EXPECT_GT(mapped, 5000);
}

TEST(GamutMapping, ShowsLightThatIsTooLightAsWhite) {
  EXPECT_EQ(displayed({3, 2, 1.5f}, {of(Gamut::oklch, Tone::clip)}), (Rgb{1, 1, 1}));
  EXPECT_EQ(displayed({-1, 0, 0}, {of(Gamut::oklch, Tone::clip)}), (Rgb{0, 0, 0}));
}

TEST(Displayed, WhatSrgbHasIsLeftBitByBit) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> channel(0, 1);
  std::vector<float> rgb{0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 1, 1};
  while (rgb.size() < 300000) rgb.push_back(channel(random));
  const Showing showing = image::showing_of(run::display_of(preset::Preset()), 0, rgb);
  EXPECT_EQ(showing.peak, 1);
  std::vector<unsigned char> bytes(rgb.size()), with_alpha(rgb.size() / 3 * 4);
  image::show(rgb, showing, bytes);
  image::show(rgb, showing, with_alpha);
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    ASSERT_EQ(bytes[i], image::shown(rgb[i])) << rgb[i];
    ASSERT_EQ(with_alpha[i / 3 * 4 + i % 3], bytes[i]);
  }
  EXPECT_EQ(with_alpha[3], 255);
}

TEST(ToneReinhard, IsItsFormulaAboveTheKnee) {
  // Peak 3, knee .6: W = (3 - .6) / .4 = 6; at x = 1 L = 1, L (1 + L / 36) / (1 + L) = .513889, .6 + .4 .513889 =
  // .805556.
  const Showing showing{of(Gamut::clip, Tone::reinhard), 1, 3};
  EXPECT_NEAR(displayed({1, 1, 1}, showing)[0], 0.805556f, 1e-6f);
  EXPECT_NEAR(displayed({3, 3, 3}, showing)[0], 1, 1e-6f);
  EXPECT_EQ(displayed({50, 50, 50}, showing), (Rgb{1, 1, 1}));
  EXPECT_EQ(displayed({0.6f, 0.3f, 0.01f}, showing), (Rgb{0.6f, 0.3f, 0.01f})) << "middle tones stay";
  const Rgb bright = displayed({3, 1.5f, 0.3f}, showing);
  EXPECT_NEAR(bright[1] / bright[0], 0.5f, 1e-6f) << "the hue stays";
  EXPECT_NEAR(bright[2] / bright[0], 0.1f, 1e-6f);
  EXPECT_EQ(displayed({2, 1, 0.5f}, {of(Gamut::clip, Tone::reinhard), 0.5f, 1}), (Rgb{1, 0.5f, 0.25f}))
      << "a peak of 1 leaves what is not above it";
}

TEST(ToneFilmic, IsHablesCurve) {
  // f(2 x) / f(11.2) with the constants of the talk, worked out by hand: f(2) = .704 / 1.66 - 1 / 15 = .357430, f(11.2)
  // = 19.38 / 24.476 - 1 / 15 = .725130.
  const auto filmic = [](float x) { return displayed({x, 0, 0}, {of(Gamut::clip, Tone::filmic)})[0]; };
  EXPECT_NEAR(filmic(1), (0.704 / 1.66 - 1.0 / 15) / (19.38 / 24.476 - 1.0 / 15), 1e-6);
  EXPECT_NEAR(filmic(0.18f), 0.1283384, 1e-6);
  EXPECT_NEAR(filmic(2), 0.7132380, 1e-6);
  EXPECT_EQ(filmic(0), 0);
  EXPECT_NEAR(filmic(5.6f), 1, 1e-6) << "the white point";
  EXPECT_EQ(filmic(1e20f), 1);
  EXPECT_EQ(filmic(-1), 0);
}

TEST(Displayed, BrighterLightIsNeverDarker) {
  for (const Tone tone : {Tone::reinhard, Tone::filmic, Tone::clip})
    for (const Gamut gamut : {Gamut::oklch, Gamut::clip})
      for (const Rgb& hue : {Rgb{1, 1, 1}, Rgb{1, 0.3f, -0.2f}, Rgb{-0.3f, 0.1f, 1}, Rgb{-0.4f, 1, 0.2f}}) {
        double before = 0;
        for (float factor = 0.001f; factor < 100; factor *= 1.02f) {
          const Rgb shown = displayed({factor * hue[0], factor * hue[1], factor * hue[2]}, {of(gamut, tone), 1, 9});
          const double lightness =
              gamut == Gamut::oklch ? oklch(shown).lightness : double(*std::ranges::max_element(shown));
          ASSERT_GE(lightness, before - 2e-4) << factor << " of " << hue[0] << " " << hue[1] << " " << hue[2];
          before = lightness;
        }
      }
}

TEST(Peak, IsWhatATenThousandthOfThePixelsIsAbove) {
  std::vector<float> rgb(3 * 100000, 0.5f);
  const Display display = of(Gamut::oklch, Tone::reinhard);
  const auto peak = [&](double stops) { return image::showing_of(display, stops, rgb).peak; };
  EXPECT_EQ(peak(0), 1);
  for (std::size_t i = 0; i < 10; ++i) rgb[3 * 7919 * i + i % 3] = 40;
  EXPECT_EQ(peak(0), 1) << "ten are few";
  rgb[3 * 99999] = 20;
  EXPECT_NEAR(peak(0), 20, 0.4) << "the eleventh";
  EXPECT_NEAR(peak(1), 40, 0.8) << "exposed";
  EXPECT_EQ(image::showing_of(of(Gamut::oklch, Tone::clip), 0, rgb).peak, 1) << "no other curve asks";
  EXPECT_TRUE(std::isfinite(image::showing_of(display, 20, std::vector<float>{infinity, nan, -infinity}).peak));
}

TEST(Displayed, TakesWhateverAFloatCanBe) {
  const float values[] = {0, 0.5f, 1, 2, 1e30f, infinity, nan, -0.5f, -1e30f, -infinity};
  Display balanced = of(Gamut::oklch, Tone::reinhard);
  balanced.white_balance = {0.5f, 0.1f, -3, 0, 1, 0, 50, -2, 1};
  for (const Tone tone : {Tone::reinhard, Tone::filmic, Tone::clip})
    for (const Gamut gamut : {Gamut::oklch, Gamut::clip})
      for (Display display : {of(gamut, tone), balanced})
        for (const float scale : {1.0f, 1048576.0f})
          for (const float r : values)
            for (const float g : values)
              for (const float b : values) {
                display.gamut = gamut, display.tone = tone;
                const Rgb shown = displayed({r, g, b}, {display, scale, 3});
                for (const float value : shown) ASSERT_TRUE(value >= 0 && value <= 1) << r << " " << g << " " << b;
              }
  for (const Tone tone : {Tone::reinhard, Tone::filmic, Tone::clip}) {
    EXPECT_EQ(displayed({infinity, 0, nan}, {of(Gamut::clip, tone)}), (Rgb{1, 0, 0}));
    EXPECT_EQ(displayed({infinity, infinity, infinity}, {of(Gamut::oklch, tone)}), (Rgb{1, 1, 1}));
  }
  EXPECT_EQ(image::shown(infinity), 255);
  EXPECT_EQ(image::shown(-infinity), 0);
  EXPECT_EQ(image::shown(nan), 0);
  image::show({}, {}, {});
}

preset::Preset lit_by(const preset::LightSpectrum& spectrum) {
  preset::Preset p;
  p.scene.lights.resize(1);
  p.scene.lights[0].spectrum = spectrum;
  p.display.white_balance = preset::Display::WhiteBalance::light;
  return p;
}

Rgb balanced(const preset::Preset& p, const optics::Spectrum& light) {
  const optics::Colour rgb = optics::xyz_to_linear_srgb(optics::to_xyz(light)), xyz = optics::to_xyz(light);
  return displayed(as_floats({0.5 * rgb[0] / xyz[1], 0.5 * rgb[1] / xyz[1], 0.5 * rgb[2] / xyz[1]}),
                   {run::display_of(p)});
}

TEST(WhiteBalance, MakesTheLampsLightGrey) {
  for (const char* name : {"A", "D50", "D65", "E", "F2", "F10"}) {
    const Rgb grey = balanced(lit_by({.illuminant = name}), optics::illuminant(name));
    for (const float value : grey) EXPECT_NEAR(value, 0.5f, 1e-4f) << name << ": of the same luminance";
  }
  for (const double kelvin : {2000.0, 2700.0, 4000.0, 10000.0}) {
    const preset::LightSpectrum lamp{.type = preset::LightSpectrum::Type::blackbody, .temperature_k = kelvin};
    const Rgb grey = balanced(lit_by(lamp), optics::blackbody(kelvin));
    for (const float value : grey) EXPECT_NEAR(value, 0.5f, 1e-4f) << kelvin;
  }
  const Rgb orange = balanced(preset::Preset(), optics::illuminant("A"));
  EXPECT_GT(orange[0] - orange[2], 0.3f) << "as it is";
}

/// ICC.1 and Lindbloom's page give the Bradford matrix from D50 to D65; XYZ of (.9642, 1, .8251) becomes that of D65.
TEST(WhiteBalance, IsThePublishedBradfordMatrix) {
  constexpr double published[3][3] = {
      {0.9555766, -0.0230393, 0.0631636}, {-0.0282895, 1.0099416, 0.0210077}, {0.0122982, -0.0204830, 1.3299098}};
  const auto balance = optics::white_balance({0.96422, 1, 0.82521});
  const optics::Colour colour{0.3, 0.5, 0.2}; // XYZ
  optics::Colour wanted{};
  for (std::size_t i = 0; i < 3; ++i)
    wanted[i] = published[i][0] * colour[0] + published[i][1] * colour[1] + published[i][2] * colour[2];
  const optics::Colour rgb = optics::xyz_to_linear_srgb(colour);
  optics::Colour became{};
  for (std::size_t i = 0; i < 3; ++i)
    became[i] = balance[i][0] * rgb[0] + balance[i][1] * rgb[1] + balance[i][2] * rgb[2];
  became = optics::linear_srgb_to_xyz(became);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(became[i], wanted[i], 2e-4) << i;
}

TEST(WhiteBalance, ALaserHasNoneAndACandleHas) {
  for (const double nm : {380.0, 450.0, 532.0, 589.0, 650.0, 780.0}) {
    const preset::LightSpectrum laser{.type = preset::LightSpectrum::Type::lines, .table = {{nm, 1}}};
    EXPECT_THAT(test::refusal_of([&] { run::display_of(lit_by(laser)); }),
                HasSubstr("no display has the colour of the first light"));
  }
  for (const double kelvin : {1000.0, 1900.0}) {
    const preset::LightSpectrum glow{.type = preset::LightSpectrum::Type::blackbody, .temperature_k = kelvin};
    for (const float value : run::display_of(lit_by(glow)).white_balance) EXPECT_LT(std::abs(value), 200);
  }
}

} // namespace nephroid::display_test
