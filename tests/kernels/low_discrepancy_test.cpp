// SPDX-License-Identifier: Apache-2.0
// Low-discrepancy sequences, and the guide of emission. `nephroid check` holds kernels/tracing/random.h against the
// published vectors of its generator, samplers_test.cpp the distribution of its uniforms.
#include "kernels/tracing/shared_types.h"
#include "photons/effort/emitters.h"
#include "tests/support/statistics.h"
#include "tests/support/test_kernels.h"
#include "tracing/world.h"

namespace nephroid::low_discrepancy_test {

using Point = std::array<float, 4>;

// kernels/tracing/low_discrepancy.h and what kernels/photons/photon_path.h makes of it: what Owen's scrambling keeps of
// a Sobol sequence is exact and is tested so; that other keys give independent sequences is tested by chi-square.

const char* const source = R"(
#include "kernels/tracing/film.h"
#include "kernels/tracing/random.h"
#include "kernels/photons/guide.h"
#include "kernels/photons/photon_start.h"
#include "kernels/tracing/work_item.h"
// How many photons of a pass fall into each of 401 equal parts of their clusters, of emitters of at most `largest` photons.
__kernel void wavelengths(__global const DeviceEmitter* emitters, int emitter_count, __global const DeviceLight* lights, uint2 seed,
                          uint pass, uint photons, uint largest, volatile __global uint* hits)
{
  for (uint i = work_item(); i < photons; i += (uint)(get_global_size(0) * get_global_size(1))) {
    const PhotonStart start = photon_start(emitters, emitter_count, lights, seed, pass, 0u, i);
    if (emitters[start.emitter].photon_count <= largest) atomic_inc(hits + (uint)(start.wavelength * 401.0f));
  }
}
__kernel void points(__global float4* out, uint2 seed, uint4 sequence_set, uint first, uint count)
{
  const uint i = work_item();
  if (i < count) out[i] = sobol4(seed, sequence_set.xyz, sequence_set.w, first + i);
}
// Point 3 of `count` sequences that follow each other.
__kernel void over_sequences(__global float4* out, uint2 seed, uint4 sequence_set, uint count)
{
  const uint i = work_item();
  if (i < count) out[i] = sobol4(seed, sequence_set.xyz + (uint3)(i, 0u, 0u), sequence_set.w, 3u);
}
// Moves plain random numbers; xyz: the moved ones, w: the density. w of the numbers must come back as it was.
__kernel void guided(__global const float* guide, __global float4* out, __global uint* cell, uint seed, uint count)
{
  const uint i = work_item();
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
  const uint i = work_item();
  if (i >= count) return;
  float4 of_item = numbers[i];
  const Guided guided = guide_numbers(guide, &of_item);
  numbers[i] = (float4)(of_item.xyz, guided.density);
}
)";

struct Key {
  std::array<std::uint32_t, 2> seed{1, 0};
  std::array<std::uint32_t, 4> sequence_set{0, 0, 0, 0}; ///< the last: set
};

const test::TestKernels& kernels() {
  static const test::TestKernels kernels(source);
  return kernels;
}

std::vector<Point> points(const Key& key, std::uint32_t count, std::uint32_t first = 0) {
  compute::Buffer<Point> out(kernels().context(), "points", count);
  kernels().kernel("points").run(
      count, 1,
      {{"out", out}, {"seed", key.seed}, {"sequence_set", key.sequence_set}, {"first", first}, {"count", count}});
  return out.read();
}

std::vector<Point> over_sequences(const Key& key) {
  const std::uint32_t count = 4096;
  compute::Buffer<Point> out(kernels().context(), "points", count);
  kernels()
      .kernel("over_sequences")
      .run(count, 1, {{"out", out}, {"seed", key.seed}, {"sequence_set", key.sequence_set}, {"count", count}});
  return out.read();
}

std::size_t cell(float x, std::size_t cells) {
  return std::min(static_cast<std::size_t>(x * static_cast<float>(cells)), cells - 1);
}

// 2^k points that follow each other from a multiple of 2^k on have one in each of 2^k equal intervals, in every
// dimension.
TEST(LowDiscrepancy, EveryDimensionIsStratified) {
  for (const std::uint32_t first : {0u, 1024u, 7u * 1024u})
    for (const std::uint32_t seed : {1u, 2u, 99u}) {
      const std::vector<Point> all = points({{seed, 0}, {3, 1, 0, 0}}, 1024, first);
      for (std::size_t d = 0; d < 4; ++d) {
        std::vector<int> hits(1024, 0);
        for (const Point& p : all) ++hits[cell(p[d], hits.size())];
        EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), 1024) << "dimension " << d << ", from " << first;
      }
    }
}

