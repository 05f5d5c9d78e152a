// SPDX-License-Identifier: Apache-2.0
// kernels/spectral/guide.h: numbers are drawn from a learned histogram as its chances say, and what they are drawn more often is what they
// count less.
#include "spectral/effort/emission_guide.h"
#include "tests/support/statistics.h"
#include "tests/support/test.h"
#include "tests/support/test_kernels.h"

namespace nephroid::guide_test {

using Point = std::array<float, 4>;

constexpr std::size_t cells = GUIDE_CELLS;

const char* const source = R"(
#include "kernels/spectral/guide.h"
#include "kernels/tracing/random.h"
// Moves plain random numbers; xyz: the moved ones, w: the density. w of the numbers must come back as it was.
__kernel void guided(__global const float* guide, __global float4* out, __global uint* cell, uint seed, uint count)
{
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  float4 numbers = random4((uint2)(seed, 0u), 0u, i, 0u, STREAM_PHOTONS);
  const float w = numbers.w;
  const Guided guided = guide_numbers(guide, &numbers);
  out[i] = (float4)(numbers.xyz, numbers.w == w ? guided.density : -1.0f);
  cell[i] = guided.cell;
}
// Moves the numbers that it is given.
__kernel void moved(__global const float* guide, __global float4* numbers, uint count)
{
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  float4 of_item = numbers[i];
  const Guided guided = guide_numbers(guide, &of_item);
  numbers[i] = (float4)(of_item.xyz, guided.density);
}
)";

const test::TestKernels& kernels()
{
  static const test::TestKernels kernels(source);
  return kernels;
}

/// A guide that has learned from cells of very different moments: from two that have all to a slope over x, y and z.
spectral::EmissionGuide learned_guide()
{
  std::vector<std::int64_t> moments(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const std::size_t x = c / (GUIDE_BINS_Y * GUIDE_BINS_Z), y = c / GUIDE_BINS_Z % GUIDE_BINS_Y, z = c % GUIDE_BINS_Z;
    moments[c] = x % 3 == 1 ? 0 : static_cast<std::int64_t>((x + 1) * (y + 2) * (y + 2) * (1 + 9 * (z == 4)));
  }
  moments[77] = 4'000'000;
  spectral::EmissionGuide guide(1);
  guide.learn(moments, std::vector<double>{100000}, 1);
  return guide;
}

/// What the table says: the difference of a cdf before its entry i.
double chance_of(const std::vector<float>& table, std::size_t cdf, std::size_t i)
{
  return static_cast<double>(table[cdf + i]) - (i > 0 ? static_cast<double>(table[cdf + i - 1]) : 0.0);
}

std::vector<double> chances(const std::vector<float>& table)
{
  std::vector<double> result(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const std::size_t xy = c / GUIDE_BINS_Z, x = xy / GUIDE_BINS_Y;
    result[c] = chance_of(table, 0, x) * chance_of(table, GUIDE_BINS_X + x * GUIDE_BINS_Y, xy % GUIDE_BINS_Y) *
                chance_of(table, GUIDE_BINS_X + GUIDE_BINS_X * GUIDE_BINS_Y + xy * GUIDE_BINS_Z, c % GUIDE_BINS_Z);
  }
  return result;
}

struct Draws {
  std::vector<Point> points;
  std::vector<std::uint32_t> cell;
};

Draws draw(const std::vector<float>& table, std::uint32_t seed, std::uint32_t count)
{
  const compute::Buffer<float> guide(kernels().context(), "guide", std::span<const float>(table));
  compute::Buffer<Point> out(kernels().context(), "points", count);
  compute::Buffer<std::uint32_t> cell(kernels().context(), "cells", count);
  kernels().kernel("guided").run(count, 64, {{"guide", guide}, {"out", out}, {"cell", cell}, {"seed", seed}, {"count", count}});
  return {out.read(), cell.read()};
}

constexpr std::uint32_t draws = 1 << 18;

std::size_t part_of(double x, std::size_t parts) { return std::min(static_cast<std::size_t>(x * static_cast<double>(parts)), parts - 1); }

