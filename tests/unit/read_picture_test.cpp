// SPDX-License-Identifier: Apache-2.0
// Files as comparisons take them: what is decoded and what is linear already, which channels, which way up; and masks.
#include "image/image.h"
#include "measure/read_picture.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

namespace nephroid::read_picture_test {

using namespace nephroid::measure;

class ReadPicture : public testing::Test {
protected:
  test::TemporaryFolder temporary;
  fs::path write(const std::string& name, const std::string& bytes) const
  {
    write_file_whole(temporary.path() / name, bytes);
    return temporary.path() / name;
  }
  fs::path write_exr(const std::string& name, std::vector<std::string> channels, std::vector<float> data, int width = 1) const
  {
    const int height = static_cast<int>(data.size() / channels.size()) / width;
    image::write_exr(temporary.path() / name, {width, height, std::move(channels), std::move(data), {}});
    return temporary.path() / name;
  }
};

TEST_F(ReadPicture, IntegersAreDecoded)
{
  image::write_png_bytes(temporary.path() / "a.png", 2, 1, {0, 128, 255, 255, 10, 188, 1, 0});
  const LinearPicture picture = read_linear_rgb(temporary.path() / "a.png");
  EXPECT_EQ(picture.width, 2);
  EXPECT_EQ(picture.height, 1);
  EXPECT_FALSE(picture.grey);
  // sRGB: code 128 is .21586, 10 the end of the straight part, 188 .50289; the second pixel's alpha of 0 changes nothing.
  EXPECT_THAT(picture.rgb, ElementsAre(0, FloatNear(0.21586f, 1e-5f), 1, FloatNear(10 / 255.0f / 12.92f, 1e-7f), FloatNear(0.50289f, 1e-5f),
                                       FloatNear(1 / 255.0f / 12.92f, 1e-7f)));
}

TEST_F(ReadPicture, SixteenBitsAreDecodedAsFinely)
{
  const LinearPicture picture = read_linear_rgb(write("a.ppm", std::string("P6\n1 1\n65535\n\x80\x00\x00\x01\xff\xff", 19)));
  // White comes back a code of 65535 lower from OpenImageIO's PNM.
  const auto wanted = static_cast<float>(image::decoded_srgb(32768 / 65535.0));
  EXPECT_THAT(picture.rgb, ElementsAre(FloatNear(wanted, 1e-6f), FloatNear(1 / 65535.0f / 12.92f, 1e-9f), FloatNear(1, 4e-5f)));
}

TEST_F(ReadPicture, FloatsAreLinear)
{
  const fs::path exr = write_exr("a.exr", {"R", "G", "B"}, {0.5f, -2, 1e9f});
  EXPECT_THAT(read_linear_rgb(exr).rgb, ElementsAre(0.5f, -2, 1e9f));
  // Radiance: mantissas over 256 times 2^(exponent - 128).
  const fs::path hdr = write("a.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x82", 50));
  EXPECT_THAT(read_linear_rgb(hdr).rgb, ElementsAre(FloatNear(2, 0.02f), FloatNear(1, 0.02f), FloatNear(0.5f, 0.02f)));
}

// PFM stores its rows from the bottom.
TEST_F(ReadPicture, RowZeroIsTheTopOfAPfm)
{
  const float rows[] = {1, 2, 3, 4, 5, 6}; // the lower pixel first
  std::string bytes = "PF\n1 2\n-1.0\n";
  bytes.append(reinterpret_cast<const char*>(rows), sizeof rows);
  EXPECT_THAT(read_linear_rgb(write("a.pfm", bytes)).rgb, ElementsAre(4, 5, 6, 1, 2, 3));
}

