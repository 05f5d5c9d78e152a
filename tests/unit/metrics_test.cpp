// SPDX-License-Identifier: Apache-2.0
// The metrics on pictures whose figures a person can compute, their laws (symmetry, masks, order), and what is refused.
#include "measure/lab.h"
#include "measure/metrics.h"
#include "optics/colour.h"
#include "tests/support/pictures.h"

namespace nephroid::metrics_test {

using namespace nephroid::measure;

constexpr double infinity = std::numeric_limits<double>::infinity();

Metrics quick(const Picture& a, const Picture& b, Mask mask = {}) {
  return compare(a.pixels("a"), b.pixels("b"), mask, MetricSet::quick);
}

Picture stripes(int phase) {
  return {12, 4, [=](int x, int, int) { return (x + phase) % 2; }};
}

TEST(Metrics, IdenticalPicturesDifferInNothing) {
  const Picture picture = test::textured(170, 165);
  const Metrics m = compare(picture.pixels(), picture.pixels());
  EXPECT_THAT((std::array{m.lab_max, m.lab_mean, m.lab_rms, m.mse, m.rel_mse, m.rel_l2}), Each(0));
  EXPECT_EQ(m.psnr_db, std::nullopt);
  EXPECT_THAT(m.iw_ssim, Optional(DoubleNear(1, 1e-12)));
  EXPECT_THAT(m.flip, Optional(0.0));
  EXPECT_THAT(m.hdr_flip, Optional(0.0));
  EXPECT_EQ(m.pixels, 170u * 165u);
}

// Greys of .5 against .25. (a - b)^2 = 1/16; over .25^2 + .01 it is .0625 / .0725; |a - b| / |b| = 1. Encoded: 1.055
// v^(1/2.4) - .055 gives .735357 and .537099, whose distance .198258 is 14.0556 dB. L* = 116 v^(1/3) - 16, and a grey's
// a* and b* are 0 to 1e-2.
TEST(Metrics, FlatGreys) {
  const Metrics m = quick(flat(5, 7, 0.5), flat(5, 7, 0.25));
  EXPECT_NEAR(m.mse, 1.0 / 16, 1e-12);
  EXPECT_NEAR(m.rel_mse, 0.0625 / 0.0725, 1e-12);
  EXPECT_NEAR(m.rel_l2, 1, 1e-12);
  EXPECT_THAT(m.psnr_db, Optional(DoubleNear(14.0556, 1e-3)));
  const double lightness = 116 * (std::cbrt(0.5) - std::cbrt(0.25));
  EXPECT_THAT((std::array{m.lab_mean, m.lab_rms, m.lab_max}), Each(DoubleNear(lightness, 1e-5)));
}

// One white pixel among 16, the reference black: the sums have one pixel of three ones. L* of white is 100.
TEST(Metrics, OnePixel) {
  Picture a = flat(4, 4, 0);
  for (int c = 0; c < 3; ++c) a.at(2, 1, c) = 1;
  const Metrics m = quick(a, flat(4, 4, 0));
  EXPECT_NEAR(m.mse, 1.0 / 16, 1e-15);
  EXPECT_NEAR(m.rel_mse, 100.0 / 16, 1e-12);
  EXPECT_EQ(m.rel_l2, infinity);
  EXPECT_THAT(m.psnr_db, Optional(DoubleNear(10 * std::log10(16.0), 1e-12)));
  EXPECT_NEAR(m.lab_max, 100, 1e-4);
  EXPECT_NEAR(m.lab_mean, 100.0 / 16, 1e-5);
  EXPECT_NEAR(m.lab_rms, 100.0 / 4, 1e-4);
}

TEST(Metrics, WhiteAndBlack) {
  const Picture white = flat(3, 3, 1), black = flat(3, 3, 0);
  const Metrics on_black = quick(white, black), on_white = quick(black, white);
  EXPECT_NEAR(on_black.lab_mean, 100, 1e-4);
  EXPECT_EQ(on_black.rel_l2, infinity);
  EXPECT_NEAR(on_black.rel_mse, 100, 1e-12);
  EXPECT_THAT(on_black.psnr_db, Optional(DoubleNear(0, 1e-12)));
  EXPECT_NEAR(on_white.rel_l2, 1, 1e-15);
  EXPECT_NEAR(on_white.rel_mse, 1 / 1.01, 1e-12);
  const Metrics nothing = quick(black, black);
  EXPECT_EQ(nothing.rel_l2, 0);
  EXPECT_EQ(nothing.rel_mse, 0);
  EXPECT_EQ(nothing.psnr_db, std::nullopt);
}

// Green for red. CIELAB of the sRGB primaries as converters print it: (53.24, 80.09, 67.20) and (87.73, -86.18, 83.18),
// whose distance is sqrt(34.49^2 + 166.27^2 + 15.98^2) = 170.56. Two of three channels differ by 1, red's over 1.01 and
// green's over .01.
TEST(Metrics, HueTurned) {
  const Picture red(4, 3, [](int, int, int c) { return c == 0; }), green(4, 3, [](int, int, int c) { return c == 1; });
  const Metrics m = quick(green, red);
  EXPECT_NEAR(m.lab_mean, 170.56, 0.03);
  EXPECT_NEAR(m.mse, 2.0 / 3, 1e-12);
  EXPECT_NEAR(m.rel_mse, (1 / 1.01 + 100) / 3, 1e-12);
  EXPECT_NEAR(m.rel_l2, std::sqrt(2.0), 1e-12);
  EXPECT_THAT(m.psnr_db, Optional(DoubleNear(-10 * std::log10(2.0 / 3), 1e-12)));
}

// Stripes of 0 and 1 moved by one: every pixel differs by 1, and half the reference is 1.
TEST(Metrics, Shifted) {
  const Metrics m = quick(stripes(1), stripes(0));
  EXPECT_NEAR(m.mse, 1, 1e-15);
  EXPECT_NEAR(m.rel_mse, (100 + 1 / 1.01) / 2, 1e-12);
  EXPECT_NEAR(m.rel_l2, std::sqrt(2.0), 1e-12);
  EXPECT_THAT(m.psnr_db, Optional(DoubleNear(0, 1e-12)));
  EXPECT_NEAR(m.lab_mean, 100, 1e-4);
}

// The same stripes blurred to their mean: every pixel is off by .5. Encoded, .5 is .735357: off by that from black and
// by .264643 from white. L*(.5) = 116 cbrt(.5) - 16 = 76.0693: off by that, and by 23.9307.
TEST(Metrics, Blurred) {
  const Metrics m = quick(flat(12, 4, 0.5), stripes(0));
  EXPECT_NEAR(m.mse, 0.25, 1e-15);
  EXPECT_NEAR(m.rel_mse, 0.25 * (100 + 1 / 1.01) / 2, 1e-12);
  EXPECT_NEAR(m.rel_l2, std::sqrt(0.5), 1e-12);
  EXPECT_THAT(m.psnr_db, Optional(DoubleNear(-10 * std::log10((0.735357 * 0.735357 + 0.264643 * 0.264643) / 2), 1e-4)));
  EXPECT_NEAR(m.lab_mean, 50, 1e-4);
  EXPECT_NEAR(m.lab_rms, std::sqrt((76.0693 * 76.0693 + 23.9307 * 23.9307) / 2), 1e-4);
  EXPECT_NEAR(m.lab_max, 76.0693, 1e-4);
}

// 4 against 2, both above white: what a display shows is equal (no PSNR), what was measured is not: 116 (cbrt 4 - cbrt
// 2) = 37.988.
TEST(Metrics, HighDynamicRangeIsNotClipped) {
  const Metrics m = quick(flat(2, 2, 4), flat(2, 2, 2));
  EXPECT_EQ(m.psnr_db, std::nullopt);
  EXPECT_NEAR(m.lab_mean, 116 * (std::cbrt(4.0) - std::cbrt(2.0)), 1e-5);
  EXPECT_NEAR(m.mse, 4, 1e-12);
  EXPECT_NEAR(m.rel_mse, 4 / 4.01, 1e-12);
  EXPECT_NEAR(m.rel_l2, 1, 1e-12);
}

TEST(Metrics, TheLargestFloatsStayFinite) {
  const float largest = std::numeric_limits<float>::max();
  const Metrics m = compare(flat(180, 170, largest).pixels(), flat(180, 170, -largest).pixels());
  for (const auto& [name, value] : named(m)) EXPECT_TRUE(std::isfinite(value)) << name << " " << value;
  EXPECT_NEAR(m.rel_l2, 2, 1e-12);
}

/// CIELAB of CIE 015 with the white of xy = .3127 / .3290, Y = 1; lightness() has its root.
optics::Colour exact_lab(const optics::Colour& xyz) {
  const auto root = [](double t) { return (optics::lightness(t) + 16) / 116; };
  const double x = root(xyz[0] * 0.3290 / 0.3127), y = root(xyz[1]), z = root(xyz[2] * 0.3290 / (1 - 0.3127 - 0.3290));
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// optics/colour.h is the truth; this folder's faster way is held to 1e-12 of it, far outside the gamut too.
TEST(Metrics, FastColourIsTheColourOfOptics) {
  for (int i = 0; i < 20'000; ++i) {
    const double range = std::exp2(40 * (test::hashed(i, 0, 3, 9) - 0.5));
    float rgb[3];
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(range * (test::hashed(i, 0, c, 9) - 0.2));
    const optics::Colour truth = exact_lab(optics::linear_srgb_to_xyz({rgb[0], rgb[1], rgb[2]}));
    const auto lab = lab_of(rgb);
    const double size = 1e-12 * (1000 + std::fabs(truth[0]) + std::fabs(truth[1]) + std::fabs(truth[2]));
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(lab[c], truth[c], size) << rgb[0] << " " << rgb[1] << " " << rgb[2];
    ASSERT_NEAR(encode_clipped(rgb[0]), optics::srgb_encode(std::clamp(double{rgb[0]}, 0.0, 1.0)), 1e-14);
  }
  EXPECT_EQ(encode_clipped(-1), 0);
  EXPECT_EQ(encode_clipped(0), 0);
  EXPECT_EQ(encode_clipped(1), 1);
}

// Lab of the sRGB primaries as every converter prints them (D65).
TEST(Metrics, LabOfKnownColours) {
  const std::array<float, 3> colours[] = {{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  const std::array<double, 3> labs[] = {
      {100, 0, 0}, {53.24, 80.09, 67.20}, {87.73, -86.18, 83.18}, {32.30, 79.19, -107.86}, {0, 0, 0}};
  for (std::size_t i = 0; i < std::size(labs); ++i)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(lab_of(colours[i].data())[c], labs[i][c], 0.05) << i << " " << c;
}

TEST(Metrics, SomeAreSymmetric) {
  const Picture b = test::textured(65, 43), a = test::with_noise(b, 0.3);
  const Metrics there = quick(a, b), back = quick(b, a);
  EXPECT_DOUBLE_EQ(there.lab_mean, back.lab_mean);
  EXPECT_DOUBLE_EQ(there.lab_rms, back.lab_rms);
  EXPECT_DOUBLE_EQ(there.lab_max, back.lab_max);
  EXPECT_DOUBLE_EQ(there.mse, back.mse);
  EXPECT_DOUBLE_EQ(*there.psnr_db, *back.psnr_db);
  EXPECT_NE(there.rel_mse, back.rel_mse); // over the reference
}

TEST(Metrics, MoreNoiseIsWorseByEveryMetric) {
  const Picture b = test::textured(176, 163);
  std::vector<std::pair<std::string, double>> before;
  for (const double amplitude : {0.01, 0.04, 0.16, 0.64}) {
    const auto now = named(compare(test::with_noise(b, amplitude).pixels(), b.pixels()));
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool more_is_better = now[i].first == "psnr_db" || now[i].first == "iw_ssim";
      EXPECT_GT(more_is_better ? before[i].second - now[i].second : now[i].second - before[i].second, 0)
          << now[i].first << " " << amplitude;
    }
    before = now;
  }
  ASSERT_EQ(before.size(), 10u);
}

TEST(Metrics, AMaskOfEverythingIsNoMask) {
  const Picture b = test::textured(170, 161), a = test::with_noise(b, 0.2);
  const std::vector<unsigned char> all(170 * 161, 7);
  EXPECT_EQ(named(compare(a.pixels(), b.pixels(), all)), named(compare(a.pixels(), b.pixels())));
}

// Outside the mask the pictures differ wildly, and inside they are the pixels of a smaller pair.
TEST(Metrics, AMaskSelectsItsPixelsAndNoOthers) {
  const Picture b = test::textured(30, 20);
  Picture a = test::with_noise(b, 0.2);
  std::vector<unsigned char> mask(30 * 20, 0);
  for (int y = 5; y < 12; ++y)
    for (int x = 7; x < 20; ++x) mask[static_cast<std::size_t>(y * 30 + x)] = 1;
  const auto part = [](const Picture& of) {
    return Picture(13, 7, [&](int x, int y, int c) { return of.at(x + 7, y + 5, c); });
  };
  const Metrics wanted = quick(part(a), part(b));
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 30; ++x)
      if (mask[static_cast<std::size_t>(y * 30 + x)] == 0) a.at(x, y, 1) += 1000;
  const Metrics m = quick(a, b, mask);
  EXPECT_EQ(m.pixels, 13u * 7u);
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_DOUBLE_EQ(named(m)[i].second, named(wanted)[i].second) << named(m)[i].first; // the quick ones
}

TEST(Metrics, SeveralMasksAreTheSameAsOneByOne) {
  const Picture b = test::textured(165, 165), a = test::with_noise(b, 0.2);
  std::vector<unsigned char> left(165 * 165);
  for (std::size_t p = 0; p < left.size(); ++p) left[p] = p % 165 < 90;
  const Mask masks[] = {{}, left};
  const std::vector<Metrics> both = compare_each(a.pixels(), b.pixels(), masks);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(named(both[0]), named(compare(a.pixels(), b.pixels())));
  EXPECT_EQ(named(both[1]), named(compare(a.pixels(), b.pixels(), left)));
  EXPECT_NE(both[0].iw_ssim, both[1].iw_ssim);
}

TEST(Metrics, OneComparisonServesManyPictures) {
  const Picture b = test::textured(33, 21);
  const QuickComparison comparison(b.pixels("b"));
  for (const double amplitude : {0.1, 0.0, 0.5}) {
    const Picture a = test::with_noise(b, amplitude);
    EXPECT_EQ(comparison.against(a.pixels()).lab_rms, quick(a, b).lab_rms);
  }
  EXPECT_THAT(refusal_of([&] { comparison.against(flat(33, 20, 0).pixels("a")); }),
              HasSubstr("a: is 33 x 20 pixels; expected 33 x 21"));
}

TEST(Metrics, EverySizeHasWhatItCanHave) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {160, 200}, {161, 161}, {163, 201}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    const Picture b = test::textured(width, height), a = test::with_noise(b, 0.1);
    const Metrics m = compare(a.pixels(), b.pixels());
    EXPECT_EQ(m.iw_ssim.has_value(), width >= 161 && height >= 161);
    EXPECT_TRUE(m.flip && *m.flip > 0 && *m.flip < 1);
    EXPECT_TRUE(m.hdr_flip && *m.hdr_flip > 0 && *m.hdr_flip < 1);
    EXPECT_GT(m.lab_mean, 0);
    EXPECT_EQ(m.pixels, static_cast<std::size_t>(width * height));
  }
}