// The first two dimensions are a (0, 2)-sequence in base 2: of 2^k points one is in each box of 2^-a by 2^-(k - a), for
// every a.
TEST(LowDiscrepancy, TwoDimensionsAreStratifiedTogether) {
  const std::vector<Point> all = points({{5, 6}, {0, 0, 1, 0}}, 256);
  for (std::size_t wide = 1; wide <= 256; wide *= 2) {
    std::vector<int> hits(256, 0);
    for (const Point& p : all) ++hits[cell(p[0], wide) * (256 / wide) + cell(p[1], 256 / wide)];
    EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), 256) << wide;
  }
}

/// Pairs of one dimension of two sequences, counted in 16 x 16 cells, against an even distribution.
double p_of_independence(const std::vector<Point>& a, const std::vector<Point>& b, std::size_t d) {
  std::vector<double> hits(256, 0);
  for (std::size_t i = 0; i < a.size(); ++i) ++hits[16 * cell(a[i][d], 16) + cell(b[i][d], 16)];
  return test::chi_square_test(hits, std::vector<double>(256, 1.0)).p;
}

// Point 3 of each of 4096 sequences is plain random; so are pairs of such points of sequences that differ in one more
// part of their key.
TEST(LowDiscrepancy, OtherKeysAreIndependent) {
  const std::vector<Point> all = over_sequences({{11, 12}, {0, 0, 0, 0}});
  for (const Key& other : {Key{{11, 13}, {0, 0, 0, 0}}, Key{{10, 12}, {0, 0, 0, 0}}, Key{{11, 12}, {0, 1, 0, 0}},
                           Key{{11, 12}, {0, 0, 1, 0}}, Key{{11, 12}, {0, 0, 0, 1}}, Key{{11, 12}, {4096, 0, 0, 0}}}) {
    const std::vector<Point> others = over_sequences(other);
    for (std::size_t d = 0; d < 4; ++d)
      EXPECT_GT(p_of_independence(all, others, d), test::false_alarm)
          << testing::PrintToString(other.sequence_set) << ", dimension " << d;
  }
}

// The wavelength in a cluster is as fine as its light's spectrum, however few of a pass' photons the cluster has: 2000
// of 16 photons each, beside one of all the rest. Each has its own part of the sequence, so what falls into 401 equal
// parts of them is like plain random numbers or more even.
TEST(LowDiscrepancy, WavelengthsOfSmallClustersAreFine) {
  constexpr unsigned small = 16, clusters = 2000;
  for (const std::uint32_t photons : {1u << 22, 1u << 24}) {
    std::vector<shared::DeviceEmitter> emitters(clusters + 1);
    for (shared::DeviceEmitter& e : emitters) e.photon_count = small;
    emitters.back().photon_count = photons - small * clusters;
    photons::number_photons(emitters);
    const auto table = compute::Buffer(kernels().context(), "emitters", emitters);
    const compute::Buffer<shared::DeviceLight> lights =
        compute::Buffer(kernels().context(), "lights", std::vector<shared::DeviceLight>(1));
    compute::Buffer<std::uint32_t> hits(kernels().context(), "hits", 401);
    hits.fill_zero();
    const std::array<std::uint32_t, 2> seed{7, 0};
    kernels()
        .kernel("wavelengths")
        .run(1 << 12, 64,
             {{"emitters", table},
              {"emitter_count", static_cast<int>(clusters + 1)},
              {"lights", lights},
              {"seed", seed},
              {"pass", 0u},
              {"photons", photons},
              {"largest", small},
              {"hits", hits}});
    const std::vector<std::uint32_t> counted = hits.read();
    const std::vector<double> counts(counted.begin(), counted.end());
    EXPECT_NEAR(std::accumulate(counts.begin(), counts.end(), 0.0), small * clusters, 0.1 * small * clusters);
    EXPECT_GT(test::chi_square_test(counts, std::vector<double>(401, 1.0)).p, test::false_alarm) << photons;
  }
}

// kernels/photons/guide.h: numbers are drawn from a learned histogram as its chances say, and what they are drawn more
// often is what they count less.

constexpr std::size_t cells = GUIDE_CELLS;

