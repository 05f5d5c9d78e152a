// SPDX-License-Identifier: Apache-2.0
// kernels/tracing/low_discrepancy.h and what kernels/spectral/photon_path.h makes of it: what Owen's scrambling keeps of a Sobol sequence
// is exact and is tested so; that other keys give independent sequences is tested by chi-square.
#include "kernels/tracing/shared_types.h"
#include "spectral/effort/emitters.h"
#include "tests/support/statistics.h"
#include "tests/support/test.h"
#include "tests/support/test_kernels.h"
#include "tracing/world.h"

namespace nephroid::low_discrepancy_test {

using Point = std::array<float, 4>;

const char* const source = R"(
#include "kernels/tracing/film.h"
#include "kernels/spectral/photon_path.h"
// How many photons of a pass fall into each of 401 equal parts of their clusters, of emitters of at most `largest` photons.
__kernel void wavelengths(__global const DeviceEmitter* emitters, int emitter_count, __global const DeviceLight* lights, uint2 seed,
                          uint pass, uint photons, uint largest, volatile __global uint* hits)
{
  for (uint i = (uint)get_global_id(0); i < photons; i += (uint)get_global_size(0)) {
    const PhotonStart start = photon_start(emitters, emitter_count, lights, seed, pass, 0u, i);
    if (emitters[start.emitter].photon_count <= largest) atomic_inc(hits + (uint)(start.wavelength * 401.0f));
  }
}
__kernel void points(__global float4* out, uint2 seed, uint4 sequence_set, uint first, uint count)
{
  const uint i = (uint)get_global_id(0);
  if (i < count) out[i] = sobol4(seed, sequence_set.xyz, sequence_set.w, first + i);
}
// Point 3 of `count` sequences that follow each other.
__kernel void over_sequences(__global float4* out, uint2 seed, uint4 sequence_set, uint count)
{
  const uint i = (uint)get_global_id(0);
  if (i < count) out[i] = sobol4(seed, sequence_set.xyz + (uint3)(i, 0u, 0u), sequence_set.w, 3u);
}
)";

struct Key {
  std::array<std::uint32_t, 2> seed{1, 0};
  std::array<std::uint32_t, 4> sequence_set{0, 0, 0, 0}; ///< the last: set
};

const test::TestKernels& kernels()
{
  static const test::TestKernels kernels(source);
  return kernels;
}

std::vector<Point> points(const Key& key, std::uint32_t count, std::uint32_t first = 0)
{
  compute::Buffer<Point> out(kernels().context(), "points", count);
  kernels().kernel("points").run(
      count, 1, {{"out", out}, {"seed", key.seed}, {"sequence_set", key.sequence_set}, {"first", first}, {"count", count}});
  return out.read();
}

std::vector<Point> over_sequences(const Key& key)
{
  const std::uint32_t count = 4096;
  compute::Buffer<Point> out(kernels().context(), "points", count);
  kernels()
      .kernel("over_sequences")
      .run(count, 1, {{"out", out}, {"seed", key.seed}, {"sequence_set", key.sequence_set}, {"count", count}});
  return out.read();
}

std::size_t cell(float x, std::size_t cells) { return std::min(static_cast<std::size_t>(x * static_cast<float>(cells)), cells - 1); }

// 2^k points that follow each other from a multiple of 2^k on have one in each of 2^k equal intervals, in every dimension.
TEST(LowDiscrepancy, EveryDimensionIsStratified)
{
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

// The first two dimensions are a (0, 2)-sequence in base 2: of 2^k points one is in each box of 2^-a by 2^-(k - a), for every a.
TEST(LowDiscrepancy, TwoDimensionsAreStratifiedTogether)
{
  const std::vector<Point> all = points({{5, 6}, {0, 0, 1, 0}}, 256);
  for (std::size_t wide = 1; wide <= 256; wide *= 2) {
    std::vector<int> hits(256, 0);
    for (const Point& p : all) ++hits[cell(p[0], wide) * (256 / wide) + cell(p[1], 256 / wide)];
    EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), 256) << wide;
  }
}

/// Pairs of one dimension of two sequences, counted in 16 x 16 cells, against an even distribution.
double p_of_independence(const std::vector<Point>& a, const std::vector<Point>& b, std::size_t d)
{
  std::vector<double> hits(256, 0);
  for (std::size_t i = 0; i < a.size(); ++i) ++hits[16 * cell(a[i][d], 16) + cell(b[i][d], 16)];
  return test::chi_square_test(hits, std::vector<double>(256, 1.0)).p;
}

// Point 3 of each of 4096 sequences is plain random; so are pairs of such points of sequences that differ in one more part of their key.
TEST(LowDiscrepancy, OtherKeysAreIndependent)
{
  const std::vector<Point> all = over_sequences({{11, 12}, {0, 0, 0, 0}});
  for (const Key& other : {Key{{11, 13}, {0, 0, 0, 0}}, Key{{10, 12}, {0, 0, 0, 0}}, Key{{11, 12}, {0, 1, 0, 0}},
                           Key{{11, 12}, {0, 0, 1, 0}}, Key{{11, 12}, {0, 0, 0, 1}}, Key{{11, 12}, {4096, 0, 0, 0}}}) {
    const std::vector<Point> others = over_sequences(other);
    for (std::size_t d = 0; d < 4; ++d)
      EXPECT_GT(p_of_independence(all, others, d), test::false_alarm) << testing::PrintToString(other.sequence_set) << ", dimension " << d;
  }
}

// The wavelength in a cluster is as fine as its light's spectrum, however few of a pass' photons the cluster has: 2000 of 16 photons each,
// beside one of all the rest. Each has its own part of the sequence, so what falls into 401 equal parts of them is like plain random
// numbers or more even.
TEST(LowDiscrepancy, WavelengthsOfSmallClustersAreFine)
{
  constexpr unsigned small = 16, clusters = 2000;
  for (const std::uint32_t photons : {1u << 22, 1u << 24}) {
    std::vector<shared::DeviceEmitter> emitters(clusters + 1);
    for (shared::DeviceEmitter& e : emitters) e.photon_count = small;
    emitters.back().photon_count = photons - small * clusters;
    spectral::number_photons(emitters);
    const auto table = tracing::upload_vector(kernels().context(), "emitters", emitters);
    const compute::Buffer<shared::DeviceLight> lights =
        tracing::upload_vector(kernels().context(), "lights", std::vector<shared::DeviceLight>(1));
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

} // namespace nephroid::low_discrepancy_test
