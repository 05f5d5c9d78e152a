// SPDX-License-Identifier: Apache-2.0
// Rows by rising wavelength under edits: they keep apart and inside what a preset may have, drags are one entry, what
// cannot be is said.
#include "optics/dispersion.h"
#include "preset/field.h"
#include "tests/support/test.h"
#include "ui/spectral/dispersion/model.h"
#include "ui/spectral/spectra/curves.h"
#include "ui/widgets/rows.h"

namespace nephroid::ui::rows_test {

using Kind = RowGesture::Kind;

const std::vector<Row> three{{400, 1.6}, {500, 1.55}, {700, 1.5}};
const RowRules powers = row_rules({preset::LightSpectrum::Type::table, "", 0, {}});
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

TEST(SortedRows, KeepApart) {
  std::vector<Row> rows = three;
  move_row(rows, 1, {300, 1.7}, point_rules);
  EXPECT_EQ(rows[1], (Row{400.5, 1.7})) << "not over its neighbour, nor to its wavelength";
  move_row(rows, 1, {1e9, 1.4}, point_rules);
  EXPECT_EQ(rows[1], (Row{699.5, 1.4}));
  EXPECT_NO_THROW(optics::control_points(rows));
  move_row(rows, 1, {900, 2}, powers);
  EXPECT_EQ(rows[1], (Row{699.9, 2}));
  rows[0][0] = 500.3;
  move_row(rows, 1, {0, 2}, powers);
  EXPECT_EQ(rows[1][0], 500.4) << "not 500.40000000000003";
}

TEST(SortedRows, StayInsideWhatAPresetMayHave) {
  std::vector<Row> rows = three;
  move_row(rows, 0, {-20, -5}, point_rules);
  move_row(rows, 2, {1e12, 1e6}, point_rules);
  EXPECT_THAT(rows, ElementsAre(Row{1, 0.01}, three[1], Row{1e6, 100}));
  move_row(rows, 0, {400, -5}, powers);
  move_row(rows, 2, {700, 1e300}, powers);
  EXPECT_THAT(rows, ElementsAre(Row{400, 0}, three[1], Row{700, 1e9}));
}

TEST(SortedRows, PlacesThatAreNoneChangeNothing) {
  std::vector<Row> rows = three;
  for (const Row& to : {Row{nan, 1.5}, Row{500, nan}, Row{infinity, 1.5}, Row{500, -infinity}}) {
    move_row(rows, 1, to, point_rules);
    EXPECT_FALSE(add_row(rows, to, point_rules));
  }
  move_row(rows, 3, {600, 1.5}, point_rules);
  EXPECT_EQ(rows, three);
}

TEST(SortedRows, NeighboursOfAFileMayBeNearerThanADragCanBringThem) {
  std::vector<Row> rows{{400, 1.6}, {400.2, 1.5}, {400.4, 1.4}};
  move_row(rows, 1, {410, 1.55}, point_rules);
  EXPECT_EQ(rows[1], (Row{400.2, 1.55})) << "it stays between them";
}

TEST(SortedRows, ComeInOrderAndNotTwiceAtAWavelength) {
  std::vector<Row> rows = sorted_rows({three[2], three[0], three[1]});
  EXPECT_EQ(rows, three);
  EXPECT_EQ(add_row(rows, {600, 1.52}, point_rules), 2u);
  EXPECT_EQ(add_row(rows, {390, 1.52}, point_rules), 0u);
  EXPECT_EQ(add_row(rows, {800, 1.52}, point_rules), 5u);
  const std::vector<Row> before = rows;
  for (const double nm : {600.0, 600.4, 599.6}) EXPECT_FALSE(add_row(rows, {nm, 1.7}, point_rules)) << nm;
  EXPECT_EQ(rows, before);
}

// 500.4 - 500.3 is less than 0.1 by rounding.
TEST(SortedRows, ARowIsAddedAsNearAsOneIsDragged) {
  for (const double nm : {500.2, 500.4}) {
    std::vector<Row> rows{{400, 1}, {500.3, 1}, {700, 1}};
    EXPECT_TRUE(add_row(rows, {nm, 1}, powers)) << nm;
  }
  std::vector<Row> rows{{500.3, 1}};
  EXPECT_FALSE(add_row(rows, {500.3999, 1}, powers));
  EXPECT_FALSE(add_row(rows, {500.2001, 1}, powers));
}

TEST(SortedRows, TheFewestStay) {
  std::vector<Row> rows = three;
  EXPECT_FALSE(remove_row(rows, 3, point_rules));
  EXPECT_TRUE(remove_row(rows, 1, point_rules));
  EXPECT_FALSE(remove_row(rows, 0, point_rules));
  EXPECT_THAT(rows, ElementsAre(three[0], three[2]));
}

TEST(SortedRows, TheWidestGapIsWithinTheVisible) {
  EXPECT_EQ(middle_of_widest_gap({{200, 1.6}, {300, 1.5}}), 580);
  EXPECT_EQ(middle_of_widest_gap({{400, 1.6}, {500, 1.5}, {700, 1.5}}), 600);
  EXPECT_EQ(middle_of_widest_gap({{500, 1.6}, {2000, 1.5}}), 640) << "from 500 to 780 nm";
}

class RowEditorTest : public testing::Test {
protected:
  Gestures gestures{"test"};
  RowEditor editor{gestures};
  Commands commands;
  auto follow(const RowGesture& gesture) { return editor.follow(gesture, three, point_rules, commands); }
};

TEST_F(RowEditorTest, ADragIsOneGesture) {
  EXPECT_FALSE(follow({Kind::take, 1, {}}));
  EXPECT_EQ(editor.marked(), 1u);
  const auto first = follow({Kind::move, 1, {510, 1.55}}), second = follow({Kind::move, 1, {520, 1.56}});
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(first->live);
  EXPECT_EQ(first->label, "move a control point");
  EXPECT_EQ(first->gesture, second->gesture);
  EXPECT_EQ(second->rows[1], (Row{520, 1.56}));
  EXPECT_FALSE(follow({Kind::move, 1, three[1]})) << "it is there already";
  EXPECT_TRUE(commands.empty());
  EXPECT_FALSE(follow({Kind::let_go, 1, {}}));
  EXPECT_THAT(commands, SizeIs(1));
  follow({Kind::take, 1, {}});
  EXPECT_NE(follow({Kind::move, 1, {510, 1.55}})->gesture, first->gesture);
}

TEST_F(RowEditorTest, WhatIsAddedIsMarkedAndWhatIsRemovedIsNot) {
  ASSERT_TRUE(follow({Kind::add, 0, {600, 1.5}}));
  EXPECT_EQ(editor.marked(), 2u);
  editor.keep(2);
  EXPECT_FALSE(editor.marked()) << "undone";
  const auto removed = follow({Kind::remove, 1, {}});
  ASSERT_TRUE(removed);
  EXPECT_THAT(removed->rows, ElementsAre(three[0], three[2]));
  EXPECT_TRUE(commands.empty());
}

TEST_F(RowEditorTest, WhatCannotBeIsSaid) {
  EXPECT_FALSE(follow({Kind::add, 0, {500.2, 1.5}}));
  EXPECT_FALSE(editor.follow({Kind::remove, 0, {}}, {three[0], three[1]}, point_rules, commands));
  ASSERT_THAT(commands, SizeIs(2));
  EXPECT_THAT(std::get<command::Report>(commands[0]).line, HasSubstr("another is less than 0.5 nm from 500.2 nm"));
  EXPECT_THAT(std::get<command::Report>(commands[1]).line, HasSubstr("at least 2 must stay"));
}

TEST_F(RowEditorTest, WhyNothingIsAddedIsTrue) {
  std::vector<Row> full(preset::max_rows);
  for (std::size_t i = 0; i < full.size(); ++i) full[i] = {1000 + double(i), 1};
  EXPECT_FALSE(editor.follow({Kind::add, 0, {500, 1.5}}, full, point_rules, commands));
  EXPECT_FALSE(editor.follow({Kind::add, 0, {500.2, nan}}, three, point_rules, commands));
  EXPECT_FALSE(editor.follow({Kind::add, 0, {-3, 1.5}}, {{1, 1.5}, {500, 1.5}}, point_rules, commands));
  ASSERT_THAT(commands, SizeIs(3));
  EXPECT_EQ(std::get<command::Report>(commands[0]).line,
            "no control point was added: a preset has at most 100000 rows");
  EXPECT_EQ(std::get<command::Report>(commands[1]).line, "no control point was added: its place is not finite");
  EXPECT_EQ(std::get<command::Report>(commands[2]).line,
            "no control point was added: another is less than 0.5 nm from 1 nm")
      << "where it would be";
}

// Delete while the mouse drags: both edits would be of the rows as they were, and the later one would bring the row
// back.
TEST_F(RowEditorTest, WhatIsRemovedIsNotMovedInTheSameFrame) {
  editor.keep(3);
  follow({Kind::take, 1, {}});
  ASSERT_TRUE(follow({Kind::remove, 1, {}}));
  EXPECT_FALSE(follow({Kind::move, 1, {510, 1.55}}));
  editor.keep(2);
  EXPECT_TRUE(follow({Kind::move, 1, {510, 1.55}}));
}

} // namespace nephroid::ui::rows_test
