// SPDX-License-Identifier: Apache-2.0
// Difference pictures: each map on values computed by hand, the colours, where they end, and the numbers drawn beside
// them.
#include "measure/difference.h"
#include "tests/support/pictures.h"

namespace nephroid::difference_test {

using namespace nephroid::measure;
using Bytes = std::array<unsigned char, 3>;

/// The value of a metric between two pictures of one pixel.
double value(const std::array<double, 3>& a, const std::array<double, 3>& b, DifferenceMetric metric) {
  const auto of = [](const std::array<double, 3>& v) {
    return Picture(1, 1, [&](int, int, int c) { return v[static_cast<std::size_t>(c)]; });
  };
  return difference_map(of(a).pixels(), of(b).pixels(), metric).at(0);
}

TEST(Difference, MapsByHand) {
  const std::array<double, 3> a{0.5, 0.25, 1}, b{0.25, 0.5, 1};
  EXPECT_NEAR(value(a, b, DifferenceMetric::absolute), (0.25 + 0.25 + 0) / 3, 1e-7);
  EXPECT_NEAR(value(a, b, DifferenceMetric::relative), (0.25 / 0.26 + 0.25 / 0.51) / 3, 1e-7);
  EXPECT_NEAR(value(a, b, DifferenceMetric::square), 2 * 0.0625 / 3, 1e-7);
  EXPECT_NEAR(value(a, b, DifferenceMetric::luminance), 0.25 * 0.2126 - 0.25 * 0.7152, 1e-7);
  EXPECT_NEAR(value(b, a, DifferenceMetric::luminance), 0.25 * 0.7152 - 0.25 * 0.2126, 1e-7);
  EXPECT_NEAR(value({1, 1, 1}, {0, 0, 0}, DifferenceMetric::lab), 100, 1e-4);
  EXPECT_NEAR(value({0, 1, 0}, {1, 0, 0}, DifferenceMetric::lab), 170.56, 0.03); // metrics_test.cpp: HueTurned
  EXPECT_NEAR(value({1, 1, 1}, {1, 1, 1}, DifferenceMetric::flip), 0, 1e-7);
  EXPECT_NEAR(value({0, 1, 0}, {0, 0, 1}, DifferenceMetric::flip), 1, 1e-5);
  EXPECT_NEAR(value({-1, -1, -1}, {0.5, 0.5, 0.5}, DifferenceMetric::relative), 1.5 / 0.51, 1e-6);
}

TEST(Difference, MapsAreFiniteForEveryFiniteValue) {
  const double largest = std::numeric_limits<float>::max();
  for (const DifferenceMetric metric :
       {DifferenceMetric::lab, DifferenceMetric::absolute, DifferenceMetric::relative, DifferenceMetric::square,
        DifferenceMetric::luminance, DifferenceMetric::flip}) {
    const double at = value({largest, largest, largest}, {-largest, -largest, -largest}, metric);
    EXPECT_TRUE(std::isfinite(at)) << difference_names[static_cast<std::size_t>(metric)];
  }
}

TEST(Difference, MeansOfMapsAreTheMetrics) {
  const Picture b = test::textured(50, 30), a = test::with_noise(b, 0.2);
  const Metrics metrics = compare(a.pixels(), b.pixels());
  const auto mean = [&](DifferenceMetric metric) {
    double sum = 0;
    for (const float v : difference_map(a.pixels(), b.pixels(), metric)) sum += v;
    return sum / (50 * 30);
  };
  EXPECT_NEAR(mean(DifferenceMetric::lab), metrics.lab_mean, 1e-5);
  EXPECT_NEAR(mean(DifferenceMetric::square), metrics.mse, 1e-8);
  EXPECT_NEAR(mean(DifferenceMetric::flip), *metrics.flip, 1e-6);
}

TEST(Difference, ColoursEndAtARoundNumber) {
  const auto scale = [](std::vector<float> values) { return colour_scale(values); };
  EXPECT_EQ(scale({}), 1e-6);
  EXPECT_EQ(scale({0}), 1e-6);
  EXPECT_EQ(scale({1}), 1);
  EXPECT_EQ(scale({-1}), 1);
  EXPECT_EQ(scale({1.1f}), 2);
  EXPECT_EQ(scale({2.1f}), 5);
  EXPECT_EQ(scale({5.1f}), 10);
  EXPECT_DOUBLE_EQ(scale({0.03f}), 0.05);
  EXPECT_DOUBLE_EQ(scale({std::numeric_limits<float>::max()}), 5e38);
  std::vector<float> hundred(100, 0.5f);
  hundred[3] = 1000; // one of a hundred may lie beyond
  EXPECT_DOUBLE_EQ(colour_scale(hundred), 0.5);
  hundred[4] = -1000;
  EXPECT_DOUBLE_EQ(colour_scale(hundred), 1000);
}

// Ends of matplotlib's magma, (0.001462, 0.000466, 0.013866) and (0.987053, 0.991438, 0.749504), and of ColorBrewer's
// RdBu.
TEST(Difference, ColoursAreThePublishedOnes) {
  EXPECT_EQ(map_colour(0), (Bytes{0, 0, 4}));
  EXPECT_EQ(map_colour(1), (Bytes{252, 253, 191}));
  EXPECT_EQ(map_colour(-3), map_colour(0));
  EXPECT_EQ(map_colour(7), map_colour(1));
  EXPECT_EQ(map_colour(std::numeric_limits<double>::quiet_NaN()), map_colour(0));
  EXPECT_EQ(map_colour(0, true), (Bytes{5, 48, 97}));
  EXPECT_EQ(map_colour(0.5, true), (Bytes{247, 247, 247}));
  EXPECT_EQ(map_colour(1, true), (Bytes{103, 0, 31}));
}

TEST(Difference, MagmaGrowsLighter) {
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const Bytes c = map_colour(i / 100.0);
    const double luma = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
    EXPECT_GT(luma, before - 0.5) << i; // the bytes are rounded
    before = luma;
  }
}

