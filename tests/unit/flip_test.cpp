// SPDX-License-Identifier: Apache-2.0
// FLIP, HDR-FLIP and IW-SSIM against their authors' own programs, and what those leave undefined.
#include "measure/flip.h"
#include "measure/iw_ssim.h"
#include "tests/support/pictures.h"

namespace nephroid::flip_test {

using namespace nephroid::measure;

double mean(const std::vector<float>& map) {
  return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}
double flip(const Picture& a, const Picture& b) { return mean(flip_map(a.pixels(), b.pixels())); }
double hdr_flip(const Picture& a, const Picture& b) { return mean(hdr_flip_map(a.pixels(), b.pixels())); }

struct Figures {
  double ldr, hdr, iw_ssim;
};

// flip_evaluator 1.7 from PyPI, evaluate(..., inputsRGB=False): means of the maps in double precision. LDR of the
// pictures clipped to 0..1, HDR of them clipped below 0. iw_ssim: printed by iwssim.m of Wang and Li
// (iwssim_iwpsnr.zip) under GNU Octave 7.3 with the compiled pyramid of Simoncelli's matlabPyrTools 1.4 and MATLAB's
// bilinear imresize, from the luma of the same pictures in double precision.
const std::map<std::string, Figures> authors{{"noise", {0.14487641, 0.18688300, 0.793641947401}},
                                             {"weak noise", {0.01973916, 0.02030924, 0.998656458455}},
                                             {"blur", {0.02703314, 0.04276486, 0.983873510919}},
                                             {"shift", {0.18112727, 0.16193772, 0.932589416643}},
                                             {"hue", {0.78226281, 0.66810447, 0.761478286396}},
                                             {"half as bright", {0.63496169, 0.44914566, 0.968361013065}},
                                             {"high dynamic range", {0.12853041, 0.18955508, 0.822357012784}},
                                             {"odd sides", {0.14372816, 0.18168809, 0.795268461709}}};

TEST(Flip, IsTheAuthorsProgramOnEveryDistortion) {
  for (const test::Pair& pair : test::distorted_pairs()) {
    EXPECT_NEAR(flip(pair.picture, pair.reference), authors.at(pair.name).ldr, 2e-6) << pair.name;
    EXPECT_NEAR(hdr_flip(pair.picture, pair.reference), authors.at(pair.name).hdr, 2e-6) << pair.name;
  }
}

// As the same program prints them for these references.
TEST(Flip, ExposuresAreTheAuthors) {
  const Exposures plain = hdr_exposures(test::textured(192, 176).rgb);
  EXPECT_NEAR(plain.start, 1.4799718, 1e-5);
  EXPECT_NEAR(plain.stop, 2.3282511, 1e-5);
  EXPECT_EQ(plain.count, 2);
  const Exposures high = hdr_exposures(test::high_range(test::textured(192, 176)).rgb);
  EXPECT_NEAR(high.start, -2.3956327, 1e-5);
  EXPECT_NEAR(high.stop, 2.8064868, 1e-5);
  EXPECT_EQ(high.count, 6);
}

// Of 1, 0, 0 and 4 the median is sorted[2] = 1 and the maximum 4: the exposures end at 2.11887 and begin two stops
// below.
TEST(Flip, ExposuresByHand) {
  const float values[] = {1, 0, 0, 4};
  const Picture picture(2, 2, [&](int x, int y, int) { return values[2 * y + x]; });
  const Exposures e = hdr_exposures(picture.rgb);
  EXPECT_NEAR(e.stop, std::log2(2.11887), 1e-5);
  EXPECT_NEAR(e.start, std::log2(2.11887) - 2, 1e-5);
  EXPECT_EQ(e.count, 2);
}

TEST(Flip, EqualPicturesAreZeroAndOppositeOnesOne) {
  const Picture picture = test::textured(40, 70);
  EXPECT_EQ(flip(picture, picture), 0);
  EXPECT_EQ(hdr_flip(picture, picture), 0);
  // Green and blue are the largest distance that the metric knows.
  const Picture green(40, 70, [](int, int, int c) { return c == 1; }),
      blue(40, 70, [](int, int, int c) { return c == 2; });
  EXPECT_NEAR(flip(green, blue), 1, 1e-5);
}

TEST(Flip, LdrIsSymmetricAndSeesADisplayOnly) {
  const Picture b = test::textured(50, 40), a = test::with_noise(b, 0.5);
  EXPECT_NEAR(flip(a, b), flip(b, a), 1e-6);
  EXPECT_EQ(flip(flat(20, 20, 7), flat(20, 20, 1)), 0);
  EXPECT_EQ(flip(flat(20, 20, -7), flat(20, 20, 0)), 0);
  EXPECT_GT(hdr_flip(flat(20, 20, 7), flat(20, 20, 1)), 0.05);
}

// The picture is worked on in strips for every core. Upside down the strips end elsewhere, and a strip that saw too
// little of its neighbours would give another error there. The filters are symmetric, so nothing else changes but the
// order of the sums.
TEST(Flip, StripsLeaveNoTrace) {
  const auto upside_down = [](const Picture& p) {
    return Picture(p.width, p.height, [&](int x, int y, int c) { return p.at(x, p.height - 1 - y, c); });
  };
  const Picture b = test::textured(40, 333), a = test::with_noise(b, 0.5);
  const std::vector<float> map = flip_map(a.pixels(), b.pixels());
  const std::vector<float> turned = flip_map(upside_down(a).pixels(), upside_down(b).pixels());
  for (std::size_t y = 0; y < 333; ++y)
    for (std::size_t x = 0; x < 40; ++x)
      ASSERT_NEAR(map[y * 40 + x], turned[(332 - y) * 40 + x], 2e-4) << x << " " << y;
}

// The authors' program divides by the reference's maximum. Here a reference is never darker than 2^-23, so that what a
// picture has more than that is seen, and the error grows with it.
TEST(Flip, BlackReferencesAreDefined) {
  const Picture black = flat(30, 30, 0);
  const Exposures e = hdr_exposures(black.rgb);
  EXPECT_NEAR(e.start, std::log2(2.11887) + 23, 1e-4);
  EXPECT_EQ(e.start, e.stop);
  EXPECT_EQ(e.count, 2);
  EXPECT_EQ(hdr_flip(black, black), 0);
  EXPECT_GT(hdr_flip(flat(30, 30, 1), black), 0.5);
  EXPECT_LT(hdr_flip(flat(30, 30, 1e-9), black), hdr_flip(flat(30, 30, 1e-8), black));
  EXPECT_TRUE(std::isfinite(hdr_flip(flat(30, 30, 1e-20), flat(30, 30, 1e-30))));
}

TEST(Flip, HdrIsFiniteForEveryFiniteValue) {
  const float largest = std::numeric_limits<float>::max(), smallest = std::numeric_limits<float>::denorm_min();
  for (const float a : {0.0f, smallest, 1.0f, 1e6f, largest, -largest})
    for (const float b : {0.0f, smallest, 1.0f, 1e6f, largest, -largest}) {
      Picture spike = flat(12, 12, b);
      spike.at(3, 3, 0) = 1e30f;
      for (const float error : hdr_flip_map(flat(12, 12, a).pixels(), spike.pixels())) {
        ASSERT_GE(error, 0) << a << " " << b;
        ASSERT_LE(error, 1.00001f) << a << " " << b;
      }
    }
}

std::optional<double> iw_ssim(const Pixels& picture, const Pixels& reference, Mask mask = {}) {
  return iw_ssim_each(picture, reference, std::span(&mask, 1)).front();
}

double similarity(const Picture& a, const Picture& b, Mask mask = {}) {
  const std::optional<double> result = iw_ssim(a.pixels(), b.pixels(), mask);
  EXPECT_TRUE(result);
  return result.value_or(-1);
}

TEST(IwSsim, IsTheAuthorsProgramOnEveryDistortion) {
  for (const test::Pair& pair : test::distorted_pairs()) {
    double sum = 0;
    for (const float value : pair.picture.rgb) sum += value;
    EXPECT_NEAR(sum, pair.sum, 1e-2) << pair.name; // a last bit here and there may differ between libraries of sines
    EXPECT_NEAR(similarity(pair.picture, pair.reference), authors.at(pair.name).iw_ssim, 1e-7) << pair.name;
  }
}

TEST(IwSsim, EqualPicturesAreOneAndNothingIsMore) {
  const Picture picture = test::textured(161, 170);
  EXPECT_NEAR(similarity(picture, picture), 1, 1e-12);
  for (const test::Pair& pair : test::distorted_pairs())
    EXPECT_LT(similarity(pair.picture, pair.reference), 1) << pair.name;
}

TEST(IwSsim, IsNotSymmetric) {
  const Picture b = test::textured(170, 161), a = test::with_noise(b, 0.3);
  EXPECT_GT(std::fabs(similarity(a, b) - similarity(b, a)), 1e-5);
}

// Levels of flat pictures are 0 but for the last, which is 16 times the luma, as the low pass doubles four times. So
// only luminance at weight .1333 / 1.0001 counts: (2 x y + C) / (x^2 + y^2 + C), with C = (.01 255)^2.
TEST(IwSsim, FlatPicturesAreDefined) {
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
TEST(IwSsim, ANegativeIsNotSimilar) {
  const Picture b = test::textured(170, 170);
  EXPECT_EQ(similarity({170, 170, [&](int x, int y, int c) { return 1 - b.at(x, y, c); }}, b), 0);
}

TEST(IwSsim, ColoursBeyondADisplayAreClipped) {
  const Picture b = test::textured(170, 170);
  Picture above = b, below = b;
  for (int x = 0; x < 170; ++x) {
    above.at(x, 80, 0) = 1;
    below.at(x, 80, 0) = 9;
  }
  EXPECT_EQ(similarity(above, b), similarity(below, b));
}

TEST(IwSsim, SmallPicturesHaveNone) {
  EXPECT_EQ(iw_ssim(flat(160, 400, 0).pixels(), flat(160, 400, 0).pixels()), std::nullopt);
  EXPECT_EQ(iw_ssim(flat(400, 160, 0).pixels(), flat(400, 160, 0).pixels()), std::nullopt);
  EXPECT_NE(iw_ssim(flat(161, 161, 0).pixels(), flat(161, 161, 0).pixels()), std::nullopt);
}

TEST(IwSsim, AMaskLeavesOutWhatIsFarFromIt) {
  const Picture b = test::textured(400, 170);
  const Picture a(400, 170, [&](int x, int y, int c) {
    return b.at(x, y, c) + (x < 100 ? 0.4 * (test::hashed(x, y, c, 3) - 0.5) : 0);
  });
  std::vector<unsigned char> right(400 * 170), corner(400 * 170);
  for (std::size_t p = 0; p < right.size(); ++p)
    right[p] = p % 400 >= 280; // windows of the coarsest level reach 88 pixels and more
  corner[0] = 1;               // no window is centred there
  EXPECT_LT(similarity(a, b), 0.9);
  EXPECT_NEAR(similarity(a, b, right), 1, 1e-12);
  EXPECT_EQ(iw_ssim(a.pixels(), b.pixels(), corner), std::nullopt);
}

} // namespace nephroid::flip_test
