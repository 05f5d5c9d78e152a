// SPDX-License-Identifier: Apache-2.0
// Photons dealt to pairs of a light and a cluster: as many as were asked for, in proportion, and numbered without gaps.
#include "spectral/effort/emitters.h"
#include "tests/support/test.h"

namespace nephroid::emitters_test {

TEST(DealOut, GivesEveryEmitterItsShareAndNoneToTheDark)
{
  EXPECT_THAT(spectral::deal_out({1, 1, 2}, 8), ElementsAre(2, 3, 3)); // 1 each; then 5 by rounding the running sums 1.25, 2.5, 5
  EXPECT_THAT(spectral::deal_out({1, 0, 1e-9}, 100), ElementsAre(99, 0, 1));
  EXPECT_THAT(spectral::deal_out({1, 1, 1}, 1), ElementsAre(1, 1, 1));
  EXPECT_THAT(spectral::deal_out({0, 0}, 10), ElementsAre(0, 0));
  std::vector<double> weights(401);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = std::pow(0.9, static_cast<double>(i));
  const std::vector<unsigned> counts = spectral::deal_out(weights, 1 << 18);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0u), 1u << 18);
}

// Two lights, three clusters; the second light has nothing in the middle one.
TEST(Emitters, AreNumberedAndThoseOfALightTogether)
{
  const std::vector<shared::DeviceEmitter> emitters =
      spectral::make_emitters({{1, 0, 0, 0.5}, {1, 0, 1, 0.25}, {2, 0, 2, 0.25}, {3, 1, 0, 0.75}, {0, 1, 1, 0}, {3, 1, 2, 0.25}}, 1005);
  ASSERT_EQ(emitters.size(), 5u);
  EXPECT_EQ(spectral::count_photons(emitters), 1005u);
  const unsigned counts[] = {101, 101, 201, 301, 301}; // 1 each, and 1000 as 1 : 1 : 2 : 3 : 3
  const int lights[] = {0, 0, 0, 1, 1}, clusters[] = {0, 1, 2, 0, 2};
  const float shares[] = {0.5f, 0.25f, 0.25f, 0.75f, 0.25f};
  unsigned first = 0;
  for (std::size_t e = 0; e < emitters.size(); ++e) {
    EXPECT_EQ(emitters[e].photon_count, counts[e]) << e;
    EXPECT_EQ(emitters[e].light, lights[e]) << e;
    EXPECT_EQ(emitters[e].cluster, clusters[e]) << e;
    EXPECT_EQ(emitters[e].share, shares[e]) << e;
    EXPECT_EQ(emitters[e].first_photon, first) << e;
    EXPECT_EQ(emitters[e].light_first_photon, lights[e] == 0 ? 0u : 403u) << e;
    EXPECT_EQ(emitters[e].light_photon_count, lights[e] == 0 ? 403u : 602u) << e;
    first += counts[e];
  }
}

TEST(Emitters, AreNoneInTheDark)
{
  EXPECT_TRUE(spectral::make_emitters({{0, 0, 0, 0}, {0, 1, 0, 0}}, 100).empty());
  EXPECT_TRUE(spectral::make_emitters({}, 100).empty());
  EXPECT_EQ(spectral::count_photons({}), 0u);
}

TEST(Emitters, SequencesAreLongerThan32Bits)
{
  shared::DeviceEmitter emitter{};
  emitter.sequence_start = 0xfffffff0u;
  spectral::advance_sequence(emitter, 0x20);
  EXPECT_EQ(emitter.sequence_start, 0x10u);
  EXPECT_EQ(emitter.sequence_start_high, 1u);
  spectral::advance_sequence(emitter, std::uint64_t{5} << 32);
  EXPECT_EQ(emitter.sequence_start, 0x10u);
  EXPECT_EQ(emitter.sequence_start_high, 6u);
}

} // namespace nephroid::emitters_test
