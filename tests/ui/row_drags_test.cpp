// SPDX-License-Identifier: Apache-2.0
// Rows that come or go while one is dragged: the drag ends, and no other row goes where the mouse goes.
#include "dispersion_fixture.h"

namespace nephroid::ui::row_drags_test {

class RowDragsTest : public test::DispersionFixture {
protected:
  /// The mouse holds the point; it was not moved yet.
  void take(const ControlPoint& point)
  {
    held_at_ = panel().plot().to_screen(point);
    press_at(held_at_);
  }
  /// By so many pixels from where it was taken, until the edit is drawn.
  void drag_by(double x, double y)
  {
    move({held_at_[0] + x, held_at_[1] + y});
    frame();
  }
  static std::vector<ControlPoint> without(std::vector<ControlPoint> points, std::size_t index)
  {
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(index));
    return points;
  }

private:
  ui::Point held_at_{};
};

TEST_F(RowDragsTest, ARightClickOnTheRowThatIsDraggedDoesNothing)
{
  open_glass({{"glass", from_points(five)}});
  take(five[2]);
  drag_by(6, -6);
  const std::vector<ControlPoint> before = points();
  ASSERT_NE(before, five);
  imgui.button(1, true);
  frame();
  imgui.button(1, false);
  frames(2);
  EXPECT_EQ(points(), before);
  drag_by(12, -12);
  EXPECT_NE(points()[2], before[2]) << "it is held all the same";
  EXPECT_EQ(without(points(), 2), without(five, 2));
  let_go();
  EXPECT_NE(imgui.pushed<command::EndGesture>(), nullptr);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(points(), five) << "one entry";
}

TEST_F(RowDragsTest, DeleteEndsTheDrag)
{
  open_glass({{"glass", from_points(five)}});
  take(five[2]);
  drag_by(6, -6);
  imgui.key(ImGuiKey_Delete, true);
  frame();
  imgui.key(ImGuiKey_Delete, false);
  frame();
  EXPECT_EQ(points(), without(five, 2));
  EXPECT_NE(imgui.pushed<command::EndGesture>(), nullptr);
  drag_by(20, -40);
  drag_by(-20, 40);
  EXPECT_EQ(points(), without(five, 2)) << "the mouse holds nothing until it is let go";
  let_go();
  frames(2);
  EXPECT_EQ(points(), without(five, 2));
  drag_point(five[3], {655, 1.54});
  EXPECT_NE(points()[2], five[3]) << "now it can take another one";
  EXPECT_THAT(workbench.messages(), IsEmpty());
}

TEST_F(RowDragsTest, DeleteWhileTheMouseMovesRemovesToo)
{
  open_glass({{"glass", from_points(five)}});
  take(five[2]);
  drag_by(6, -6);
  imgui.key(ImGuiKey_Delete, true);
  drag_by(8, -8); // in the same frame
  imgui.key(ImGuiKey_Delete, false);
  drag_by(30, -30);
  EXPECT_EQ(points(), without(five, 2));
  let_go();
  frames(2);
  EXPECT_EQ(points(), without(five, 2));
}

TEST_F(RowDragsTest, UndoOfAnAdditionEndsTheDrag)
{
  open_glass({{"glass", from_points(five)}});
  const auto place = panel().plot().to_screen({500, 1.6});
  for (int i = 0; i < 2; ++i) press_at(place), let_go();
  frames(2);
  ASSERT_EQ(points().size(), 6u);
  take(points()[2]);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  ASSERT_EQ(points(), five);
  drag_by(20, -40);
  drag_by(-20, 40);
  EXPECT_EQ(points(), five) << "the point at its index now is another one";
  let_go();
  frames(2);
  EXPECT_EQ(points(), five);
  workbench.apply({command::Redo{}});
  frames(2);
  EXPECT_EQ(points().size(), 6u) << "what was undone can be redone: nothing was edited since";
}

} // namespace nephroid::ui::row_drags_test
