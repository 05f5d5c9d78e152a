// SPDX-License-Identifier: Apache-2.0
#include "tests/support/test.h"
#include "ui/state/undo.h"

namespace nephroid::ui::undo_test {

preset::Preset with_seed(std::uint64_t seed) { return {.seed = seed}; }

TEST(UndoStack, GoesBackAndForth) {
  UndoStack history(with_seed(1));
  EXPECT_FALSE(history.undo());
  EXPECT_FALSE(history.redo());
  history.push("two", with_seed(2));
  history.push("three", with_seed(3));
  EXPECT_EQ(history.undo_label(), "three");
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.current().seed, 2u);
  EXPECT_EQ(history.undo_label(), "two");
  EXPECT_EQ(history.redo_label(), "three");
  EXPECT_TRUE(history.redo());
  EXPECT_EQ(history.current().seed, 3u);
  EXPECT_EQ(history.opened().seed, 1u);
}

TEST(UndoStack, AnEditAfterUndoDropsWhatCouldBeRedone) {
  UndoStack history(with_seed(1));
  history.push("two", with_seed(2));
  history.undo();
  history.push("four", with_seed(4));
  EXPECT_FALSE(history.redo());
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.current().seed, 1u);
}

TEST(UndoStack, AGestureIsOneEntry) {
  UndoStack history(with_seed(1));
  for (std::uint64_t seed = 2; seed < 10; ++seed) history.push("drag", with_seed(seed), 7);
  history.push("drag", with_seed(20), 8);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.current().seed, 9u);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.current().seed, 1u);
  EXPECT_FALSE(history.undo());
}

TEST(UndoStack, AGestureThatGoesOnAfterUndoDoesNotOverwriteWhatItFinds) {
  UndoStack history(with_seed(1));
  history.push("drag", with_seed(2), 7);
  history.push("other", with_seed(3));
  history.undo();
  history.push("drag", with_seed(4), 7);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.current().seed, 2u);
}

TEST(UndoStack, KnowsWhetherTheStateIsSaved) {
  UndoStack history(with_seed(1));
  EXPECT_FALSE(history.modified());
  history.push("two", with_seed(2), 5);
  EXPECT_TRUE(history.modified());
  history.undo();
  EXPECT_FALSE(history.modified());
  history.redo();
  history.mark_saved("there.json");
  EXPECT_FALSE(history.modified());
  EXPECT_EQ(history.current().source, "there.json");
  history.undo();
  EXPECT_TRUE(history.modified());
  EXPECT_EQ(history.current().source, "there.json"); // undo does not go back to another file
  history.push("three", with_seed(3));               // the saved state is gone for good
  EXPECT_TRUE(history.modified());
  history.undo();
  EXPECT_TRUE(history.modified());
}

TEST(UndoStack, ASavedStateThatAGestureGoesOnToChangeIsNotSaved) {
  UndoStack history(with_seed(1));
  history.push("drag", with_seed(2), 5);
  history.mark_saved("there.json");
  history.push("drag", with_seed(3), 5);
  EXPECT_TRUE(history.modified());
}

TEST(UndoStack, IsBounded) {
  UndoStack history(with_seed(0));
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) history.push("edit", with_seed(seed));
  int undone = 0;
  while (history.undo()) ++undone;
  EXPECT_EQ(undone, 999);
  EXPECT_EQ(history.current().seed, 501u);
  EXPECT_TRUE(history.modified());
}

} // namespace nephroid::ui::undo_test
