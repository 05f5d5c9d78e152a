// SPDX-License-Identifier: Apache-2.0
// IES and EULUMDAT files: what they say, in each symmetry, and what is refused.
#include "scene/photometry.h"
#include "tests/support/test.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace nephroid::photometry_test {

using scene::intensity;
using testing::HasSubstr;

class Photometry : public testing::Test {
protected:
  scene::Photometry read(const std::string& text, const std::string& name = "lamp.ies") {
    return scene::load_photometry(folder_.write(name, text));
  }
  std::string refusal(const std::string& text, const std::string& name = "lamp.ies") {
    return refusal_of([&] { read(text, name); });
  }
  TemporaryFolder folder_;
};

/// numbers: from the multiplier on, with angles and intensities.
std::string ies(const std::string& numbers, const std::string& tilt = "TILT=NONE\n") {
  return "IESNA:LM-63-1995\n[TEST] 1\n" + tilt + "1 1000 " + numbers;
}
const std::string size = " 1 2 0 0 0\n1 1 10\n"; // type C

TEST_F(Photometry, RotatesWhatHasOnePlane) {
  const scene::Photometry p = read(ies("2 3 1" + size + "0 30, 90\n0\n10 5\n1\n"));
  EXPECT_DOUBLE_EQ(intensity(p, 0, 0), 20);
  EXPECT_DOUBLE_EQ(intensity(p, 15, 200), 15);
  EXPECT_DOUBLE_EQ(intensity(p, 60, 359), 6);
  EXPECT_DOUBLE_EQ(intensity(p, 90, 10), 2);
  EXPECT_DOUBLE_EQ(intensity(p, 90.1, 10), 0);
}

TEST_F(Photometry, FillsInWhatSymmetrySays) {
  const scene::Photometry quarters = read(ies("1 2 3" + size + "0 180\n0 45 90\n1 1\n2 2\n4 4\n"));
  for (const double c : {22.5, 180 - 22.5, 180 + 22.5, 360 - 22.5}) EXPECT_DOUBLE_EQ(intensity(quarters, 50, c), 1.5);
  for (const double c : {90.0, 270.0}) EXPECT_DOUBLE_EQ(intensity(quarters, 50, c), 4);
  const scene::Photometry halves = read(ies("1 2 3" + size + "0 180\n0 90 180\n1 1\n2 2\n4 4\n"));
  EXPECT_DOUBLE_EQ(intensity(halves, 50, 270), 2);
  EXPECT_DOUBLE_EQ(intensity(halves, 50, 225), 3);
  const scene::Photometry across = read(ies("1 2 3" + size + "0 180\n90 180 270\n1 1\n2 2\n4 4\n"));
  EXPECT_DOUBLE_EQ(intensity(across, 50, 0), 2);
  EXPECT_DOUBLE_EQ(intensity(across, 50, 45), 1.5);
  EXPECT_DOUBLE_EQ(intensity(across, 50, 315), 3);
  for (const char* const last : {"", " 360"}) { // with and without the first plane again
    const std::string more = *last == 0 ? "" : "1 1\n";
    const scene::Photometry all = read(ies(fmt::format("1 2 {}", *last == 0 ? 4 : 5) + size + "0 180\n0 90 180 270" +
                                           last + "\n1 1\n2 2\n4 4\n8 8\n" + more));
    EXPECT_DOUBLE_EQ(intensity(all, 50, 225), 6);
    EXPECT_DOUBLE_EQ(intensity(all, 50, 315), 4.5);
  }
}

TEST_F(Photometry, TiltChangesNoDirection) {
  EXPECT_DOUBLE_EQ(
      intensity(read(ies("1 2 1" + size + "0 90\n0\n8 4\n", "TILT=INCLUDE\n1\n3\n0 45 90\n1 .9 .8\n")), 45, 0), 6);
  EXPECT_DOUBLE_EQ(intensity(read(ies("1 2 1" + size + "0 90\n0\n8 4\n", "TILT=other.tlt\n")), 45, 0), 6);
}

