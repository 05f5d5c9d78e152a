// SPDX-License-Identifier: Apache-2.0
// Pictures survive writing and reading bit for bit, the same picture gives the same bytes, and failures leave nothing
// behind. Files as comparisons take them: what is decoded and what is linear already, which channels, which way up; and
// masks.
#include "image/image.h"
#include "measure/read_picture.h"
#include "tests/support/test.h"

#include <sys/mount.h>

namespace nephroid::image_test {

using namespace nephroid::image;
using namespace nephroid::measure;

class Pictures : public testing::Test {
protected:
  nephroid::test::TemporaryFolder temporary;
  fs::path folder = temporary.path();
};

Image example(int width = 33, int height = 17) {
  Image image{width,
              height,
              {"R", "G", "B", "caustic.R", "caustic.G", "caustic.B"},
              {},
              {{"nephroid:seed", "7"}, {"nephroid:preset", "{\n \"a\": 1}"}}};
  for (int i = 0; i < width * height * 6; ++i) image.data.push_back(std::sin(float(i)) * 1e4f);
  image.data[0] = std::numeric_limits<float>::quiet_NaN();
  image.data[1] = std::numeric_limits<float>::infinity();
  image.data[2] = -1e-42f; // a denormal
  return image;
}

TEST_F(Pictures, ExrKeepsEveryBitChannelAndAttribute) {
  const Image image = example();
  write_exr(folder / "a.exr", image);
  const Image back = read_image(folder / "a.exr");
  EXPECT_EQ(back.width, image.width);
  EXPECT_EQ(back.height, image.height);
  ASSERT_EQ(back.channels, image.channels);
  ASSERT_EQ(back.data.size(), image.data.size());
  EXPECT_EQ(std::memcmp(back.data.data(), image.data.data(), image.data.size() * sizeof(float)), 0);
  for (const auto& [name, value] : image.attributes) EXPECT_EQ(back.attributes.at(name), value);
}

TEST_F(Pictures, TheSamePictureGivesTheSameBytesASecondLater) {
  write_exr(folder / "a.exr", example());
  write_png(folder / "a.png", 2, 1, {0, .5f, 1, 2, 3, 4});
  std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // a date has seconds
  write_exr(folder / "b.exr", example());
  write_png(folder / "b.png", 2, 1, {0, .5f, 1, 2, 3, 4});
  EXPECT_TRUE(read_file(folder / "a.exr") == read_file(folder / "b.exr"));
  EXPECT_TRUE(read_file(folder / "a.png") == read_file(folder / "b.png"));
}

TEST_F(Pictures, PngIsWhatADisplayShows) {
  // Known pairs of the sRGB standard: 0.21586 is code 128, 0.0031308 the end of the straight part.
  write_png(folder / "a.png", 2, 1, {0.21586f, 0.0031308f, -5, 1, 1e9f, 0.5f});
  const Image back = read_image(folder / "a.png"); // 8-bit codes as 0..1
  const int expected[] = {128, 10, 0, 255, 255, 188};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(std::lround(back.data[std::size_t(i)] * 255), expected[i]) << i;
  write_png(folder / "b.png", 1, 1, {0.10793f, 0.4281f, 0.25f}, {.scale = 2});
  EXPECT_EQ(std::lround(read_image(folder / "b.png").data[0] * 255), 128);
}

TEST(Shown, EqualsTheRoundedEncodingEverywhere) {
  for (int i = 0; i <= 100'000; ++i) {
    const double linear = i / 100'000.0;
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    const double code = encoded * 255;
    if (std::abs(code - std::floor(code) - 0.5) < 1e-4) continue; // a tie within single precision
    ASSERT_EQ(shown(float(linear)), std::lround(code)) << linear;
  }
}

TEST_F(Pictures, ScreenshotsKeepTheirBytes) {
  write_png_bytes(folder / "a.png", 1, 2, {1, 2, 3, 255, 250, 128, 0, 255});
  const Image back = read_image(folder / "a.png");
  EXPECT_EQ(back.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(std::lround(back.data[4] * 255), 250);
  EXPECT_EQ(std::lround(back.data[5] * 255), 128);
}

TEST_F(Pictures, BadPicturesAreBadInputWithTheirName) {
  write_file_whole(folder / "text.exr", "not a picture");
  const Error text = error_of([&] { read_image(folder / "text.exr"); });
  EXPECT_EQ(text.exit_code(), 2);
  EXPECT_THAT(text.line(), HasSubstr("text.exr: is no picture that can be read"));
  EXPECT_THAT(error_of([&] { read_image(folder / "none.png"); }).line(), HasSubstr("No such file"));
  EXPECT_THAT(error_of([&] { read_image(folder); }).line(), HasSubstr("it is a folder"));
  write_exr(folder / "a.exr", example(300, 300));
  const std::string bytes = read_file(folder / "a.exr");
  write_file_whole(folder / "cut.exr", bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(error_of([&] { read_image(folder / "cut.exr"); }).exit_code(), 2);
}

TEST_F(Pictures, SizesThatDoNotFitAreRefused) {
  EXPECT_THAT(error_of([&] {
                write_png(folder / "a.png", 2, 2, {0, 0, 0});
              }).line(),
              HasSubstr("2 x 2 with 3 channels has 3 values"));
  EXPECT_THAT(error_of([&] { write_exr(folder / "a.exr", Image{}); }).line(), HasSubstr("0 x 0"));
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Pictures, AFolderThatIsNotThereIsSaid) {
  EXPECT_THAT(error_of([&] { write_exr(folder / "no/a.exr", example()); }).line(),
              HasSubstr("a.exr: cannot be written: No such file"));
}

TEST_F(Pictures, AFullDiskKeepsTheOldPictureAndNoOther) {
  if (::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=128k") != 0)
    GTEST_SKIP() << "mounting a small disk needs root";
  write_exr(folder / "a.exr", example());
  const std::string before = read_file(folder / "a.exr");
  EXPECT_THAT(error_of([&] { write_exr(folder / "a.exr", example(200, 200)); }).line(), HasSubstr("No space left"));
  EXPECT_TRUE(read_file(folder / "a.exr") == before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  ::umount(folder.c_str());
}

class ReadPicture : public testing::Test {
protected:
  test::TemporaryFolder temporary;
  fs::path write(const std::string& name, const std::string& bytes) const {
    write_file_whole(temporary.path() / name, bytes);
    return temporary.path() / name;
  }
  fs::path write_exr(const std::string& name, std::vector<std::string> channels, std::vector<float> data,
                     int width = 1) const {
    const int height = static_cast<int>(data.size() / channels.size()) / width;
    image::write_exr(temporary.path() / name, {width, height, std::move(channels), std::move(data), {}});
    return temporary.path() / name;
  }
};

TEST_F(ReadPicture, IntegersAreDecoded) {
  image::write_png_bytes(temporary.path() / "a.png", 2, 1, {0, 128, 255, 255, 10, 188, 1, 0});
  const LinearPicture picture = read_linear_rgb(temporary.path() / "a.png");
  EXPECT_EQ(picture.width, 2);
  EXPECT_EQ(picture.height, 1);
  EXPECT_FALSE(picture.grey);
  // sRGB: code 128 is .21586, 10 the end of the straight part, 188 .50289; the second pixel's alpha of 0 changes
  // nothing.
  EXPECT_THAT(picture.rgb, ElementsAre(0, FloatNear(0.21586f, 1e-5f), 1, FloatNear(10 / 255.0f / 12.92f, 1e-7f),
                                       FloatNear(0.50289f, 1e-5f), FloatNear(1 / 255.0f / 12.92f, 1e-7f)));
}

TEST_F(ReadPicture, SixteenBitsAreDecodedAsFinely) {
  const LinearPicture picture =
      read_linear_rgb(write("a.ppm", std::string("P6\n1 1\n65535\n\x80\x00\x00\x01\xff\xff", 19)));
  // White comes back a code of 65535 lower from OpenImageIO's PNM.
  const auto wanted = static_cast<float>(image::decoded_srgb(32768 / 65535.0));
  EXPECT_THAT(picture.rgb,
              ElementsAre(FloatNear(wanted, 1e-6f), FloatNear(1 / 65535.0f / 12.92f, 1e-9f), FloatNear(1, 4e-5f)));
}

TEST_F(ReadPicture, FloatsAreLinear) {
  const fs::path exr = write_exr("a.exr", {"R", "G", "B"}, {0.5f, -2, 1e9f});
  EXPECT_THAT(read_linear_rgb(exr).rgb, ElementsAre(0.5f, -2, 1e9f));
  // Radiance: mantissas over 256 times 2^(exponent - 128).
  const fs::path hdr =
      write("a.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x82", 50));
  EXPECT_THAT(read_linear_rgb(hdr).rgb, ElementsAre(FloatNear(2, 0.02f), FloatNear(1, 0.02f), FloatNear(0.5f, 0.02f)));
}

// PFM stores its rows from the bottom.
TEST_F(ReadPicture, RowZeroIsTheTopOfAPfm) {
  const float rows[] = {1, 2, 3, 4, 5, 6}; // the lower pixel first
  std::string bytes = "PF\n1 2\n-1.0\n";
  bytes.append(reinterpret_cast<const char*>(rows), sizeof rows);
  EXPECT_THAT(read_linear_rgb(write("a.pfm", bytes)).rgb, ElementsAre(4, 5, 6, 1, 2, 3));
}

TEST_F(ReadPicture, ChannelsAreTakenByName) {
  const fs::path layers = write_exr("a.exr", {"B", "caustic.R", "G", "R", "A"}, {3, 9, 2, 1, 0});
  EXPECT_THAT(read_linear_rgb(layers).rgb, ElementsAre(1, 2, 3));
  const LinearPicture grey = read_linear_rgb(write_exr("y.exr", {"Y"}, {0.25f}));
  EXPECT_TRUE(grey.grey);
  EXPECT_THAT(grey.rgb, ElementsAre(0.25f, 0.25f, 0.25f));
  const LinearPicture encoded = read_linear_rgb(write("a.pgm", "P2\n1 1\n255\n128\n"));
  EXPECT_TRUE(encoded.grey);
  EXPECT_NEAR(encoded.rgb.at(2), 0.21586, 1e-5);
}

TEST_F(ReadPicture, OtherChannelsAreRefusedByName) {
  EXPECT_THAT(refusal_of([&] {
                read_linear_rgb(write_exr("a.exr", {"caustic.R", "caustic.G", "caustic.B"}, {1, 2, 3}));
              }),
              HasSubstr("a.exr: has the channels caustic.R, caustic.G, caustic.B; expected R, G, B or Y alone"));
  EXPECT_THAT(refusal_of([&] {
                read_linear_rgb(write_exr("b.exr", {"R", "G"}, {1, 2}));
              }),
              HasSubstr("has the channels R, G;"));
  EXPECT_THAT(refusal_of([&] {
                read_linear_rgb(write_exr("c.exr", {"Y", "Z"}, {1, 2}));
              }),
              HasSubstr("has the channels Y, Z;"));
  EXPECT_THAT(refusal_of([&] { read_linear_rgb(write("d.png", "no picture")); }),
              HasSubstr("d.png: is no picture that can be read"));
}

TEST_F(ReadPicture, AMaskCountsWhatIsNotBlack) {
  image::write_png_bytes(temporary.path() / "m.png", 4, 1, {0, 0, 0, 255, 1, 0, 0, 255, 0, 0, 9, 0, 0, 0, 0, 255});
  EXPECT_THAT(read_mask(temporary.path() / "m.png", 4, 1), ElementsAre(0, 1, 1, 0));
  EXPECT_THAT(read_mask(write_exr("m.exr", {"Y"}, {0, 1e-9f, -1}, 3), 3, 1), ElementsAre(0, 1, 1));
}

TEST_F(ReadPicture, MasksThatDoNotFitAreRefused) {
  const fs::path mask = write_exr("m.exr", {"Y"}, {0, 0, 0, 0}, 2);
  EXPECT_THAT(refusal_of([&] { read_mask(mask, 3, 2); }),
              HasSubstr("m.exr: is 2 x 2 pixels; expected 3 x 2, the size of the pictures"));
  EXPECT_THAT(refusal_of([&] { read_mask(mask, 2, 2); }), HasSubstr("m.exr: is all black: no pixel counts"));
  const fs::path bad = write_exr("n.exr", {"Y"}, {1, std::numeric_limits<float>::quiet_NaN()}, 2);
  EXPECT_THAT(refusal_of([&] { read_mask(bad, 2, 1); }), HasSubstr("n.exr: pixel (1, 0) has NaN"));
}

TEST_F(ReadPicture, LayersComeWithThePicture) {
  std::vector<job::Layer> layers;
  const fs::path file =
      write_exr("a.exr", {"R", "G", "B", "caustic.R", "caustic.G", "caustic.B", "depth.R"}, {1, 2, 3, 4, 5, 6, 7});
  const LinearPicture picture = read_linear_rgb(file, layers);
  EXPECT_THAT(picture.rgb, ElementsAre(1, 2, 3));
  ASSERT_EQ(layers.size(), 1u) << "a layer has three channels";
  EXPECT_EQ(layers[0].name, "caustic");
  EXPECT_THAT(layers[0].rgb, ElementsAre(4, 5, 6));
  read_linear_rgb(write_exr("b.exr", {"R", "G", "B"}, {1, 2, 3}), layers);
  EXPECT_TRUE(layers.empty());
}

} // namespace nephroid::image_test
