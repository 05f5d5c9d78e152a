// SPDX-License-Identifier: Apache-2.0
// IES and EULUMDAT files: what they say, in each symmetry, and what is refused.
#include "scene/photometry.h"
#include "tests/support/test.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

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
constexpr double degree = std::numbers::pi / 180;

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

/// A file of the type whose intensity is f(vertical, horizontal), at every 5 degrees of a range.
std::string ies_of(int type, int from_v, int to_v, int from_h, int to_h,
                   const std::function<double(double, double)>& f) {
  std::string v_list, h_list, values;
  for (int v = from_v; v <= to_v; v += 5) v_list += fmt::format("{} ", v);
  for (int h = from_h; h <= to_h; h += 5) {
    h_list += fmt::format("{} ", h);
    for (int v = from_v; v <= to_v; v += 5) values += fmt::format("{} ", f(v * degree, h * degree));
    values += "\n";
  }
  return ies(fmt::format("1 {} {} {} 2 0 0 0\n1 1 10\n{}\n{}\n{}", (to_v - from_v) / 5 + 1, (to_h - from_h) / 5 + 1,
                         type, v_list, h_list, values));
}

// LM-63: in type B vertical and horizontal 0 is down, vertical 90 is C = 0; horizontal angles go clockwise.
TEST_F(Photometry, TypeBIsAboutAHorizontalAxis) {
  const auto cosine = [](double v, double h) { return std::cos(v) * std::cos(h); };
  for (const int from_v : {-90, 0})
    for (const int from_h : {-90, 0}) {
      const scene::Photometry p = read(ies_of(2, from_v, 90, from_h, 90, cosine));
      for (const double gamma : {0.0, 20.0, 50.0, 85.0, 90.0, 120.0})
        for (const double c : {0.0, 40.0, 90.0, 135.0, 200.0, 270.0, 300.0})
          EXPECT_NEAR(intensity(p, gamma, c), std::max(std::cos(gamma * degree), 0.0), 4e-3) << gamma << " " << c;
    }
  const scene::Photometry ahead =
      read(ies_of(2, -90, 90, -90, 90, [](double v, double h) { return 1 + std::sin(v) * std::cos(h); }));
  EXPECT_NEAR(intensity(ahead, 60, 30), 1 + std::sin(60 * degree) * std::cos(30 * degree), 4e-3);
  const scene::Photometry right = read(ies_of(2, -90, 90, -90, 90, [](double, double h) { return 1 + std::sin(h); }));
  EXPECT_NEAR(intensity(right, 60, 270), 1 + std::sin(60 * degree), 4e-3);
  EXPECT_NEAR(intensity(right, 60, 45), 1 - std::sin(60 * degree) * std::sin(45 * degree), 4e-3);
  EXPECT_EQ(intensity(right, 91, 0), 0);
}

// LM-63: in type A vertical -90 is down, vertical and horizontal 0 is gamma = 90, C = 0.
TEST_F(Photometry, TypeAIsAboutTheVertical) {
  for (const int from_v : {-90, 0})
    for (const int from_h : {-90, 0}) {
      const scene::Photometry p =
          read(ies_of(3, from_v, 90, from_h, 90, [](double v, double h) { return std::cos(v) * std::cos(h); }));
      for (const double gamma : {20.0, 60.0, 90.0, 140.0})
        for (const double c : {0.0, 40.0, 120.0, 300.0, 360.0})
          EXPECT_NEAR(intensity(p, gamma, c), std::max(std::sin(gamma * degree) * std::cos(c * degree), 0.0), 4e-3)
              << gamma << " " << c;
    }
  const scene::Photometry right =
      read(ies_of(3, -90, 90, -90, 90, [](double v, double h) { return 2 + std::sin(h) + std::sin(v); }));
  EXPECT_NEAR(intensity(right, 60, 330), 2 + 0.5 - 0.5, 4e-3);
}

TEST_F(Photometry, SpellingsOfAFileAreOne) {
  const std::string numbers = "2 3 1" + size + "0 30, 90\n0\n10.5 5.25\n1\n", plain = ies(numbers);
  const std::string included = "1\n3\n0 45 90\n1 .9 .8\n";
  std::string dos, mac, blanks, wide = "\xff\xfe";
  for (const char c : plain) {
    dos += c == '\n' ? "\r\n" : std::string(1, c);
    mac += c == '\n' ? '\r' : c;
    blanks += c == ' ' ? "\t  " : std::string(1, c);
    wide += {c, '\0'};
  }
  for (const std::string& text :
       {plain, dos, mac, blanks, wide, "\xef\xbb\xbf" + plain, ies(numbers, "Tilt=None\n"),
        ies(numbers, "tilt=none \r\n"), ies(numbers, " TILT = NONE\n"), ies(numbers, "TILT= INCLUDE\n" + included),
        ies(numbers, "tilt=include\n" + included), ies("2,3,1,1,2,0,0,0\n1,1,10\n0,30,90\n0\n10.5,5.25,1\n"),
        ies("2,0 3 1" + size + "0 30,0 90\n0\n10,5, 5,25\n1,0\n")}) {
    const scene::Photometry p = read(text);
    EXPECT_DOUBLE_EQ(intensity(p, 0, 10), 21) << text;
    EXPECT_DOUBLE_EQ(intensity(p, 60, 10), 6.25) << text;
  }
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
  EXPECT_THAT(refusal(ies("1 2 2 4 2 0 0 0\n1 1 10\n0 90\n0 90\n1 1\n1 1\n")),
              HasSubstr("the photometric type is 4; expected a whole number from 1 to 3"));
  EXPECT_THAT(refusal(ies("1 2 2 2 2 0 0 0\n1 1 10\n0 90\n0 100\n1 1\n1 1\n")), HasSubstr("expected -90 to 90"));
  EXPECT_THAT(refusal(ies("1 2 2 3 2 0 0 0\n1 1 10\n10 90\n0 90\n1 1\n1 1\n")),
              HasSubstr("the first vertical angle is 10 degrees; expected 0 or less"));
  EXPECT_THAT(refusal(ies("1 2 1 2 2 0 0 0\n1 1 10\n0 90\n0\n1 1\n")), HasSubstr("there is one horizontal angle"));
  EXPECT_THAT(refusal(ies(good, "TILT=\n")), HasSubstr("lamp.ies:3: TILT= says nothing; expected NONE, INCLUDE"));
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
  std::string spelt = eulumdat(4, {1, 3});
  std::ranges::replace(spelt, '\n', '\r');
  spelt.replace(spelt.find("\r4\r4\r"), 5, "\r 4,0 \r4.0\r");
  EXPECT_EQ(intensity(read(spelt, "lamp.ldt"), 77, 315), 2);
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
