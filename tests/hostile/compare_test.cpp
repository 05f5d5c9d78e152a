// SPDX-License-Identifier: Apache-2.0
// `nephroid compare` as scripts use it: JSON as the contract has it, masks, difference pictures, and one line for
// whatever is wrong.
#include "image/image.h"
#include "tests/support/pictures.h"
#include "tests/support/program_test.h"

namespace nephroid::compare_test {

using json = nlohmann::ordered_json;

class Compare : public ProgramTest {
protected:
  Ended run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "compare");
    return ProgramTest::run(arguments);
  }
  json compared(std::vector<std::string> arguments) const {
    arguments.emplace_back("--json");
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 1);
    return json::parse(ended.out);
  }
  void write(const std::string& name, const Picture& picture) const {
    image::write_exr(folder / name, {picture.width, picture.height, {"R", "G", "B"}, picture.rgb, {}});
  }
  void write_grey(const std::string& name, int width, std::vector<float> values) const {
    const int height = static_cast<int>(values.size()) / width;
    image::write_exr(folder / name, {width, height, {"Y"}, std::move(values), {}});
  }
};

std::vector<std::string> keys(const json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

const std::vector<std::string> contract{"lab_mean", "lab_rms", "lab_max", "mse",      "rel_mse", "rel_l2",
                                        "psnr_db",  "iw_ssim", "flip",    "hdr_flip", "pixels"};

TEST_F(Compare, JsonIsTheContracts) {
  const Picture b = textured(170, 161);
  write("b.exr", b);
  write("a.exr", with_noise(b, 0.2));
  const json object = compared({"a.exr", "b.exr"});
  EXPECT_EQ(keys(object), contract);
  EXPECT_EQ(object["pixels"], 170 * 161);
  const auto metrics = measure::named(measure::compare(with_noise(b, 0.2).pixels(), b.pixels()));
  for (const auto& [name, value] : metrics) EXPECT_EQ(object[name].get<double>(), value) << name;
}

TEST_F(Compare, WhatIsNotDefinedIsNull) {
  write("white.exr", flat(20, 20, 1));
  write("black.exr", flat(20, 20, 0));
  const json same = compared({"white.exr", "white.exr"});
  EXPECT_EQ(keys(same), contract);
  EXPECT_TRUE(same["psnr_db"].is_null() && same["iw_ssim"].is_null());
  EXPECT_EQ(same["mse"], 0);
  const json on_black = compared({"white.exr", "black.exr"});
  EXPECT_TRUE(on_black["rel_l2"].is_null());
  EXPECT_NEAR(on_black["lab_mean"].get<double>(), 100, 1e-3);
  EXPECT_THAT(run({"white.exr", "black.exr"}).out, HasSubstr("rel_l2              -"));
}

TEST_F(Compare, AMaskAddsItsPixels) {
  const Picture b = flat(20, 10, 0.5);
  Picture a = b;
  for (int c = 0; c < 3; ++c) a.at(3, 4, c) = 1;
  write("a.exr", a);
  write("b.exr", b);
  std::vector<float> mask(200, 0);
  mask[4 * 20 + 3] = mask[0] = 1;
  write_grey("m.exr", 20, mask);
  const json object = compared({"a.exr", "b.exr", "--mask", "m.exr"});
  std::vector<std::string> with_mask = contract;
  with_mask.emplace_back("masked");
  EXPECT_EQ(keys(object), with_mask);
  EXPECT_EQ(keys(object["masked"]), contract);
  EXPECT_EQ(object["masked"]["pixels"], 2);
  EXPECT_NEAR(object["mse"].get<double>(), 0.25 / 200, 1e-9);
  EXPECT_NEAR(object["masked"]["mse"].get<double>(), 0.25 / 2, 1e-9);
  EXPECT_THAT(run({"a.exr", "b.exr", "--mask", "m.exr"}).out,
              testing::AllOf(HasSubstr("mask\n"), HasSubstr("200           2")));
}

TEST_F(Compare, ALayerIsComparedAlone) {
  const auto write_layers = [&](const char* name, float caustic) {
    image::write_exr(
        folder / name,
        {1, 1, {"R", "G", "B", "caustic.R", "caustic.G", "caustic.B"}, {9, 9, 9, caustic, 0.5f, 0.5f}, {}});
  };
  write_layers("a.exr", 0.75f);
  write_layers("b.exr", 0.5f);
  EXPECT_NEAR(compared({"a.exr", "b.exr", "--layer", "caustic"})["mse"].get<double>(), 0.0625 / 3, 1e-9);
  EXPECT_EQ(compared({"a.exr", "b.exr"})["mse"], 0);
}

// The PNG holds codes of 8 bits: half a code is .0025 of linear grey at most there.
TEST_F(Compare, IntegersAndFloatsAreOnOneScale) {
  const Picture picture = textured(40, 30);
  write("a.exr", picture);
  image::write_png(folder / "a.png", 40, 30, picture.rgb);
  const json object = compared({"a.png", "a.exr"});
  EXPECT_LT(object["mse"].get<double>(), 0.0025 * 0.0025);
  EXPECT_GT(object["mse"].get<double>(), 0);
  EXPECT_LT(object["lab_max"].get<double>(), 1);
}

TEST_F(Compare, TextNamesEveryMetric) {
  write("a.exr", flat(20, 20, 0.5));
  const Ended ended = run({"a.exr", "a.exr"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err, "");
  for (const std::string& name : contract) EXPECT_THAT(ended.out, HasSubstr(name + " "));
  EXPECT_THAT(ended.out, HasSubstr("psnr_db             -"));
}

TEST_F(Compare, DifferencePicturesAreWritten) {
  const Picture b = textured(60, 50);
  write("b.exr", b);
  write("a.exr", with_noise(b, 0.2));
  for (const char* metric : {"lab", "absolute", "relative", "square", "luminance", "flip"}) {
    const Ended ended = run({"a.exr", "b.exr", "-o", "d.png", "--metric", metric, "--scale", "0.25"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.err, std::string("nephroid: d.png: ") + metric + ", colours end at 0.25\n");
    const image::Image picture = image::read_image(folder / "d.png");
    EXPECT_EQ(picture.height, 50);
    EXPECT_GT(picture.width, 60);
    fs::remove(folder / "d.png");
  }
  EXPECT_EQ(run({"a.exr", "b.exr", "-o", "no/d.png"}).exit_code, 1);
}

TEST_F(Compare, WhatIsWrongIsSaidInOneLine) {
  const Picture good = flat(6, 4, 0.5);
  Picture nan = good, infinite = good;
  nan.at(5, 3, 2) = std::numeric_limits<float>::quiet_NaN();
  infinite.at(0, 1, 0) = -std::numeric_limits<float>::infinity();
  write("good.exr", good);
  write("wide.exr", flat(7, 4, 0.5));
  write("nan.exr", nan);
  write("infinite.exr", infinite);
  write_grey("grey.exr", 6, std::vector<float>(24, 0.5f));
  write_grey("black.exr", 6, std::vector<float>(24, 0));
  write_grey("small.exr", 5, std::vector<float>(20, 1));
  image::write_exr(folder / "depth.exr", {6, 4, {"Z"}, std::vector<float>(24, 1), {}});
  write_file_whole(folder / "text.png", "no picture");
  fs::create_directory(folder / "run");
  image::write_exr(folder / "run/image.exr", {6, 4, {"R", "G", "B"}, good.rgb, {}});
  write_file_whole(folder / "cut.exr", read_file(folder / "good.exr").substr(0, 200));
  image::write_png(folder / "whole.png", 6, 4, good.rgb);
  write_file_whole(folder / "cut.png", read_file(folder / "whole.png").substr(0, 60));
  const Wrong cases[] = {
      {{}, "IMAGE is required"},
      {{"good.exr"}, "REFERENCE is required"},
      {{"good.exr", "none.exr"}, "none.exr: cannot be read: No such file"},
      {{"good.exr", "/"}, "/: is a folder; expected a picture\n"},
      {{"run", "good.exr"}, "run: is a folder; expected a picture; did you mean 'run/image.exr'?"},
      {{"good.exr", "good.exr", "--layer", "caustic"},
       "good.exr: has no layer 'caustic'; expected a picture with layers"},
      {{"text.png", "good.exr"}, "text.png: is no picture that can be read"},
      {{"good.exr", "cut.exr"}, "cut.exr: is no picture that can be read"},
      {{"cut.png", "good.exr"}, "cut.png: is no picture that can be read: its end is missing"},
      {{"wide.exr", "good.exr"}, "wide.exr: is 7 x 4 pixels; expected 6 x 4, the size of good.exr"},
      {{"good.exr", "wide.exr"}, "good.exr: is 6 x 4 pixels; expected 7 x 4, the size of wide.exr"},
      {{"grey.exr", "good.exr"},
       "grey.exr: is grey (channel Y), but good.exr has colours (channels R, G, B); expected pictures with the same"},
      {{"good.exr", "grey.exr"}, "good.exr: has colours (channels R, G, B), but grey.exr is grey (channel Y)"},
      {{"depth.exr", "good.exr"}, "depth.exr: has the channels Z; expected R, G, B or Y alone"},
      {{"nan.exr", "good.exr"}, "nan.exr: pixel (5, 3) has NaN in B; expected finite values everywhere"},
      {{"good.exr", "infinite.exr"}, "infinite.exr: pixel (0, 1) has -infinity in R"},
      {{"good.exr", "good.exr", "--mask", "small.exr"},
       "small.exr: is 5 x 4 pixels; expected 6 x 4, the size of the pictures"},
      {{"good.exr", "good.exr", "--mask", "black.exr"}, "black.exr: is all black: no pixel counts"},
      {{"good.exr", "good.exr", "--mask", "none.png"}, "none.png: cannot be read"},
      {{"good.exr", "good.exr", "-o", "d.exr"}, "-o: a difference picture is a PNG, not 'd.exr'; expected FILE.png"},
      {{"good.exr", "good.exr", "-o", "d.png", "--metric", "ssim"}, "ssim not in"},
      {{"good.exr", "good.exr", "-o", "d.png", "--scale", "0"},
       "--scale: the colours cannot end at 0; expected a number above 0"},
      {{"good.exr", "good.exr", "-o", "d.png", "--scale", "nan"}, "expected a number above 0"},
      {{"good.exr", "good.exr", "--metric", "lab"}, "--metric requires --output"},
      {{"good.exr", "good.exr", "--masks", "m.png"}, "unknown option '--masks'; did you mean '--mask'?"},
  };
  for (const Wrong& wrong : cases) expect_refused(run(wrong.arguments), wrong);
}

} // namespace nephroid::compare_test
