// SPDX-License-Identifier: Apache-2.0
// Learning where photons matter: even at the start, the optimum of cases worked out by hand, and what no moment can take away.
#include "spectral/effort/emission_guide.h"
#include "tests/support/saved_jobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace nephroid;
using spectral::EmissionGuide;

constexpr std::size_t cells = GUIDE_CELLS;
constexpr double even = 1.0 / cells;
constexpr double dark_part = 0.15; // of the photons, spread evenly whatever was learned

std::size_t cell_at(std::size_t x, std::size_t y, std::size_t z) { return (x * GUIDE_BINS_Y + y) * GUIDE_BINS_Z + z; }

/// The chance of each cell of a light, as the three cdfs of kernels/spectral/guide.h give it.
std::vector<double> chances(const EmissionGuide& guide, std::size_t light = 0)
{
  const auto table = guide.table().begin() + static_cast<std::ptrdiff_t>(light * GUIDE_FLOATS);
  const auto difference = [&](std::size_t cdf, std::size_t i) {
    return static_cast<double>(table[static_cast<std::ptrdiff_t>(cdf + i)]) -
           (i > 0 ? static_cast<double>(table[static_cast<std::ptrdiff_t>(cdf + i - 1)]) : 0.0);
  };
  std::vector<double> result(cells);
  for (std::size_t x = 0; x < GUIDE_BINS_X; ++x)
    for (std::size_t y = 0; y < GUIDE_BINS_Y; ++y)
      for (std::size_t z = 0; z < GUIDE_BINS_Z; ++z)
        result[cell_at(x, y, z)] = difference(0, x) * difference(GUIDE_BINS_X + x * GUIDE_BINS_Y, y) *
                                   difference(GUIDE_BINS_X + GUIDE_BINS_X * GUIDE_BINS_Y + (x * GUIDE_BINS_Y + y) * GUIDE_BINS_Z, z);
  return result;
}

