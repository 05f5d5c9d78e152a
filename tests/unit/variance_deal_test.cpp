// SPDX-License-Identifier: Apache-2.0
// Dealing photons by measured variance: the optimum of a case worked out by hand, and what must never be lost on the way.
#include "spectral/effort/emitters.h"
#include "tests/support/saved_jobs.h"
#include "tests/support/test.h"

namespace nephroid::variance_deal_test {

using spectral::VarianceDeal;

std::vector<shared::DeviceEmitter> emitters(const std::vector<unsigned>& counts)
{
  std::vector<shared::DeviceEmitter> all;
  for (const unsigned count : counts) {
    shared::DeviceEmitter emitter{};
    emitter.photon_count = count;
    all.push_back(emitter);
  }
  spectral::number_photons(all);
  return all;
}

TEST(VarianceDeal, IsDueBeforePassesThatArePowersOfTwo)
{
  VarianceDeal deal(emitters({10, 10}));
  std::vector<int> due;
  for (int pass = 0; pass < 70; ++pass) {
    if (!deal.is_due(pass)) continue;
    due.push_back(pass);
    deal.deal(pass, std::vector<std::int64_t>{1, 1}, 2);
  }
  EXPECT_EQ(due, (std::vector<int>{2, 4, 8, 16, 32, 64}));
}

// Two emitters with n = 100 photons each; a photon of the first adds v with v^2 = 9, of the second v^2 = 1. V_e = n * sum of v^2 a pass
// stand as 9 to 1, their roots as 3 to 1: 150 and 50 of the 200 photons; nine tenths of that and one of the first deal, 145 and 55.
TEST(VarianceDeal, GoesByTheRootOfTheVariance)
{
  VarianceDeal deal(emitters({100, 100}));
  deal.deal(2, std::vector<std::int64_t>{2 * 100 * 9, 2 * 100 * 1}, 2);
  EXPECT_NEAR(deal.emitters()[0].photon_count, 145, 1);
  EXPECT_EQ(deal.emitters()[0].photon_count + deal.emitters()[1].photon_count, 200u);
  EXPECT_EQ(deal.emitters()[1].first_photon, deal.emitters()[0].photon_count);
  // What it measures from then on has other counts and the same variances: v goes as 1 / n. The deal stays.
  const double a = deal.emitters()[0].photon_count, b = deal.emitters()[1].photon_count;
  deal.deal(4, std::vector<std::int64_t>{std::llround(2 * a * 9 * 1e4 / (a * a)), std::llround(2 * b * 1e4 / (b * b))}, 2);
  EXPECT_NEAR(deal.emitters()[0].photon_count, 145, 1);
}

TEST(VarianceDeal, NobodyGoesWithoutAndNothingIsLost)
{
  VarianceDeal deal(emitters({1, 1000, 7, 1}));
  deal.deal(2, std::vector<std::int64_t>{0, std::int64_t{1} << 60, 0, 0}, 1);
  unsigned all = 0;
  for (const shared::DeviceEmitter& e : deal.emitters()) {
    EXPECT_GE(e.photon_count, 1u);
    EXPECT_EQ(e.first_photon, all);
    all += e.photon_count;
  }
  EXPECT_EQ(all, 1009u);
  VarianceDeal dark(emitters({30, 70}));
  dark.deal(2, std::vector<std::int64_t>{0, 0}, 2);
  EXPECT_EQ(dark.emitters()[0].photon_count, 30u);
}

// A light has one sequence for each half of the film: after 2 passes of 100 photons it has used 100 of each, after 4 200.
TEST(VarianceDeal, SequencesGoOnWhereTheyWere)
{
  VarianceDeal deal(emitters({40, 60}));
  deal.deal(2, std::vector<std::int64_t>{1, 1}, 2);
  for (const shared::DeviceEmitter& e : deal.emitters()) EXPECT_EQ(e.sequence_start, 100u);
  deal.deal(4, std::vector<std::int64_t>{1, 1}, 2);
  for (const shared::DeviceEmitter& e : deal.emitters()) EXPECT_EQ(e.sequence_start, 200u);
  VarianceDeal whole(emitters({40, 60}));
  whole.deal(2, std::vector<std::int64_t>{1, 1}, 1);
  EXPECT_EQ(whole.emitters()[0].sequence_start, 200u);
}

// Sums of v^2 of two passes each: 2 * 900 as dealt first, then 2 * 300, then 2 * 450.
TEST(VarianceDeal, KnowsWhatItHasGained)
{
  VarianceDeal deal(emitters({40, 60}));
  EXPECT_EQ(deal.gain(), 1);
  deal.deal(2, std::vector<std::int64_t>{1000, 800}, 2);
  EXPECT_EQ(deal.gain(), 1);
  deal.deal(4, std::vector<std::int64_t>{500, 100}, 2);
  EXPECT_DOUBLE_EQ(deal.gain(), 3);
  deal.deal(8, std::vector<std::int64_t>{900, 900}, 2);
  EXPECT_DOUBLE_EQ(deal.gain(), 2);
}

TEST(VarianceDeal, CanGoBackToTheFirst)
{
  VarianceDeal deal(emitters({40, 60}));
  deal.deal(2, std::vector<std::int64_t>{1, 900}, 2);
  EXPECT_NE(deal.emitters()[0].photon_count, 40u);
  deal.deal_as_first(4, 2);
  EXPECT_EQ(deal.emitters()[0].photon_count, 40u);
  EXPECT_EQ(deal.emitters()[1].photon_count, 60u);
  EXPECT_EQ(deal.first_pass(), 4);
  for (const shared::DeviceEmitter& e : deal.emitters()) EXPECT_EQ(e.sequence_start, 200u);
}

TEST(VarianceDeal, IsSavedWhole)
{
  VarianceDeal deal(emitters({40, 60}));
  deal.deal(2, std::vector<std::int64_t>{5, 700}, 2);
  const std::vector<std::byte> bytes = test::saved<tracing::State>(deal);
  VarianceDeal other(emitters({40, 60}));
  EXPECT_TRUE(test::load<tracing::State>(other, bytes));
  deal.deal(4, std::vector<std::int64_t>{100, 3}, 2);
  other.deal(4, std::vector<std::int64_t>{100, 3}, 2);
  for (std::size_t e = 0; e < 2; ++e) EXPECT_EQ(other.emitters()[e].photon_count, deal.emitters()[e].photon_count);
  EXPECT_EQ(other.gain(), deal.gain());
}

} // namespace nephroid::variance_deal_test
