// SPDX-License-Identifier: Apache-2.0
// The white that a picture gets for "auto".
#include "run/exposure.h"
#include "tests/support/test.h"

namespace nephroid::exposure_test {

/// Grey; the first so many pixels of 100 differ.
std::vector<float> grey(float value, float first = 0, std::size_t count = 0) {
  std::vector<float> rgb(300, value);
  std::fill_n(rgb.begin(), 3 * count, first);
  return rgb;
}

TEST(WhiteFor, HalfOfTheLitPictureIsBelowHalf) {
  EXPECT_EQ(run::white_for({10, 10, grey(0.3f)}), 0.6);
  EXPECT_EQ(run::white_for({10, 10, grey(0, 7, 2)}), 14) << "a spot on black";
  EXPECT_EQ(run::white_for({10, 10, grey(0.3f, 30, 3)}), 0.6) << "a small bright one on a floor";
  EXPECT_EQ(run::white_for({10, 10, grey(0.0123456f)}), 0.025) << "two digits";
  EXPECT_EQ(run::white_for({10, 10, grey(3e-15f)}), 1e-12);
  EXPECT_EQ(run::white_for({10, 10, grey(0)}), 1);
  EXPECT_EQ(run::white_for({10, 10, grey(0.3f, std::numeric_limits<float>::quiet_NaN(), 30)}), 0.6);
  EXPECT_EQ(run::white_for({10, 10, grey(0.3f, std::numeric_limits<float>::infinity(), 30)}), 0.6);
}

TEST(WhiteFor, CausticsCountWhereTheyAreTheLight) {
  const auto with = [](float floor) {
    return job::Picture{10, 10, grey(floor + 2), {{"direct", grey(floor)}, {"caustic", grey(2)}}};
  };
  EXPECT_EQ(run::white_for(with(1)), 2);
  EXPECT_EQ(run::white_for(with(0.1f)), 4.2);
  EXPECT_EQ(run::white_for(with(0)), 4);
}

TEST(Exposure, APictureOfWhichMuchIsWhiteOrAllIsBlackSaysSo) {
  preset::Preset preset;
  preset.white = 2;
  const auto note = [&](std::vector<float> rgb) { return run::exposure_note({10, 10, std::move(rgb)}, preset); };
  EXPECT_EQ(note(grey(0.3f, 7, 19)), "");
  EXPECT_EQ(note(grey(0.3f, 7, 20)), "20 % of the picture is above white: --set white=28 shows it");
  EXPECT_EQ(note(grey(5)), "100 % of the picture is above white: --set white=20 shows it");
  EXPECT_EQ(run::exposure_note({10, 10, grey(5)}, preset, "white {}"),
            "100 % of the picture is above white: white 20 shows it");
  EXPECT_EQ(note(grey(1e-5f)), "the picture is too dark to be seen: --set white=4e-05 shows it");
  EXPECT_EQ(note(grey(0.7f, 4, 25)), "") << "another white would hardly change it";
  EXPECT_EQ(note(grey(0)), "the picture is black: no light comes to the camera");
}

} // namespace nephroid::exposure_test
