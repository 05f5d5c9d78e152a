// SPDX-License-Identifier: Apache-2.0
// Words, QR codes and grey levels as light a cell.
#include "inverse/pictures/target.h"
#include "tests/inverse/drawn.h"
#include "tests/support/test.h"

namespace nephroid::pictures_test {

using namespace inverse;

Layout cells(int across, int down) { return {.receiver = glm::dvec2(across, down), .cells = {across, down}}; }

Picture words(const std::string& text, double length) {
  return {.type = Picture::Type::text, .text = text, .length = length};
}

Picture code(const std::string& text) { return {.type = Picture::Type::qr, .text = text}; }

struct Box {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

Box lit(const Target& target, int across) {
  Box box;
  for (std::size_t c = 0; c < target.size(); ++c) {
    if (target[c] <= 0) continue;
    const int x = static_cast<int>(c) % across, y = static_cast<int>(c) / across;
    box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y), std::max(box.bottom, y)};
  }
  return box;
}

TEST(Pictures, WordsAreAsWideAsTheyShouldBeAndUpright) {
  const Target target = drawn(words("L", 0.4), cells(100, 80)); // 32 cells of the shorter side's 80
  const Box box = lit(target, 100);
  EXPECT_NEAR(box.right - box.left + 1, 32, 1);
  EXPECT_NEAR(box.left + box.right, 99, 1); // centred
  EXPECT_NEAR(box.top + box.bottom, 79, 1);
  // An L is dark at its upper right alone.
  const auto at = [&](int x, int y) { return target[static_cast<std::size_t>(y * 100 + x)]; };
  EXPECT_GT(at(box.left + 2, box.top + 2), 0);
  EXPECT_GT(at(box.left + 2, box.bottom - 2), 0);
  EXPECT_GT(at(box.right - 2, box.bottom - 2), 0);
  EXPECT_EQ(at(box.right - 2, box.top + 2), 0);
}

TEST(Pictures, WordsTurn) {
  Picture picture = words("WIDE", 0.9);
  const Box before = lit(drawn(picture, cells(90, 90)), 90);
  picture.turn_deg = 90;
  const Box after = lit(drawn(picture, cells(90, 90)), 90);
  EXPECT_NEAR(before.right - before.left, after.bottom - after.top, 1);
  EXPECT_NEAR(before.bottom - before.top, after.right - after.left, 1);
  EXPECT_GT(before.right - before.left, 2 * (before.bottom - before.top));
}

// Version 1 has 21 modules and 4 of quiet zone on each side: 58 cells are 29 modules of 2 cells.
TEST(Pictures, ACodeIsWholeCellsWithItsQuietZone) {
  for (const auto& [across, module] : {std::pair(58, 2), {64, 2}, {29, 1}, {128, 4}}) {
    const Target target = drawn(code("NEPHROID"), cells(across, across));
    const double most = *std::max_element(target.begin(), target.end());
    const int corner = (across - 29 * module) / 2;
    // In modules from the code's corner: the finder patterns are 7 wide, with a light ring in them; their middles are 3
    // from the edges.
    const auto light = [&](int u, int v) {
      const int x = corner + (u + 4) * module, y = corner + (v + 4) * module;
      return target[static_cast<std::size_t>(y * across + x)] / most;
    };
    for (const auto& [u, v] : {std::pair(3, 3), {17, 3}, {3, 17}}) {
      EXPECT_EQ(light(u, v), 0);
      EXPECT_EQ(light(u + 2, v), 1);
      EXPECT_EQ(light(u + 3, v), 0);
    }
    for (int i = 0; i < 21; ++i) EXPECT_EQ(light(-1, i) * light(i, -1) * light(21, i) * light(i, 21), 1);
    EXPECT_EQ(light(-4, -4), 1);
    for (int i = 8; i < 13; ++i) EXPECT_EQ(light(i, 6), i % 2); // the timing pattern
  }
}

TEST(Pictures, ACodeSaysHowManyCellsWouldDo) {
  EXPECT_THAT(test::refusal_of([] { drawn(code("NEPHROID"), cells(28, 64)); }),
              AllOf(HasSubstr("p#/text: needs a QR code of version 1, 29 modules with its quiet zone, and the receiver "
                              "has 28 x 64 cells"),
                    HasSubstr("expected at least 29 cells across and down, better 58")));
  EXPECT_NO_THROW(drawn(code("NEPHROID"), cells(29, 64)));
  EXPECT_THAT(test::refusal_of([] { drawn(code(std::string(60, 'x')), cells(36, 36)); }),
              HasSubstr("version 4")); // 78 bytes at level L
  EXPECT_THAT(test::refusal_of([] { drawn(code(std::string(2954, 'x')), cells(1024, 1024)); }),
              HasSubstr("more than any QR code holds"));
}

TEST(Pictures, WordsWithoutLetters) {
  EXPECT_THAT(test::refusal_of([] { drawn(words("  ", 0.5), cells(32, 32)); }),
              HasSubstr("p: leaves every cell of the receiver dark"));
}

// A face is lit, has grey levels, and its eyes are darker than its brow.
TEST(Pictures, AFaceHasGreyLevels) {
  Picture picture{.type = Picture::Type::face, .radius = 0.5};
  const Target target = drawn(picture, cells(64, 64));
  std::vector<double> values(target);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  EXPECT_GT(values.size(), 1000u);
  const auto at = [&](double x, double y) { // of the ball's radius
    return target[static_cast<std::size_t>(32 - 32 * y) * 64 + static_cast<std::size_t>(32 + 32 * x)];
  };
  for (const double side : {-0.35, 0.35}) EXPECT_LT(at(side, 0.25), 0.4 * at(side, 0.65));
  EXPECT_LT(at(0, -0.55), 0.4 * at(0, -0.2));
}

} // namespace nephroid::pictures_test
