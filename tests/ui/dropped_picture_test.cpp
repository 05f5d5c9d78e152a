// SPDX-License-Identifier: Apache-2.0
// A picture that is dropped on a preset of the engine inverse is what the object casts; elsewhere a message says what can be done with it.
#include "inverse/settings.h"
#include "workbench_fixture.h"

namespace nephroid::ui::dropped_picture_test {

class DroppedPicture : public test::WorkbenchFixture {
protected:
  const std::vector<inverse::Receiver>& receivers() const { return workbench.preset()->settings.as<inverse::Settings>().receivers; }
  std::string picture = folder.write("face.png", "a run reads it");
};

TEST_F(DroppedPicture, TakesThePlaceOfTheDrawingsOneAfterTheOther)
{
  ASSERT_TRUE(workbench.open("inverse/shapes"));
  const std::vector<inverse::Receiver> before = receivers();
  ASSERT_EQ(before.size(), 3u);
  const std::string opened = preset::to_json(*workbench.preset());
  workbench.apply({command::Open{picture}});
  EXPECT_EQ(receivers()[0].picture.file, picture);
  EXPECT_EQ(receivers()[0].distance_mm, before[0].distance_mm);
  EXPECT_EQ(receivers()[1], before[1]);
  const std::string other = folder.write("other.JPG", "");
  workbench.apply({command::Open{other}});
  EXPECT_EQ(receivers()[0].picture.file, picture);
  EXPECT_EQ(receivers()[1].picture.file, other);
  workbench.apply({command::Undo{}, command::Undo{}});
  EXPECT_EQ(preset::to_json(*workbench.preset()), opened);
}

TEST_F(DroppedPicture, ThatIsNotThereChangesNothing)
{
  ASSERT_TRUE(workbench.open("inverse/shapes"));
  workbench.apply({command::Open{(folder.path() / "gone.png").string()}});
  ASSERT_FALSE(workbench.messages().empty());
  EXPECT_THAT(workbench.messages().back().line, ::testing::HasSubstr("there is no such picture"));
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(DroppedPicture, SaysWhatToDoWithItElsewhere)
{
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text)));
  workbench.apply({command::Open{picture}});
  ASSERT_FALSE(workbench.messages().empty());
  EXPECT_THAT(workbench.messages().back().line, ::testing::HasSubstr("is a picture"));
  EXPECT_THAT(workbench.messages().back().line, ::testing::HasSubstr("engine inverse"));
  EXPECT_FALSE(workbench.edits()->modified());
}

} // namespace nephroid::ui::dropped_picture_test
