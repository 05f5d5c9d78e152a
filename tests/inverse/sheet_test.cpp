// SPDX-License-Identifier: Apache-2.0
// The sheet of pictures: how much of it they fill, and the words above them.
#include "inverse/sheet.h"
#include "tests/support/test.h"

namespace nephroid::sheet_test {

using inverse::Captioned;

/// So many lists of three white pictures.
std::vector<std::vector<Captioned>> lists(std::size_t count, const std::string& words, glm::ivec2 cells = {64, 64}) {
  const std::vector<double> white(static_cast<std::size_t>(cells.x * cells.y), 1);
  const auto picture = inverse::grey_picture(white, 0.5, cells);
  return std::vector(count, std::vector(3, Captioned{picture, words}));
}

/// The part of the sheet that has a value above `low` and up to `high`.
double part(const job::Picture& sheet, float low, float high) {
  const auto inside = std::ranges::count_if(sheet.rgb, [&](float value) { return value > low && value <= high; });
  return static_cast<double>(inside) / static_cast<double>(sheet.rgb.size());
}

TEST(InverseSheet, PicturesFillIt) {
  // The room that a picture has is never used up by less than what another division of the sheet would give it.
  EXPECT_GT(part(*inverse::sheet(lists(3, ""), {1, 1}, 768, 768), 0.4f, 0.6f), 0.75);
  EXPECT_GT(part(*inverse::sheet(lists(1, ""), {1, 1}, 768, 768), 0.4f, 0.6f), 0.6)
      << "two columns: three quarters but for words and gaps";
  EXPECT_GT(part(*inverse::sheet(lists(4, ""), {1, 1}, 1024, 768), 0.4f, 0.6f), 0.75);
  EXPECT_GT(part(*inverse::sheet(lists(4, ""), {1, 1}, 768, 1024), 0.4f, 0.6f), 0.75) << "receivers are rows";
  EXPECT_GT(part(*inverse::sheet(lists(2, "", {64, 32}), {2, 1}, 768, 576), 0.4f, 0.6f), 0.6);
  EXPECT_EQ(inverse::sheet(lists(2, "", {32, 32}), {2, 1}, 768, 576)->rgb,
            inverse::sheet(lists(2, "", {64, 32}), {2, 1}, 768, 576)->rgb)
      << "cells need not be square";
}

TEST(InverseSheet, WordsStandAboveThePictures) {
  const auto with_words = inverse::sheet(lists(3, "wanted at 100 mm"), {1, 1}, 768, 768),
             without = inverse::sheet(lists(3, ""), {1, 1}, 768, 768);
  EXPECT_EQ(part(*without, 0.6f, 2), 0);
  EXPECT_GT(part(*with_words, 0.6f, 2), 0.005);
  // No grey of a letter's edge is as near a half.
  EXPECT_EQ(part(*with_words, 0.4999f, 0.5001f), part(*without, 0.4999f, 0.5001f)) << "and not on them";
  // What nobody could read is not written; any size is a sheet.
  for (const int size : {1, 5, 60})
    EXPECT_EQ(part(*inverse::sheet(lists(3, "wanted at 100 mm"), {1, 1}, size, size), 0.6f, 2), 0) << size;
}

} // namespace nephroid::sheet_test
