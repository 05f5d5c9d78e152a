// SPDX-License-Identifier: Apache-2.0
// Which rank works on what.
#include "base/communicator.h"
#include "tests/support/test.h"
#include "tracing/slices.h"

namespace nephroid::communicator_test {

class Alone final : public Communicator::Transport { // a rank that nobody answers
public:
  Alone(int rank, int size) : rank_(rank), size_(size) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void all_reduce_sum(std::span<std::int64_t>) override {}
  void all_reduce_or(std::span<std::byte>) override {}
  void broadcast(std::span<std::byte>) override {}

private:
  int rank_, size_;
};

Communicator rank_of(int rank, int size) { return Communicator(std::make_shared<Alone>(rank, size)); }

/// How many ranks work on each of the items when all of them go through the parts first .. first + step - 1, ...
std::vector<int> workers(int ranks, std::int64_t items, std::int64_t step) {
  std::vector<int> count(static_cast<std::size_t>(items));
  for (int rank = 0; rank < ranks; ++rank)
    for (std::int64_t first = 0; first < items; first += step)
      Partition(rank_of(rank, ranks), items)
          .for_own(first, std::min(step, items - first), [&](std::int64_t begin, std::int64_t own) {
            for (std::int64_t i = begin; i < begin + own; ++i) ++count[static_cast<std::size_t>(i)];
          });
  return count;
}

TEST(Partition, GiveEachItemToOneRank) {
  for (const int ranks : {1, 2, 3, 7, 64})
    for (const std::int64_t items : {1, 5, 64, 1000, 1009})
      for (const std::int64_t step : {std::int64_t{1}, std::int64_t{13}, items})
        EXPECT_EQ(workers(ranks, items, step), std::vector<int>(static_cast<std::size_t>(items), 1))
            << ranks << " " << items << " " << step;
}

TEST(Partition, AreTheSameHoweverPartsAreCut) {
  const auto of_rank = [](std::int64_t step) {
    std::set<std::int64_t> own;
    for (std::int64_t first = 0; first < 1000; first += step)
      Partition(rank_of(1, 3), 1000)
          .for_own(first, std::min(step, 1000 - first), [&](std::int64_t begin, std::int64_t count) {
            for (std::int64_t i = begin; i < begin + count; ++i) own.insert(i);
          });
    return own;
  };
  EXPECT_EQ(of_rank(1000), of_rank(7));
  EXPECT_NEAR(static_cast<double>(of_rank(7).size()), 1000.0 / 3, 8);
}

TEST(Partition, KeepsWhatOneRankOwns) {
  std::vector<int> sum(2 * 3 * 100); // two rounds of 100 items of 3 values
  for (int rank = 0; rank < 4; ++rank) {
    std::vector<int> own(sum.size(), 1);
    Partition(rank_of(rank, 4), 100).clear_others(std::span(own), 3);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += own[i];
    EXPECT_EQ(std::vector<int>(own.begin(), own.begin() + 300), std::vector<int>(own.begin() + 300, own.end()));
    int first = 0;
    Partition(rank_of(rank, 4), 100).for_own(0, 100, [&](std::int64_t begin, std::int64_t) {
      first += own[static_cast<std::size_t>(3 * begin)];
    });
    EXPECT_GT(first, 0);
  }
  EXPECT_EQ(sum, std::vector<int>(sum.size(), 1));
}

TEST(PhotonSlices, HaveEachPhotonOfEachBatchOnce) {
  constexpr std::uint32_t photons = 10000;
  constexpr std::int64_t batches = 40;
  std::vector<int> count(photons * batches);
  std::int64_t longest = 0;
  for (int rank = 0; rank < 3; ++rank) {
    tracing::PhotonSlices slices; // they do nothing, so each is twice as long as the one before
    for (std::int64_t batch = 0; batch < batches;) {
      const std::int64_t done = slices.advance(
          rank_of(rank, 3), photons,
          [&](const tracing::PhotonSlice& slice) {
            for (std::uint32_t i = 0; i < slice.count; ++i)
              ++count[static_cast<std::size_t>(batch * photons + slice.offset + i * slice.stride)];
          },
          std::min<std::int64_t>(batches - batch, 16));
      longest = std::max(longest, done);
      batch += done;
    }
  }
  EXPECT_EQ(count, std::vector<int>(count.size(), 1));
  EXPECT_GT(longest, 1);
  EXPECT_LE(longest, 16);
}

TEST(Communicator, KeepsEverySoManyethItem) {
  std::vector<int> items{0, 1, 2, 3, 4, 5, 6};
  rank_of(2, 3).keep_own_share(items);
  EXPECT_THAT(items, testing::ElementsAre(2, 5));
  rank_of(1, 2).keep_own_share(items);
  EXPECT_THAT(items, testing::ElementsAre(5));
  Communicator().keep_own_share(items);
  EXPECT_THAT(items, testing::ElementsAre(5));
}

} // namespace nephroid::communicator_test