TEST_F(ReadPicture, ChannelsAreTakenByName)
{
  const fs::path layers = write_exr("a.exr", {"B", "caustic.R", "G", "R", "A"}, {3, 9, 2, 1, 0});
  EXPECT_THAT(read_linear_rgb(layers).rgb, ElementsAre(1, 2, 3));
  const LinearPicture grey = read_linear_rgb(write_exr("y.exr", {"Y"}, {0.25f}));
  EXPECT_TRUE(grey.grey);
  EXPECT_THAT(grey.rgb, ElementsAre(0.25f, 0.25f, 0.25f));
  const LinearPicture encoded = read_linear_rgb(write("a.pgm", "P2\n1 1\n255\n128\n"));
  EXPECT_TRUE(encoded.grey);
  EXPECT_NEAR(encoded.rgb.at(2), 0.21586, 1e-5);
}

TEST_F(ReadPicture, OtherChannelsAreRefusedByName)
{
  EXPECT_THAT(refusal_of([&] {
                read_linear_rgb(write_exr("a.exr", {"caustic.R", "caustic.G", "caustic.B"}, {1, 2, 3}));
              }),
              HasSubstr("a.exr: has the channels caustic.R, caustic.G, caustic.B; expected R, G, B or Y alone"));
  EXPECT_THAT(refusal_of([&] { read_linear_rgb(write_exr("b.exr", {"R", "G"}, {1, 2})); }), HasSubstr("has the channels R, G;"));
  EXPECT_THAT(refusal_of([&] { read_linear_rgb(write_exr("c.exr", {"Y", "Z"}, {1, 2})); }), HasSubstr("has the channels Y, Z;"));
  EXPECT_THAT(refusal_of([&] { read_linear_rgb(write("d.png", "no picture")); }), HasSubstr("d.png: is no picture that can be read"));
}

TEST_F(ReadPicture, AMaskCountsWhatIsNotBlack)
{
  image::write_png_bytes(temporary.path() / "m.png", 4, 1, {0, 0, 0, 255, 1, 0, 0, 255, 0, 0, 9, 0, 0, 0, 0, 255});
  EXPECT_THAT(read_mask(temporary.path() / "m.png", 4, 1), ElementsAre(0, 1, 1, 0));
  EXPECT_THAT(read_mask(write_exr("m.exr", {"Y"}, {0, 1e-9f, -1}, 3), 3, 1), ElementsAre(0, 1, 1));
}

TEST_F(ReadPicture, MasksThatDoNotFitAreRefused)
{
  const fs::path mask = write_exr("m.exr", {"Y"}, {0, 0, 0, 0}, 2);
  EXPECT_THAT(refusal_of([&] { read_mask(mask, 3, 2); }), HasSubstr("m.exr: is 2 x 2 pixels; expected 3 x 2, the size of the pictures"));
  EXPECT_THAT(refusal_of([&] { read_mask(mask, 2, 2); }), HasSubstr("m.exr: is all black: no pixel counts"));
  const fs::path bad = write_exr("n.exr", {"Y"}, {1, std::numeric_limits<float>::quiet_NaN()}, 2);
  EXPECT_THAT(refusal_of([&] { read_mask(bad, 2, 1); }), HasSubstr("n.exr: pixel (1, 0) has NaN"));
}

TEST_F(ReadPicture, LayersComeWithThePicture)
{
  std::vector<job::Layer> layers;
  const fs::path file = write_exr("a.exr", {"R", "G", "B", "caustic.R", "caustic.G", "caustic.B", "depth.R"}, {1, 2, 3, 4, 5, 6, 7});
  const LinearPicture picture = read_linear_rgb(file, layers);
  EXPECT_THAT(picture.rgb, ElementsAre(1, 2, 3));
  ASSERT_EQ(layers.size(), 1u) << "a layer has three channels";
  EXPECT_EQ(layers[0].name, "caustic");
  EXPECT_THAT(layers[0].rgb, ElementsAre(4, 5, 6));
  read_linear_rgb(write_exr("b.exr", {"R", "G", "B"}, {1, 2, 3}), layers);
  EXPECT_TRUE(layers.empty());
}

} // namespace nephroid::read_picture_test
