// SPDX-License-Identifier: Apache-2.0
// Pictures in blocks of pixels, and back.
#include "photons/coarse.h"

#include <gmock/gmock.h>

namespace nephroid::coarse_test {

using photons::Blocks;
using testing::Each;
using testing::ElementsAre;
using testing::FloatEq;
using testing::IsEmpty;

TEST(Coarse, FirstPicturesHaveFewBlocks) {
  EXPECT_THAT(photons::preview_edges(512, 512), ElementsAre(16, 8, 4));
  EXPECT_THAT(photons::preview_edges(128, 128), ElementsAre(4, 2));
  EXPECT_THAT(photons::preview_edges(64, 64), IsEmpty()) << "that is few pixels as it is";
  EXPECT_THAT(photons::preview_edges(8192, 8192), ElementsAre(256, 128, 64));
}

TEST(Coarse, ABlockIsTheMeanOfItsPixelsAlsoWhereItIsCut) {
  std::vector<float> rgb; // 3 x 2 pixels: 0 1 2 / 3 4 5 in R, ten times that in G, 7 in B
  for (int i = 0; i < 6; ++i) rgb.insert(rgb.end(), {static_cast<float>(i), 10.0f * static_cast<float>(i), 7});
  const Blocks blocks{3, 2, 2};
  EXPECT_EQ(blocks.across(), 2);
  EXPECT_EQ(blocks.down(), 1);
  EXPECT_EQ(blocks.block_of(5), 1u);
  EXPECT_THAT(photons::mean_of_blocks(blocks, rgb), ElementsAre(2, 20, 7, 3.5, 35, 7));
}

TEST(Coarse, PlacesTellHowNoisyABlockIs) {
  const Blocks blocks{256, 256, 4};
  EXPECT_THAT(photons::draw_by_places(blocks, std::vector<float>(3 * 256 * 256, 2.0f)), Each(0));
  std::mt19937 random(1);
  std::poisson_distribution<int> photons(3);
  std::vector<float> rgb(3 * 256 * 256);
  for (float& value : rgb) value = static_cast<float>(photons(random));
  double square = 0;
  for (const float draw : photons::draw_by_places(blocks, rgb)) square += draw * draw / (3 * 64 * 64);
  EXPECT_NEAR(square, 3.0 / 16, 0.02) << "the variance of a mean of 16";
}

TEST(Coarse, BetweenBlocksValuesChangeEvenly) {
  const Blocks blocks{12, 4, 4};
  EXPECT_THAT(photons::between_blocks(blocks, std::vector<float>(9, 0.25f)), Each(FloatEq(0.25f)));
  const std::vector<float> ramp = photons::between_blocks(blocks, std::vector<float>{0, 0, 0, 4, 4, 4, 8, 8, 8});
  for (int x = 2; x < 10; ++x) // from the middle of the first block to that of the last
    EXPECT_FLOAT_EQ(ramp[3 * static_cast<std::size_t>(x)], static_cast<float>(x) - 1.5f) << x;
  EXPECT_EQ(ramp.front(), 0) << "before it nothing is known";
}

} // namespace nephroid::coarse_test