// Every number is in the cell that it says, the cells come by their chances, and density = chance * cells.
TEST(Guide, DrawsCellsByTheirChances)
{
  const std::vector<float> table = learned_guide().table();
  const std::vector<double> chance = chances(table);
  for (const std::uint32_t seed : {1u, 2u}) {
    const Draws drawn = draw(table, seed, draws);
    std::vector<double> hits(cells, 0);
    for (std::size_t i = 0; i < drawn.points.size(); ++i) {
      const Point& p = drawn.points[i];
      for (std::size_t d = 0; d < 3; ++d) ASSERT_TRUE(p[d] >= 0 && p[d] < 1) << p[d];
      const std::size_t c = drawn.cell[i];
      ASSERT_LT(c, cells);
      ++hits[c];
      ASSERT_NEAR(p[3], chance[c] * cells, 1e-5 * p[3]) << "cell " << c;
      EXPECT_NEAR(p[0] * GUIDE_BINS_X, static_cast<double>(c / (GUIDE_BINS_Y * GUIDE_BINS_Z)) + 0.5, 0.5001);
      EXPECT_NEAR(p[1] * GUIDE_BINS_Y, static_cast<double>(c / GUIDE_BINS_Z % GUIDE_BINS_Y) + 0.5, 0.5001);
      EXPECT_NEAR(p[2] * GUIDE_BINS_Z, static_cast<double>(c % GUIDE_BINS_Z) + 0.5, 0.5001);
    }
    EXPECT_GT(test::chi_square_test(hits, chance).p, test::false_alarm) << "seed " << seed;
    EXPECT_LT(test::chi_square_test(hits, std::vector<double>(cells, 1.0)).p, test::false_alarm) << "the guide is even";
  }
}

// Where in its cell a point is, is even: counted in 8 x 8 x 8 parts of a cell, all cells together.
TEST(Guide, PlacesInACellAreEven)
{
  const Draws drawn = draw(learned_guide().table(), 3, draws);
  std::vector<double> hits(512, 0);
  for (const Point& p : drawn.points) {
    std::size_t part = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double bins[] = {GUIDE_BINS_X, GUIDE_BINS_Y, GUIDE_BINS_Z}, place = p[d] * bins[d];
      part = 8 * part + part_of(place - std::floor(place), 8);
    }
    ++hits[part];
  }
  EXPECT_GT(test::chi_square_test(hits, std::vector<double>(512, 1.0)).p, test::false_alarm);
}

// What a photon counts, 1 / density, makes up for how often it comes: the mean over draws of the weights in any box is the box's volume.
// 5 x 5 x 5 boxes, whose sides cut through cells.
TEST(Guide, WeightsMakeUpForTheChances)
{
  const Draws drawn = draw(learned_guide().table(), 4, draws);
  test::WeightedCells boxes(125);
  for (const Point& p : drawn.points)
    boxes.add(25 * part_of(p[0], 5) + 5 * part_of(p[1], 5) + part_of(p[2], 5), 1 / static_cast<double>(p[3]));
  EXPECT_GT(test::weights_test(boxes, std::vector<double>(125, 1.0 / 125), draws), test::false_alarm);
}

std::vector<Point> moved(const std::vector<float>& table, const std::vector<Point>& numbers)
{
  const compute::Buffer<float> guide(kernels().context(), "guide", std::span<const float>(table));
  const auto count = static_cast<std::uint32_t>(numbers.size());
  compute::Buffer<Point> out(kernels().context(), "numbers", std::span<const Point>(numbers));
  kernels().kernel("moved").run(count, 1, {{"guide", guide}, {"numbers", out}, {"count", count}});
  return out.read();
}

// Before anything is learned the numbers stay what they are, to the bit.
TEST(Guide, ThatIsEvenMovesNothing)
{
  std::vector<Point> numbers;
  for (int i = 0; i < 4096; ++i) {
    const auto number = [&](int step) { return static_cast<float>((i * step + 12345) & 0xffffff) * 0x1p-24f; };
    numbers.push_back({number(4099), number(7919 * 3), number(104729), 0});
  }
  const std::vector<Point> after = moved(spectral::EmissionGuide(1).table(), numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(after[i], (Point{numbers[i][0], numbers[i][1], numbers[i][2], 1}));
}

// The smallest and the largest numbers of a device, where one cell has nearly all of the chance.
TEST(Guide, StaysBelowOne)
{
  const float ends[] = {0, 0x1p-24f, 1 - 0x1p-24f};
  std::vector<Point> numbers;
  for (const float x : ends)
    for (const float y : ends)
      for (const float z : ends) numbers.push_back({x, y, z, 0});
  for (const std::size_t bright : {std::size_t{0}, cells / 2, cells - 1}) {
    spectral::EmissionGuide guide(1);
    std::vector<std::int64_t> moments(cells, 0);
    moments[bright] = std::int64_t{1} << 60;
    guide.learn(moments, std::vector<double>{1000}, 1);
    for (const Point& p : moved(guide.table(), numbers)) {
      for (std::size_t d = 0; d < 3; ++d) EXPECT_TRUE(p[d] >= 0 && p[d] < 1) << p[d];
      EXPECT_GT(p[3], 0.1f);
    }
  }
}

} // namespace nephroid::guide_test
