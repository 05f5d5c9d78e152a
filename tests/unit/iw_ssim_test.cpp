// SPDX-License-Identifier: Apache-2.0
// IW-SSIM against its authors' program, and where that program has no answer.
#include "measure/iw_ssim.h"
#include "tests/support/pictures.h"
#include "tests/support/test.h"

namespace nephroid::iw_ssim_test {

using namespace nephroid::measure;

std::optional<double> iw_ssim(const Pixels& picture, const Pixels& reference, Mask mask = {})
{
  return iw_ssim_each(picture, reference, std::span(&mask, 1)).front();
}

double similarity(const Picture& a, const Picture& b, Mask mask = {})
{
  const std::optional<double> result = iw_ssim(a.pixels(), b.pixels(), mask);
  EXPECT_TRUE(result);
  return result.value_or(-1);
}

// Printed by iwssim.m of Wang and Li (iwssim_iwpsnr.zip) under GNU Octave 7.3 with the compiled pyramid of Simoncelli's matlabPyrTools
// 1.4 and MATLAB's bilinear imresize, from the luma of the same pictures in double precision.
const std::map<std::string, double> authors{{"noise", 0.793641947401},
                                            {"weak noise", 0.998656458455},
                                            {"blur", 0.983873510919},
                                            {"shift", 0.932589416643},
                                            {"hue", 0.761478286396},
                                            {"half as bright", 0.968361013065},
                                            {"high dynamic range", 0.822357012784},
                                            {"odd sides", 0.795268461709}};

TEST(IwSsim, IsTheAuthorsProgramOnEveryDistortion)
{
  for (const test::Pair& pair : test::distorted_pairs()) {
    double sum = 0;
    for (const float value : pair.picture.rgb) sum += value;
    EXPECT_NEAR(sum, pair.sum, 1e-2) << pair.name; // a last bit here and there may differ between libraries of sines
    EXPECT_NEAR(similarity(pair.picture, pair.reference), authors.at(pair.name), 1e-7) << pair.name;
  }
}

TEST(IwSsim, EqualPicturesAreOneAndNothingIsMore)
{
  const Picture picture = test::textured(161, 170);
  EXPECT_NEAR(similarity(picture, picture), 1, 1e-12);
  for (const test::Pair& pair : test::distorted_pairs()) EXPECT_LT(similarity(pair.picture, pair.reference), 1) << pair.name;
}

TEST(IwSsim, IsNotSymmetric)
{
  const Picture b = test::textured(170, 161), a = test::with_noise(b, 0.3);
  EXPECT_GT(std::fabs(similarity(a, b) - similarity(b, a)), 1e-5);
}

// Levels of flat pictures are 0 but for the last, which is 16 times the luma, as the low pass doubles four times. So only luminance at
// weight .1333 / 1.0001 counts: (2 x y + C) / (x^2 + y^2 + C), with C = (.01 255)^2.
TEST(IwSsim, FlatPicturesAreDefined)
{
  const Picture dark = flat(170, 170, 0.25), light = flat(170, 170, 0.5);
  EXPECT_NEAR(similarity(dark, dark), 1, 1e-9);
  const double x = 16 * 255 * 0.5370987, y = 16 * 255 * 0.7353570, c = 2.55 * 2.55; // sRGB-encoded .25 and .5
  const double wanted = std::pow((2 * x * y + c) / (x * x + y * y + c), 0.1333 / 1.0001);
  EXPECT_NEAR(similarity(dark, light), wanted, 1e-6);
  EXPECT_NEAR(similarity(flat(161, 161, 0), flat(161, 161, 0)), 1, 1e-9);
  const double noisy = similarity(test::with_noise(light, 0.5), light);
  EXPECT_GT(noisy, 0);
  EXPECT_LT(noisy, 0.7);
  EXPECT_GT(similarity(test::with_noise(light, 0.01), light), noisy);
}

// The structure of a negative is the opposite: no similarity, rather than the power of a negative number.
TEST(IwSsim, ANegativeIsNotSimilar)
{
  const Picture b = test::textured(170, 170);
  EXPECT_EQ(similarity({170, 170, [&](int x, int y, int c) { return 1 - b.at(x, y, c); }}, b), 0);
}

TEST(IwSsim, ColoursBeyondADisplayAreClipped)
{
  const Picture b = test::textured(170, 170);
  Picture above = b, below = b;
  for (int x = 0; x < 170; ++x) {
    above.at(x, 80, 0) = 1;
    below.at(x, 80, 0) = 9;
  }
  EXPECT_EQ(similarity(above, b), similarity(below, b));
}

TEST(IwSsim, SmallPicturesHaveNone)
{
  EXPECT_EQ(iw_ssim(flat(160, 400, 0).pixels(), flat(160, 400, 0).pixels()), std::nullopt);
  EXPECT_EQ(iw_ssim(flat(400, 160, 0).pixels(), flat(400, 160, 0).pixels()), std::nullopt);
  EXPECT_NE(iw_ssim(flat(161, 161, 0).pixels(), flat(161, 161, 0).pixels()), std::nullopt);
}

TEST(IwSsim, AMaskLeavesOutWhatIsFarFromIt)
{
  const Picture b = test::textured(400, 170);
  const Picture a(400, 170, [&](int x, int y, int c) { return b.at(x, y, c) + (x < 100 ? 0.4 * (test::hashed(x, y, c, 3) - 0.5) : 0); });
  std::vector<unsigned char> right(400 * 170), corner(400 * 170);
  for (std::size_t p = 0; p < right.size(); ++p) right[p] = p % 400 >= 280; // windows of the coarsest level reach 88 pixels and more
  corner[0] = 1;                                                            // no window is centred there
  EXPECT_LT(similarity(a, b), 0.9);
  EXPECT_NEAR(similarity(a, b, right), 1, 1e-12);
  EXPECT_EQ(iw_ssim(a.pixels(), b.pixels(), corner), std::nullopt);
}

} // namespace nephroid::iw_ssim_test