double sum(const std::vector<double>& values)
{
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// The moments of a pass of `photons` photons, of which one that is sent evenly adds f[cell] / photons, in `unit`s: those of a cell are
/// photons * chance, and each adds f / (photons * chance * cells).
std::vector<std::int64_t> moments_of(const std::vector<double>& f, const std::vector<double>& chance, double photons, double unit)
{
  std::vector<std::int64_t> moments(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const double one = f[c] / (photons * chance[c] * cells);
    moments[c] = std::llround(photons * chance[c] * one * one / unit);
  }
  return moments;
}

TEST(EmissionGuide, IsEvenToBeginWith)
{
  const EmissionGuide guide(2);
  ASSERT_EQ(guide.table().size(), 2u * GUIDE_FLOATS);
  for (const std::size_t light : {0u, 1u}) {
    const std::vector<double> chance = chances(guide, light);
    // A quantum of 2^-24 in each of three cdfs of 16 is 1e-6 of a chance.
    for (const double value : chance) EXPECT_NEAR(value, even, 4e-6 * even);
  }
}

// Where nothing was added anywhere, there is nothing to learn.
TEST(EmissionGuide, StaysEvenInTheDark)
{
  EmissionGuide guide(1);
  guide.learn(std::vector<std::int64_t>(cells, 0), std::vector<double>{1000}, 2);
  for (const double value : chances(guide)) EXPECT_NEAR(value, even, 4e-6 * even);
}

// Cells of one x are alike, so the blur over y and z changes nothing: those of x < 4 with f = 3, those of x >= 12 with f = 1, the others
// dark. The chance goes as f: 3/4 and 1/4 of 85 %, over 1024 cells each, and 15 % over all.
TEST(EmissionGuide, GoesByTheRootOfTheMeanSquare)
{
  EmissionGuide guide(1);
  std::vector<double> f(cells, 0.0);
  for (std::size_t c = 0; c < cells / 4; ++c) f[c] = 3, f[cells - 1 - c] = 1;
  const double bright = dark_part * even + (1 - dark_part) * 0.75 / (cells / 4.0),
               dim = dark_part * even + (1 - dark_part) * 0.25 / (cells / 4.0), dark = dark_part * even;
  const auto expect_learned = [&](const char* when) {
    const std::vector<double> chance = chances(guide);
    for (std::size_t c = 0; c < cells; ++c)
      ASSERT_NEAR(chance[c], f[c] == 3 ? bright : f[c] == 1 ? dim : dark, 1e-4 * chance[c]) << when << ", cell " << c;
  };
  const double photons = 1e6, unit = 1e-18;
  guide.learn(moments_of(f, std::vector<double>(cells, even), photons, unit), std::vector<double>{photons}, 1);
  expect_learned("from even photons");
  // What guided photons show is the same f: those of a cell that comes more often count less each.
  guide.learn(moments_of(f, chances(guide), photons, unit), std::vector<double>{photons}, 1);
  expect_learned("from guided photons");
}

// One bright cell: half of its chance stays in the middle of a blur of 1 2 1 in y and in z, so a quarter; z goes round, y does not.
TEST(EmissionGuide, NeighboursLearnFromEachOther)
{
  for (const std::size_t y : {0u, 7u}) {
    EmissionGuide guide(1);
    std::vector<std::int64_t> moments(cells, 0);
    moments[cell_at(5, y, 0)] = 1 << 20;
    guide.learn(moments, std::vector<double>{1e5}, 1);
    const std::vector<double> chance = chances(guide);
    const auto learned = [&](std::size_t at_y, std::size_t z) {
      return (chance[cell_at(5, at_y, z)] - dark_part * even) / (1 - dark_part);
    };
    const double at_edge = y == 0 ? 0.75 : 0.5; // what would go below y = 0 stays
    EXPECT_NEAR(learned(y, 0), at_edge * 0.5, 1e-5);
    EXPECT_NEAR(learned(y, 1), at_edge * 0.25, 1e-5);
    EXPECT_NEAR(learned(y, GUIDE_BINS_Z - 1), at_edge * 0.25, 1e-5);
    EXPECT_NEAR(learned(y + 1, 0), 0.25 * 0.5, 1e-5);
    EXPECT_NEAR(chance[cell_at(4, y, 0)], dark_part * even, 1e-4 * even); // of another x: another target
  }
}

// Moments over 18 orders of magnitude, several deals, two lights of which one is dark: every chance is above 0 by what is spread evenly,
// and they are all there is. So with the density chance * cells that a photon is divided by (kernels/spectral/guide.h), the mean of any f
// over guided photons is sum chance * f / (chance * cells), the even mean.
TEST(EmissionGuide, EveryCellKeepsAChance)
{
  EmissionGuide guide(2);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(0, 18);
  for (int deal = 0; deal < 5; ++deal) {
    std::vector<std::int64_t> moments(2 * cells, 0);
    for (std::size_t c = 0; c < cells; ++c)
      if (random() % 3 == 0) moments[c] = static_cast<std::int64_t>(std::pow(10.0, exponent(random)));
    guide.learn(moments, std::vector<double>{200000, 5}, std::exp2(deal));
    for (const std::size_t light : {0u, 1u}) {
      const std::vector<double> chance = chances(guide, light);
      EXPECT_NEAR(sum(chance), 1, 1e-12);
      EXPECT_GT(*std::min_element(chance.begin(), chance.end()), 0.99 * dark_part * even);
    }
    for (const double value : chances(guide, 1)) EXPECT_NEAR(value, even, 4e-6 * even);
  }
}

TEST(EmissionGuide, IsSavedWhole)
{
  std::vector<std::int64_t> first(cells, 3), second(cells, 1);
  first[100] = 1 << 30;
  second[2000] = 1 << 30;
  EmissionGuide guide(1);
  guide.learn(first, std::vector<double>{1000}, 2);
  const std::vector<std::byte> bytes = test::saved<tracing::State>(guide);
  EmissionGuide other(1);
  EXPECT_TRUE(test::load<tracing::State>(other, bytes));
  EXPECT_EQ(other.table(), guide.table());
  guide.learn(second, std::vector<double>{1000}, 2);
  other.learn(second, std::vector<double>{1000}, 2);
  EXPECT_EQ(other.table(), guide.table());
}

// A run without effort `variance` has no guide.
TEST(EmissionGuide, MayBeOfNoLight)
{
  EmissionGuide guide(0);
  EXPECT_TRUE(guide.table().empty());
}

} // namespace
