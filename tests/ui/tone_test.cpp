// SPDX-License-Identifier: Apache-2.0
// Bytes of the shown picture: false colour against closed forms, the steps of the sRGB encoding.
#include "image/image.h"
#include "measure/difference.h"
#include "tests/support/test.h"
#include "ui/state/tone.h"

namespace nephroid::ui::tone_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr float float_nan = std::numeric_limits<float>::quiet_NaN(),
                float_infinity = std::numeric_limits<float>::infinity();

Rgb8 toned(const std::vector<float>& rgb, const Tone& tone) {
  std::vector<unsigned char> bytes(4);
  toned_pixels(rgb, tone, bytes);
  EXPECT_EQ(bytes[3], 255);
  return {bytes[0], bytes[1], bytes[2]};
}

TEST(FalseColour, IsTheMapOverTheLogarithm) {
  const LuminanceRange range{0.01, 100};
  EXPECT_EQ(luminance_colour(0.01, range), measure::map_colour(0));
  EXPECT_EQ(luminance_colour(1, range), measure::map_colour(0.5)) << "two of four decades";
  EXPECT_EQ(luminance_colour(10, range), measure::map_colour(0.75));
  EXPECT_EQ(luminance_colour(1e9, range), measure::map_colour(1));
  EXPECT_EQ(luminance_colour(0, range), measure::map_colour(0));
}

TEST(FalseColour, OfPixelsIsThatOfTheirLuminance) {
  const Tone tone{{}, LuminanceRange{0.001, 1000}, 2};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-12, 12);
  std::vector<float> rgb;
  for (int i = 0; i < 20000; ++i) rgb.insert(rgb.end(), 3, std::exp2(exponent(random)));
  std::vector<unsigned char> bytes(4 * rgb.size() / 3);
  toned_pixels(rgb, tone, bytes);
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) { // Y of a grey is the grey; times the white of 2
    const Rgb8 wanted = luminance_colour(2.0 * static_cast<double>(rgb[3 * i]), *tone.false_colour);
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(bytes[4 * i + c], wanted[c], 1) << rgb[3 * i];
  }
}

TEST(FalseColour, MarksWhatIsNoLuminance) {
  const Tone tone{{}, LuminanceRange{0.01, 1}, 1};
  EXPECT_EQ(toned({0.5f, float_nan, 0.5f}, tone), nan_colour);
  EXPECT_EQ(toned({float_infinity, float_nan, 0}, tone), nan_colour) << "NaN goes first";
  EXPECT_EQ(toned({0, 0, float_infinity}, tone), infinite_colour);
  EXPECT_EQ(toned({0, 0, -float_infinity}, tone), infinite_colour);
  EXPECT_EQ(toned({float_infinity, -float_infinity, 0}, tone), infinite_colour)
      << "their luminance is NaN, they are not";
  EXPECT_EQ(toned({0, -0.1f, 0}, tone), negative_colour);
  EXPECT_EQ(toned({-0.1f, 0.5f, 0}, tone), luminance_colour(0.7152 * 0.5 - 0.2126 * 0.1, *tone.false_colour))
      << "a colour outside of sRGB is light";
  EXPECT_EQ(toned({0, 0, 0}, tone), measure::map_colour(0));
  for (int i = 0; i <= 1000; ++i) // no luminance is mistaken for a mark
    for (const Rgb8& mark : {nan_colour, infinite_colour, negative_colour}) {
      const Rgb8 colour = measure::map_colour(i / 1000.0);
      int distance = 0;
      for (std::size_t c = 0; c < 3; ++c) distance += std::abs(colour[c] - mark[c]);
      EXPECT_GT(distance, 120) << i;
    }
}

TEST(AutomaticRange, IsRoundAndHoldsNearlyAll) {
  // A thousand greys from 0.003 up to 7: 1 % are below .0107, 99.9 % below 6.993.
  std::vector<float> rgb;
  for (int i = 0; i < 1000; ++i)
    for (int c = 0; c < 3; ++c) rgb.push_back(0.003f + 0.007f * static_cast<float>(i) * (6.997f / 6.993f));
  const LuminanceRange range = automatic_range(rgb, 1);
  EXPECT_NEAR(range.low, 0.05, 1e-12) << "the hundredth is .073";
  EXPECT_NEAR(range.high, 10, 1e-9);
  const LuminanceRange brighter = automatic_range(rgb, 1000);
  EXPECT_NEAR(brighter.high, 10000, 1e-6);
}

TEST(AutomaticRange, OfOddPictures) {
  EXPECT_EQ(automatic_range(std::vector<float>{}, 1), (LuminanceRange{0.01, 1}));
  EXPECT_EQ(automatic_range(std::vector<float>{float_nan, 0, 0, -1, -1, -1, 0, 0, 0, float_infinity, 0, 0}, 1),
            (LuminanceRange{0.01, 1}));
  const LuminanceRange even = automatic_range(std::vector<float>{3, 3, 3}, 1);
  EXPECT_GE(even.high / even.low, 10) << "a decade at least";
  EXPECT_LE(even.low, 3);
  EXPECT_GE(even.high, 3);
  std::vector<float> wide{1e-30f, 1e-30f, 1e-30f, 1e20f, 1e20f, 1e20f};
  const LuminanceRange widest = automatic_range(wide, 1);
  EXPECT_LE(widest.high / widest.low, 1e9) << "eight decades, and what makes them round";
  EXPECT_GE(widest.high, 1e20);
}

TEST(ValidRange, IsMadeOfWhatIsTyped) {
  EXPECT_EQ(valid_range({0.5, 2}), (LuminanceRange{0.5, 2}));
  EXPECT_FALSE(valid_range({nan, 1}));
  EXPECT_FALSE(valid_range({1, std::numeric_limits<double>::infinity()}));
  EXPECT_FALSE(valid_range({0.1, 0}));
  const auto turned = valid_range({5, 1});
  ASSERT_TRUE(turned);
  EXPECT_LT(turned->low, turned->high);
  const auto tiny = valid_range({0, 1e-300});
  ASSERT_TRUE(tiny);
  EXPECT_GT(tiny->low, 0);
  EXPECT_LT(tiny->low, tiny->high);
}

TEST(ShownPixels, AreRightOnEitherSideOfEveryStep) {
  for (int byte = 1; byte < 256; ++byte) {
    // The value that encodes to byte - 0.5 (IEC 61966-2-1), where rounding goes from one byte to the next.
    const double encoded = (byte - 0.5) / 255;
    const float value =
        static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    EXPECT_EQ(int(image::shown(value * 1.0005f)), byte);
    EXPECT_EQ(int(image::shown(value * 0.9995f)), byte - 1);
  }
}

TEST(ShownPixels, ExposureIsInStops) {
  const std::vector<float> rgb{0.1f, 0.2f, 0.4f, 0.8f, 0, 1};
  std::vector<unsigned char> bytes(8), brighter(8);
  toned_pixels(rgb, {}, bytes);
  toned_pixels(rgb, tone_of({.exposure_stops = 1}, {}, 1, rgb), brighter);
  EXPECT_EQ(brighter[0], bytes[1]);
  EXPECT_EQ(brighter[1], bytes[2]);
  EXPECT_EQ(brighter[2], bytes[4]);
  EXPECT_EQ(bytes[3], 255);
  EXPECT_EQ(bytes[7], 255);
}

} // namespace nephroid::ui::tone_test