Bytes colour_at(const ColouredDifference& picture, int x, int y) {
  const std::size_t at =
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
  EXPECT_EQ(picture.rgba.at(at + 3), 255);
  return {picture.rgba.at(at), picture.rgba.at(at + 1), picture.rgba.at(at + 2)};
}

TEST(Difference, ThePictureIsTheMapInItsColours) {
  Picture b = flat(40, 130, 0.5), a = b;
  for (int c = 0; c < 3; ++c) {
    a.at(3, 5, c) += 0.25f;
    a.at(4, 5, c) -= 0.5f;
  }
  const ColouredDifference absolute = coloured_difference(a.pixels(), b.pixels(), DifferenceMetric::absolute, 0.5);
  EXPECT_EQ(absolute.scale, 0.5);
  EXPECT_EQ(colour_at(absolute, 0, 0), map_colour(0));
  EXPECT_EQ(colour_at(absolute, 3, 5), map_colour(0.5));
  EXPECT_EQ(colour_at(absolute, 4, 5), map_colour(1));
  const ColouredDifference luminance = coloured_difference(a.pixels(), b.pixels(), DifferenceMetric::luminance, 0.5);
  EXPECT_EQ(colour_at(luminance, 0, 0), map_colour(0.5, true));
  EXPECT_EQ(colour_at(luminance, 3, 5), map_colour(0.75, true));
  EXPECT_EQ(colour_at(luminance, 4, 5), map_colour(0, true));
}

TEST(Difference, TheScaleStandsBesideThePicture) {
  const Picture b = test::textured(60, 200), a = test::with_noise(b, 0.2);
  const ColouredDifference picture = coloured_difference(a.pixels(), b.pixels(), DifferenceMetric::absolute);
  const ColourBar bar = colour_bar(200, picture.scale, false);
  EXPECT_EQ(picture.height, 200);
  EXPECT_EQ(picture.width, 60 + bar.width);
  // Down the middle of the bar the colours go from the lightest to the darkest.
  std::vector<Bytes> column;
  for (int y = 0; y < picture.height; ++y) column.push_back(colour_at(picture, 60 + 13 * bar.unit, y));
  const auto first = std::find(column.begin(), column.end(), map_colour(1 - 0.5 / 188));
  const auto last = std::find(column.begin(), column.end(), map_colour(0.5 / 188));
  ASSERT_NE(first, column.end());
  EXPECT_EQ(last - first, 187);
}

TEST(Difference, EveryPictureHasRoomForItsNumbers) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {300, 1}, {3, 900}}) {
    const ColouredDifference picture = coloured_difference(
        flat(width, height, 1).pixels(), flat(width, height, 0).pixels(), DifferenceMetric::luminance);
    EXPECT_GE(picture.height, 36);
    EXPECT_GT(picture.width, width + 40);
    EXPECT_EQ(picture.rgba.size(), std::size_t(4) * std::size_t(picture.width) * std::size_t(picture.height));
  }
}

/// Rows of a drawn number, '#' where there is ink.
std::vector<std::string> drawn(const char* text, int width) {
  Bitmap bitmap(width, 9), empty(width, 9);
  draw_number(bitmap, 0, 0, 1, text);
  std::vector<std::string> rows(9, std::string(static_cast<std::size_t>(width), ' '));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t x = 0; x < rows[i].size(); ++x) {
      const std::size_t at = 4 * (i * rows[i].size() + x);
      if (bitmap.rgba[at] != empty.rgba[at]) rows[i][x] = '#';
    }
  return rows;
}

TEST(Difference, NumbersAreLegible) {
  EXPECT_THAT(drawn("-0.5E2", 38),
              ElementsAre("       #####     #####  #####  #####  ", "       #   #     #      #          #  ",
                          "       #   #     #      #          #  ", "       #   #     #      #          #  ",
                          "#####  #   #     #####  #####  #####  ", "       #   #         #  #      #      ",
                          "       #   #         #  #      #      ", "       #   #         #  #      #      ",
                          "       #####  #  #####  #####  #####  "));
}

TEST(Difference, RefusesAsComparisonsDo) {
  EXPECT_THAT(test::refusal_of(
                  [] { difference_map(flat(2, 3, 0).pixels("a"), flat(3, 2, 0).pixels("b"), DifferenceMetric::lab); }),
              HasSubstr("a: is 2 x 3 pixels; expected 3 x 2, the size of b"));
  Picture bad = flat(2, 2, 0);
  bad.at(1, 0, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(test::refusal_of(
                  [&] { coloured_difference(flat(2, 2, 0).pixels("a"), bad.pixels("b"), DifferenceMetric::flip); }),
              HasSubstr("b: pixel (1, 0) has NaN in B"));
}

} // namespace nephroid::difference_test