TEST(Metrics, QuickOnesComeWithoutTheOthers) {
  const Picture b = test::textured(170, 170);
  const Metrics m = quick(test::with_noise(b, 0.1), b);
  EXPECT_FALSE(m.iw_ssim || m.flip || m.hdr_flip);
  EXPECT_TRUE(m.psnr_db);
}

TEST(Metrics, NamesAreThoseOfTheContract) {
  std::vector<std::string> names;
  for (const auto& [name, value] : named(Metrics{})) names.push_back(name);
  EXPECT_THAT(names, ElementsAre("lab_mean", "lab_rms", "lab_max", "mse", "rel_mse", "rel_l2", "psnr_db", "iw_ssim",
                                 "flip", "hdr_flip"));
}

TEST(Metrics, BadPicturesAreRefusedWithTheirPixel) {
  const Picture good = flat(6, 4, 0.5);
  EXPECT_EQ(refusal_of([&] { quick(flat(6, 5, 0), good); }), "a: is 6 x 5 pixels; expected 6 x 4, the size of b");
  Picture bad = good;
  bad.at(3, 2, 1) = std::numeric_limits<float>::quiet_NaN();
  bad.at(4, 3, 0) = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refusal_of([&] { quick(bad, good); }), "a: pixel (3, 2) has NaN in G; expected finite values everywhere");
  EXPECT_EQ(refusal_of([&] { quick(good, bad); }), "b: pixel (3, 2) has NaN in G; expected finite values everywhere");
  bad.at(3, 2, 1) = 0;
  EXPECT_THAT(refusal_of([&] { quick(bad, good); }), HasSubstr("a: pixel (4, 3) has infinity in R"));
  bad.at(0, 0, 2) = -std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal_of([&] { quick(bad, good); }), HasSubstr("a: pixel (0, 0) has -infinity in B"));
}

TEST(Metrics, TheFirstBadPixelOfALargePictureIsNamed) {
  const Picture good = flat(600, 300, 0.5);
  Picture bad = good;
  for (int y = 20; y < 300; y += 40) bad.at(599, y, 2) = std::numeric_limits<float>::quiet_NaN();
  for (int again = 0; again < 5; ++again)
    EXPECT_THAT(refusal_of([&] { quick(bad, good); }), HasSubstr("pixel (599, 20) has NaN in B"));
}

TEST(Metrics, BadMasksAreRefused) {
  const Picture picture = flat(6, 4, 0.5);
  const std::vector<unsigned char> black(24, 0), small(23, 1);
  EXPECT_EQ(refusal_of([&] { quick(picture, picture, black); }),
            "mask: is all black: no pixel counts; expected a mask with pixels that are not 0");
  EXPECT_EQ(refusal_of([&] { quick(picture, picture, small); }),
            "mask: has 23 pixels; expected 6 x 4, as the pictures");
}

} // namespace nephroid::metrics_test