/// A guide that has learned from cells of very different moments: from two that have all to a slope over x, y and z.
photons::EmissionGuide learned_guide() {
  std::vector<std::int64_t> moments(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const std::size_t x = c / (GUIDE_BINS_Y * GUIDE_BINS_Z), y = c / GUIDE_BINS_Z % GUIDE_BINS_Y, z = c % GUIDE_BINS_Z;
    moments[c] = x % 3 == 1 ? 0 : static_cast<std::int64_t>((x + 1) * (y + 2) * (y + 2) * (1 + 9 * (z == 4)));
  }
  moments[77] = 4'000'000;
  photons::EmissionGuide guide(1);
  guide.learn(moments, std::vector<double>{100000}, 1);
  return guide;
}

/// What the table says: the difference of a cdf before its entry i.
double chance_of(const std::vector<float>& table, std::size_t cdf, std::size_t i) {
  return static_cast<double>(table[cdf + i]) - (i > 0 ? static_cast<double>(table[cdf + i - 1]) : 0.0);
}

std::vector<double> chances(const std::vector<float>& table) {
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

Draws draw(const std::vector<float>& table, std::uint32_t seed, std::uint32_t count) {
  const compute::Buffer<float> guide(kernels().context(), "guide", std::span<const float>(table));
  compute::Buffer<Point> out(kernels().context(), "points", count);
  compute::Buffer<std::uint32_t> cell(kernels().context(), "cells", count);
  kernels().kernel("guided").run(count, 64,
                                 {{"guide", guide}, {"out", out}, {"cell", cell}, {"seed", seed}, {"count", count}});
  return {out.read(), cell.read()};
}

constexpr std::uint32_t draws = 1 << 18;

std::size_t part_of(double x, std::size_t parts) {
  return std::min(static_cast<std::size_t>(x * static_cast<double>(parts)), parts - 1);
}

// Every number is in the cell that it says, the cells come by their chances, and density = chance * cells.
TEST(Guide, DrawsCellsByTheirChances) {
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
TEST(Guide, PlacesInACellAreEven) {
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

// What a photon counts, 1 / density, makes up for how often it comes: the mean over draws of the weights in any box is
// the box's volume. 5 x 5 x 5 boxes, whose sides cut through cells.
TEST(Guide, WeightsMakeUpForTheChances) {
  const Draws drawn = draw(learned_guide().table(), 4, draws);
  test::WeightedCells boxes(125);
  for (const Point& p : drawn.points)
    boxes.add(25 * part_of(p[0], 5) + 5 * part_of(p[1], 5) + part_of(p[2], 5), 1 / static_cast<double>(p[3]));
  EXPECT_GT(test::weights_test(boxes, std::vector<double>(125, 1.0 / 125), draws), test::false_alarm);
}

std::vector<Point> moved(const std::vector<float>& table, const std::vector<Point>& numbers) {
  const compute::Buffer<float> guide(kernels().context(), "guide", std::span<const float>(table));
  const auto count = static_cast<std::uint32_t>(numbers.size());
  compute::Buffer<Point> out(kernels().context(), "numbers", std::span<const Point>(numbers));
  kernels().kernel("moved").run(count, 1, {{"guide", guide}, {"numbers", out}, {"count", count}});
  return out.read();
}

// Before anything is learned the numbers stay what they are, to the bit.
TEST(Guide, ThatIsEvenMovesNothing) {
  std::vector<Point> numbers;
  for (int i = 0; i < 4096; ++i) {
    const auto number = [&](int step) { return static_cast<float>((i * step + 12345) & 0xffffff) * 0x1p-24f; };
    numbers.push_back({number(4099), number(7919 * 3), number(104729), 0});
  }
  const std::vector<Point> after = moved(photons::EmissionGuide(1).table(), numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(after[i], (Point{numbers[i][0], numbers[i][1], numbers[i][2], 1}));
}

// The smallest and the largest numbers of a device, where one cell has nearly all of the chance.
TEST(Guide, StaysBelowOne) {
  const float ends[] = {0, 0x1p-24f, 1 - 0x1p-24f};
  std::vector<Point> numbers;
  for (const float x : ends)
    for (const float y : ends)
      for (const float z : ends) numbers.push_back({x, y, z, 0});
  for (const std::size_t bright : {std::size_t{0}, cells / 2, cells - 1}) {
    photons::EmissionGuide guide(1);
    std::vector<std::int64_t> moments(cells, 0);
    moments[bright] = std::int64_t{1} << 60;
    guide.learn(moments, std::vector<double>{1000}, 1);
    for (const Point& p : moved(guide.table(), numbers)) {
      for (std::size_t d = 0; d < 3; ++d) EXPECT_TRUE(p[d] >= 0 && p[d] < 1) << p[d];
      EXPECT_GT(p[3], 0.1f);
    }
  }
}

} // namespace nephroid::low_discrepancy_test
