// SPDX-License-Identifier: Apache-2.0
#include "tests/support/test.h"
#include "ui/view/placement.h"

namespace nephroid::ui::placement_test {

const Canvas canvas{{100, 50}, {800, 600}};
const std::array<int, 2> picture{400, 200};

TEST(Placement, FitShowsTheWholePictureInTheMiddle)
{
  const Placement p = place(Look{}, canvas, picture);
  EXPECT_DOUBLE_EQ(p.scale, 2);
  EXPECT_EQ(p.to_screen({0, 0}), (Point{100, 150}));
  EXPECT_EQ(p.to_screen({400, 200}), (Point{900, 550}));
}

TEST(Placement, ZoomKeepsThePointUnderTheCursor)
{
  const Point cursor{333, 222};
  Look look;
  const Point before = place(look, canvas, picture).to_picture(cursor);
  for (double factor : {1.3, 1.3, 2.0, 0.5, 0.1}) {
    look = zoomed(look, canvas, picture, cursor, factor);
    const Placement p = place(look, canvas, picture);
    const Point after = p.to_picture(cursor);
    for (int axis = 0; axis < 2; ++axis) EXPECT_NEAR(after[axis], before[axis], 0.51 / p.scale); // whole pixels of the screen
  }
  EXPECT_NEAR(look.zoom, 2 * 1.3 * 1.3 * 2.0 * 0.5 * 0.1, 1e-12);
  EXPECT_FALSE(look.fit);
}

TEST(Placement, ZoomIsBounded)
{
  Look look;
  for (int i = 0; i < 100; ++i) look = zoomed(look, canvas, picture, {400, 300}, 10);
  EXPECT_EQ(look.zoom, 256);
  for (int i = 0; i < 100; ++i) look = zoomed(look, canvas, picture, {400, 300}, 0.1);
  EXPECT_EQ(look.zoom, 1.0 / 64);
}

TEST(Placement, DraggingMovesThePictureWithTheMouse)
{
  const Look look = dragged(Look{}, canvas, picture, {30, -12});
  const Point moved = place(look, canvas, picture).to_screen({0, 0});
  EXPECT_EQ(moved, (Point{130, 138}));
}

TEST(Placement, PixelsAreFoundByTheirSquares)
{
  const Placement p = place(Look{}, canvas, picture);
  EXPECT_EQ(pixel_at(p, picture, {100, 150}), (std::array<int, 2>{0, 0}));
  EXPECT_EQ(pixel_at(p, picture, {101.9, 151.9}), (std::array<int, 2>{0, 0}));
  EXPECT_EQ(pixel_at(p, picture, {102, 150}), (std::array<int, 2>{1, 0}));
  EXPECT_EQ(pixel_at(p, picture, {899, 549}), (std::array<int, 2>{399, 199}));
  EXPECT_EQ(pixel_at(p, picture, {99.9, 150}), std::nullopt);
  EXPECT_EQ(pixel_at(p, picture, {900, 150}), std::nullopt);
}

} // namespace nephroid::ui::placement_test
