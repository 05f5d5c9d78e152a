// SPDX-License-Identifier: Apache-2.0
// Statistics of rectangles against closed forms.
#include "tests/support/eventually.h"
#include "tests/support/test.h"
#include "ui/inspector/region.h"

namespace nephroid::ui::region_test {

constexpr float float_nan = std::numeric_limits<float>::quiet_NaN(), float_infinity = std::numeric_limits<float>::infinity();

/// A picture of greys.
HeldPicture picture_of(int width, int height, const std::vector<float>& greys)
{
  auto rgb = std::make_shared<std::vector<float>>();
  for (const float grey : greys) rgb->insert(rgb->end(), 3, grey);
  return {rgb, {width, height, *rgb, "greys"}};
}

TEST(Moments, OfTheFirstNumbers)
{
  // 1 .. n: mean (n + 1) / 2, variance (n^2 - 1) / 12, median as the mean.
  for (const int n : {1, 2, 9, 1000}) {
    std::vector<double> values(static_cast<std::size_t>(n));
    std::iota(values.rbegin(), values.rend(), 1.0);
    const Moments m = moments(values);
    EXPECT_DOUBLE_EQ(m.mean, (n + 1) / 2.0);
    EXPECT_NEAR(m.deviation, std::sqrt((double(n) * n - 1) / 12), 1e-9 * n);
    EXPECT_DOUBLE_EQ(m.median, (n + 1) / 2.0);
    EXPECT_EQ(m.least, 1);
    EXPECT_EQ(m.most, n);
  }
  EXPECT_TRUE(std::isnan(moments({}).mean));
  EXPECT_TRUE(std::isnan(moments({}).median));
  // A large mean does not swallow a small deviation.
  EXPECT_NEAR(moments({1e9, 1e9 + 2}).deviation, 1, 1e-6);
}

TEST(Region, TakesItsPixelsOnly)
{
  const HeldPicture picture = picture_of(4, 3, {0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23});
  const RegionStatistics s = region_statistics({picture, {}, "", {{1, 1}, {3, 3}}, 2});
  ASSERT_THAT(s.pictures, SizeIs(1));
  EXPECT_EQ(s.pictures[0].pixels, 4u);
  EXPECT_DOUBLE_EQ(s.pictures[0].of[1].mean, (11 + 12 + 21 + 22) / 4.0);
  EXPECT_NEAR(s.pictures[0].of[0].mean, 2 * 16.5, 1e-5) << "luminance is in W/m2/sr: times white";
  EXPECT_EQ(s.pictures[0].of[2].least, 11);
  EXPECT_EQ(s.pictures[0].of[3].most, 22);
  EXPECT_EQ(region_statistics({picture, {}, "", {{-5, 2}, {2, 9}}, 1}).pictures[0].pixels, 2u) << "cut to the picture";
  EXPECT_FALSE(cut_to({{4, 0}, {9, 3}}, 4, 3));
}

TEST(Region, CountsWhatIsNotOrdinaryAndLeavesItOut)
{
  auto rgb = std::make_shared<std::vector<float>>(
      std::vector<float>{1, 1, 1, float_nan, float_infinity, 0, 0, -float_infinity, 0, -1, 2, 0, -1, -1, -1});
  const RegionStatistics s = region_statistics({{rgb, {5, 1, *rgb, "odd"}}, {}, "", {{0, 0}, {5, 1}}, 1});
  const PictureStatistics& p = s.pictures[0];
  EXPECT_EQ(p.pixels, 5u);
  EXPECT_EQ(p.nan, 1u);
  EXPECT_EQ(p.infinite, 1u);
  EXPECT_EQ(p.dark, 1u) << "(-1, 2, 0) is light, of a colour outside of sRGB";
  EXPECT_EQ(p.coloured, 2u);
  EXPECT_DOUBLE_EQ(p.of[1].mean, (1 - 1 - 1) / 3.0);
  EXPECT_EQ(p.of[2].most, 2);
}

TEST(Region, HoldsTwoPicturesAgainstEachOther)
{
  const RegionStatistics s =
      region_statistics({picture_of(2, 2, {1, 2, 3, 4}), picture_of(2, 2, {1, 1, 1, float_nan}), "a \"pin\"", {{0, 0}, {2, 2}}, 1});
  ASSERT_THAT(s.pictures, SizeIs(3));
  EXPECT_EQ(s.pictures[1].nan, 1u);
  EXPECT_EQ(s.pictures[2].name, "difference");
  EXPECT_EQ(s.pictures[2].nan, 1u);
  EXPECT_DOUBLE_EQ(s.pictures[2].of[1].mean, 1) << "0, 1, 2";
  EXPECT_DOUBLE_EQ(s.pictures[2].of[1].median, 1);
  const std::string csv = to_csv(s);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 4);
  EXPECT_THAT(csv, HasSubstr("\n0,0,2,2,\"a \"\"pin\"\"\",R,linear,1,0,1,1,1,4,1,0,0,0\n"));
}

TEST(RegionHistogram, CountsEveryPixelAboveZeroOnce)
{
  std::vector<float> greys;
  for (int i = 0; i < 100; ++i) greys.push_back(std::pow(10.0f, -2 + 0.04f * static_cast<float>(i))); // .01 to 91
  greys.push_back(0);
  greys.push_back(-1);
  greys.push_back(float_nan);
  const Histogram h = region_statistics({picture_of(103, 1, greys), {}, "", {{0, 0}, {103, 1}}, 1}).histogram;
  ASSERT_THAT(h.counts, SizeIs(1));
  EXPECT_EQ(std::accumulate(h.counts[0].begin(), h.counts[0].end(), 0.0), 100);
  EXPECT_NEAR(h.first, -2, 0.11);
  EXPECT_NEAR(h.last, 2, 0.11);
  // 2.5 pixels a tenth of a decade.
  EXPECT_THAT(std::vector(h.counts[0].begin() + 1, h.counts[0].end() - 1), Each(testing::AllOf(testing::Ge(2), testing::Le(3))));
  const Histogram none = region_statistics({picture_of(1, 1, {0}), {}, "", {{0, 0}, {1, 1}}, 1}).histogram;
  EXPECT_THAT(none.counts[0], Each(0));
}

TEST(NewestStatistics, AreMadeOnceOfWhatIsWanted)
{
  Messages messages;
  TaskQueue tasks;
  NewestResult<RegionStatistics> statistics;
  const auto want = [&](const RegionRequest& wanted) {
    tasks.collect(messages);
    want_statistics(statistics, tasks, wanted);
  };
  const RegionRequest request{picture_of(2, 1, {1, 3}), {}, "", {{0, 0}, {2, 1}}, 1};
  ASSERT_TRUE(test::eventually([&] { return want(request), statistics.newest() != nullptr; }));
  const auto first = statistics.newest();
  for (int i = 0; i < 5; ++i) want(request);
  EXPECT_TRUE(tasks.empty());
  EXPECT_EQ(statistics.newest(), first);
  RegionRequest other = request;
  other.region = {{1, 0}, {2, 1}};
  ASSERT_TRUE(test::eventually([&] { return want(other), statistics.newest() != first; }));
  EXPECT_DOUBLE_EQ(statistics.newest()->pictures[0].of[1].mean, 3);
  RegionRequest newer = other;
  newer.picture = picture_of(2, 1, {1, 5});
  ASSERT_TRUE(test::eventually([&] { return want(newer), statistics.newest()->pictures[0].of[1].mean == 5; }))
      << "it rests, and then goes on";
  statistics.forget(tasks);
  EXPECT_EQ(statistics.newest(), nullptr);
}

} // namespace nephroid::ui::region_test
