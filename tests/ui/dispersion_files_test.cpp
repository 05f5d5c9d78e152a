// SPDX-License-Identifier: Apache-2.0
// The panel "Dispersion" and files: they are loaded into the glass that is shown, become control points, and what is wrong with them is
// a message.
#include "dispersion_fixture.h"
#include "optics/dispersion.h"
#include "preset/read.h"
#include "spectral/clusters/clusters.h"
#include "ui/spectral/dispersion/panel.h"

namespace nephroid::ui::dispersion_files_test {

using spectral::ClusterMethod;

class DispersionFilesTest : public test::DispersionFixture {};

TEST_F(DispersionFilesTest, FilesAreLoadedIntoTheGlassThatIsShown)
{
  open_glass({{"a", from_points(five)}, {"glass", from_points(five)}});
  workbench.apply({command::ChooseMaterial{"glass"}});
  frames(2);
  workbench.apply({command::Open{shipped("N-BK7")}}); // what dropping a file does
  frames(2);
  EXPECT_EQ(dispersion().file, shipped("N-BK7"));
  EXPECT_EQ(dispersion("a"), from_points(five));
  EXPECT_EQ(panel().model().curve().name, "N-BK7");
  EXPECT_EQ(shown_count(ClusterMethod::thesis), 12u);
  EXPECT_EQ(workbench.edits()->undo_label(), "load N-BK7 into glass");
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(points(), five);
}

TEST_F(DispersionFilesTest, AFileThatCannotBeLoadedIsAMessage)
{
  open_glass({{"glass", from_points(five)}});
  for (const std::string& bad : {folder.write("broken.yml", "DATA: ["), folder.write("empty.yaml", ""),
                                 folder.write("only-k.yml", "DATA:\n  - type: tabulated k\n    data: |\n      0.3 0.1\n      0.9 0.1\n"),
                                 (folder.path() / "missing.yml").string()}) {
    workbench.apply({command::Open{bad}});
    frames(2);
    ASSERT_FALSE(workbench.messages().empty()) << bad;
    EXPECT_TRUE(workbench.messages().back().error);
    EXPECT_THAT(workbench.messages().back().line, HasSubstr(std::filesystem::path(bad).filename().string()));
    EXPECT_EQ(points(), five);
    EXPECT_FALSE(workbench.edits()->modified());
  }
  expect_true_counts();
}

TEST_F(DispersionFilesTest, WithoutGlassAFileIsRefused)
{
  open();
  workbench.apply({command::Open{shipped("N-BK7")}});
  ASSERT_THAT(workbench.messages(), SizeIs(1));
  EXPECT_THAT(workbench.messages()[0].line, HasSubstr("this preset has no dielectric"));
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(DispersionFilesTest, AGlassIsMadeEditableAndBackByUndo)
{
  open_glass({{"glass", from_file(shipped("N-SF66"))}});
  click("Make editable");
  frames(2);
  EXPECT_EQ(dispersion().type, preset::Dispersion::Type::points);
  EXPECT_EQ(panel().model().error(), "");
  EXPECT_EQ(shown_count(ClusterMethod::optimal), 32u);
  ASSERT_FALSE(workbench.messages().empty());
  EXPECT_THAT(workbench.messages().back().line, HasSubstr("they reproduce N-SF66 within 9e-05 of n"));
  drag_point(points()[3], {points()[3][0], points()[3][1] + 0.02});
  expect_true_counts();
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(dispersion(), from_file(shipped("N-SF66")));
}

TEST_F(DispersionFilesTest, ACurveThatIsNoneIsSaidAndNothingIsLost)
{
  preset::Dispersion nowhere; // n^2 = 1 - 5 l^2 / (l^2 - .01) < 0
  nowhere.type = preset::Dispersion::Type::sellmeier;
  nowhere.b = {-5};
  nowhere.c_um2 = {0.01};
  open_glass({{"glass", nowhere}});
  EXPECT_THAT(panel().model().error(), HasSubstr("gives no number at 380 nm"));
  preset::Dispersion refused = from_file(shipped("N-SF66"));
  refused.outside = preset::Outside::refuse;
  const preset::Dispersion missing = from_file("nowhere.yml");
  for (const preset::Dispersion& bad : {refused, missing, nowhere}) {
    edit([&](preset::Preset& p) { p.scene.materials.at("glass").dispersion = bad; });
    frames(3);
    EXPECT_NE(panel().model().error(), "");
    move(panel().plot().to_screen({500, 1.5}));
    click("Sorted");
    click("Make editable");
    EXPECT_EQ(dispersion(), bad) << "greyed";
  }
  workbench.apply({command::LoadDispersion{"N-BK7"}});
  frames(3);
  EXPECT_EQ(panel().model().error(), "");
}

} // namespace nephroid::ui::dispersion_files_test