TEST_F(Photometry, RefusesWhatItCannotRead) {
  const std::string good = "1 2 2" + size + "0 90\n0 90\n1 1\n1 1\n";
  EXPECT_NO_THROW(read(ies(good)));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "0 90\n0 90\n1 1\n1\n")), HasSubstr("the file ends before an intensity"));
  EXPECT_THAT(refusal(ies("1 2 1" + size + "0 90\n0\n1 1\n7\n")), HasSubstr("more numbers follow"));
  EXPECT_THAT(refusal(ies("1 2 2" + size)), HasSubstr("the file ends before a vertical angle"));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "0 90\n0 90\n1 -1\n1 1\n")), HasSubstr("has an intensity of -1"));
  EXPECT_THAT(refusal(ies("1e200 2 2" + size + "0 90\n0 90\n1 1e200\n1 1\n")), HasSubstr("has an intensity of 1e+200"));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "0 90\n0 90\n1 nan\n1 1\n")),
              HasSubstr("lamp.ies:8: 'nan' is an intensity"));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "0 90\n0 90\n1 x\n1 1\n")),
              HasSubstr("'x' is an intensity; expected a number"));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "0 90\n0 90\n0 0\n0 0\n")), HasSubstr("has no light in any direction"));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "90 0\n0 90\n1 1\n1 1\n")), HasSubstr("0 degrees after 90"));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "0 0\n0 90\n1 1\n1 1\n")), HasSubstr("expected angles that rise"));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "0 190\n0 90\n1 1\n1 1\n")), HasSubstr("is 190 degrees; expected 0 to 180"));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "0 90\n0 100\n1 1\n1 1\n")), HasSubstr("expected 0, 90, 180 or 360"));
  EXPECT_THAT(refusal(ies("1 2 2" + size + "0 90\n10 90\n1 1\n1 1\n")), HasSubstr("the first horizontal angle is 10"));
  EXPECT_THAT(refusal(ies("1 2 2 2 2 0 0 0\n1 1 10\n0 90\n0 90\n1 1\n1 1\n")), HasSubstr("type B; expected type C"));
  EXPECT_THAT(refusal(ies("1 2.5 2" + size)), HasSubstr("the number of vertical angles is 2.5"));
  EXPECT_THAT(refusal(ies("1 1e9 2" + size)), HasSubstr("expected a whole number from 1 to 10000"));
  EXPECT_THAT(refusal("P6 3 3 255 ..."), HasSubstr("is no photometric file"));
  EXPECT_THAT(refusal(""), HasSubstr("is no photometric file"));
  EXPECT_THAT(refusal(std::string("\0\xff\x12\n\n", 5)), HasSubstr("is no photometric file"));
  EXPECT_THAT(refusal_of([&] { scene::load_photometry(folder_.path() / "none.ies"); }), HasSubstr("none.ies"));
  const fs::path large = folder_.write("large.ies", ies(good));
  fs::resize_file(large, 100 << 20);
  EXPECT_THAT(refusal_of([&] { scene::load_photometry(large); }), HasSubstr("has 100 MiB"));
}

/// Planes at 0, 90, 180 and 270 degrees, intensities at 0 and 180. planes: those that the file has.
std::string eulumdat(int symmetry, const std::vector<double>& planes) {
  std::string text = fmt::format("maker\n1\n{}\n4\n90\n2\n180\nreport\nname\n1\nfile\ndate\n", symmetry);
  for (int i = 13; i <= 25; ++i) text += "1,5\n";
  text += "1\n1\nlamp\n1000\nwhite\n80\n10\n"; // one set
  for (int i = 0; i < 10; ++i) text += "0\n";
  text += "0\n90\n180\n270\n0\n180\n";
  for (const double value : planes) text += fmt::format("{0}\n{0}\n", value);
  return text;
}

TEST_F(Photometry, ReadsEulumdat) {
  const auto at = [&](int symmetry, const std::vector<double>& planes) {
    const scene::Photometry p = read(eulumdat(symmetry, planes), "lamp.ldt");
    std::vector<double> values;
    for (const double c : {0.0, 90.0, 180.0, 270.0, 315.0}) values.push_back(intensity(p, 77, c));
    return values;
  };
  using testing::ElementsAre;
  EXPECT_THAT(at(0, {1, 2, 3, 5}), ElementsAre(1, 2, 3, 5, 3));
  EXPECT_THAT(at(1, {7}), ElementsAre(7, 7, 7, 7, 7));
  EXPECT_THAT(at(2, {1, 2, 4}), ElementsAre(1, 2, 4, 2, 1.5));
  EXPECT_THAT(at(3, {1, 2, 4}), ElementsAre(2, 4, 2, 1, 1.5)); // from 270 by 0 to 90 degrees
  EXPECT_THAT(at(4, {1, 3}), ElementsAre(1, 3, 1, 3, 2));
}

// A plane just beyond 180 degrees, mirrored, is next to nothing below 0, which is 360 where it is rounded.
TEST_F(Photometry, PlanesThatMeetAtZeroAreOne) {
  std::string text = eulumdat(3, {2, 4, 6});
  const std::string angles = "0\n90\n180\n270\n";
  text.replace(text.find(angles), angles.size(), "0\n180.00000000000003\n200\n300\n");
  const scene::Photometry p = read(text, "lamp.ldt");
  EXPECT_EQ(std::ranges::adjacent_find(p.c_deg, std::greater_equal()), p.c_deg.end());
  for (const double c : {0.0, 360.0}) EXPECT_DOUBLE_EQ(intensity(p, 50, c), 4);
}

TEST_F(Photometry, RefusesEulumdatThatIsWrong) {
  const auto refused = [&](const std::string& text) { return refusal(text, "lamp.ldt"); };
  EXPECT_THAT(refused(eulumdat(0, {1, 2, 3})), HasSubstr("has 54 lines; expected 55 or more"));
  EXPECT_THAT(refused(eulumdat(5, {1, 2, 3, 4})),
              HasSubstr("lamp.ldt:3: the symmetry is 5; expected a whole number from 0 to 4"));
  EXPECT_THAT(refused(eulumdat(0, {1, 2, -3, 4})), HasSubstr("has an intensity of -3"));
  EXPECT_THAT(refused(eulumdat(0, {0, 0, 0, 0})), HasSubstr("has no light"));
  EXPECT_THAT(refused(eulumdat(0, {1, 2, 3, std::nan("")})), HasSubstr("is an intensity; expected a number"));
}

} // namespace nephroid::photometry_test
