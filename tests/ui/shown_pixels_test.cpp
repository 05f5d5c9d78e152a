// SPDX-License-Identifier: Apache-2.0
// The window's fast bytes against image::shown, which files are written with.
#include "image/image.h"
#include "tests/support/test.h"
#include "ui/state/tone.h"

namespace nephroid::ui::shown_pixels_test {

TEST(ShownPixels, AreTheBytesOfImageShown)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-20, 4);
  for (int i = 0; i < 200000; ++i) {
    const float value = std::exp2(exponent(random));
    ASSERT_EQ(int(shown_byte(value)), int(image::shown(value, 1))) << value;
  }
}

TEST(ShownPixels, AreRightOnEitherSideOfEveryStep)
{
  for (int byte = 1; byte < 256; ++byte) {
    // The value that encodes to byte - 0.5 (IEC 61966-2-1), where rounding goes from one byte to the next.
    const double encoded = (byte - 0.5) / 255;
    const float value = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    EXPECT_EQ(int(shown_byte(value * 1.0005f)), byte);
    EXPECT_EQ(int(shown_byte(value * 0.9995f)), byte - 1);
    float near = value * 0.99999f; // and float by float, where the two have to step at the same one
    for (int i = 0; i < 400; ++i, near = std::nextafter(near, 2.0f)) ASSERT_EQ(int(shown_byte(near)), int(image::shown(near, 1))) << near;
  }
}

TEST(ShownPixels, TakeWhateverAFloatCanBe)
{
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(shown_byte(infinity), 255);
  EXPECT_EQ(shown_byte(-infinity), 0);
  EXPECT_EQ(shown_byte(-0.5f), 0);
  EXPECT_EQ(shown_byte(0), 0);
  EXPECT_EQ(shown_byte(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(shown_byte(std::numeric_limits<float>::max()), 255);
}

TEST(ShownPixels, ExposureIsInStops)
{
  const std::vector<float> rgb{0.1f, 0.2f, 0.4f, 0.8f, 0, 1};
  std::vector<unsigned char> bytes(8), brighter(8);
  toned_pixels(rgb, {}, bytes);
  toned_pixels(rgb, {ToneCurve::standard, 1, {}}, brighter);
  EXPECT_EQ(brighter[0], bytes[1]);
  EXPECT_EQ(brighter[1], bytes[2]);
  EXPECT_EQ(brighter[2], bytes[4]);
  EXPECT_EQ(bytes[3], 255);
  EXPECT_EQ(bytes[7], 255);
}

} // namespace nephroid::ui::shown_pixels_test
