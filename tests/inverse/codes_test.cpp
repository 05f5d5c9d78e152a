// SPDX-License-Identifier: Apache-2.0
// The QR codes of the shipped set, read by zbar from the judged pictures, each at its own distance.
#include "image/image.h"
#include "tests/support/program_test.h"
#include "tests/support/x_display.h"

namespace nephroid::codes_test {

class Codes : public ProgramTest {
protected:
  /// What zbar reads in a picture of the run, without its end of line; empty where it reads nothing.
  std::string read(const std::string& picture) const
  {
    Child child({"--quiet", "--raw", "--nodbus", picture}, folder / "out", logs, {}, "zbarimg");
    std::string text = child.wait().out;
    while (text.ends_with('\n')) text.pop_back();
    return text;
  }
};

/// How much lighter the cells of a picture are where another one is light than where it is dark; mirrored: the other one's columns.
double contrast(const nephroid::image::Image& picture, const nephroid::image::Image& wanted, bool mirrored)
{
  double light = 0, dark = 0;
  int lit = 0;
  const auto value = [](const nephroid::image::Image& of, int x, int y) {
    return of.data[of.channels.size() * static_cast<std::size_t>(y * of.width + x)];
  };
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const bool here = value(wanted, mirrored ? picture.width - 1 - x : x, y) > 0.5f;
      (here ? light : dark) += value(picture, x, y);
      lit += here;
    }
  return light / lit - dark / (picture.width * picture.height - lit);
}

// Each at its own distance only. zbar reads mirrored codes too, so that the pictures' orientation is seen to apart.
TEST_F(Codes, AreReadAtTheirOwnDistance)
{
  const Ended ended = run({"run", "inverse/qr", "-o", "out"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const std::string j : {"1", "2"}) {
    const auto picture = nephroid::image::read_image(folder / ("out/receiver_" + j + ".exr"));
    const auto wanted = nephroid::image::read_image(folder / ("out/target_" + j + ".exr"));
    EXPECT_GT(contrast(picture, wanted, false), 0.5);
    EXPECT_LT(contrast(picture, wanted, true), 0.8 * contrast(picture, wanted, false));
  }
  if (!there_is("zbarimg")) GTEST_SKIP() << "needs zbarimg, of the package zbar-tools";
  for (const char* picture : {"target_1.png", "receiver_1.png"}) EXPECT_EQ(read(picture), "NEPHROID") << picture;
  for (const char* picture : {"target_2.png", "receiver_2.png"}) EXPECT_EQ(read(picture), "CAUSTICS") << picture;
}

} // namespace nephroid::codes_test
