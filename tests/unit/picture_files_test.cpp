// SPDX-License-Identifier: Apache-2.0
// What picture files say of themselves: windows and parts of an EXR, primaries, Radiance's header, alpha, how a camera
// was held, gamma, profiles. Files are written here byte by byte.
#include "image/image.h"
#include "measure/read_picture.h"
#include "optics/colour.h"
#include "scene/environment.h"
#include "tests/support/exr.h"
#include "tests/support/test.h"
#include "tests/support/tiff.h"

namespace nephroid::picture_files_test {

using namespace nephroid::image;
using test::ExrPart;

class PictureFiles : public testing::Test {
protected:
  test::TemporaryFolder folder;
  Image read(const std::string& name, const std::string& bytes) const { return read_image(folder.write(name, bytes)); }
  Image read(const std::vector<ExrPart>& parts) const { return read("p.exr", test::exr(parts)); }
  std::vector<float> light(const std::string& name, const std::string& bytes) const {
    return rgb_of(read(name, bytes), name).values;
  }
};

/// A grey data window, whose pixels are numbered from 1 on.
ExrPart numbered(const test::ExrWindow& data, const test::ExrWindow& display, int tile = 0) {
  ExrPart part{.data = data, .display = display, .channels = {"Y"}, .values = {}, .tile = tile};
  for (int i = 0; i < (data[2] - data[0] + 1) * (data[3] - data[1] + 1); ++i)
    part.values.push_back(static_cast<float>(i + 1));
  return part;
}

TEST_F(PictureFiles, DataLiesInTheDisplayWindow) {
  const Image image = read({numbered({11, 21, 12, 22}, {10, 20, 13, 22})});
  EXPECT_EQ(image.width, 4);
  EXPECT_EQ(image.height, 3);
  EXPECT_THAT(image.data, ElementsAre(0, 0, 0, 0, 0, 1, 2, 0, 0, 3, 4, 0));
}

// Overscan: row y, column x of the 30 x 30 data are number 30 y + x + 1. With tiles rows are read in larger pieces.
TEST_F(PictureFiles, DataBeyondTheDisplayWindowIsLeftOut) {
  for (const int tile : {0, 8}) {
    const Image image = read({numbered({-10, -9, 19, 20}, {0, 0, 2, 1}, tile)});
    EXPECT_EQ(image.width, 3);
    EXPECT_THAT(image.data, ElementsAre(281, 282, 283, 311, 312, 313)) << tile;
  }
  EXPECT_THAT(test::refusal_of([&] {
                read({numbered({5, 0, 6, 0}, {0, 0, 4, 0})});
              }),
              HasSubstr("its data window lies beside its display window"));
}

TEST_F(PictureFiles, ThePartWithColoursIsTaken) {
  ExrPart depth = numbered({0, 0, 0, 0}, {0, 0, 0, 0}), beauty = depth;
  depth.channels = {"Z"};
  depth.name = "depth";
  beauty.name = "beauty";
  beauty.values = {7};
  const Image image = read({depth, beauty});
  EXPECT_THAT(image.data, ElementsAre(7));
  EXPECT_THAT(image.notes, ElementsAre("it has several parts, pages or frames; 'beauty' is taken alone"));
  EXPECT_THAT(read({beauty}).notes, IsEmpty());
  depth.type = "deepscanline";
  depth.channels = {"Y"};
  EXPECT_THAT(test::refusal_of([&] { read({depth}); }),
              HasSubstr("it is a deep picture, with several samples a pixel"));
}

ExrPart coloured(const std::vector<float>& bgr, const std::vector<float>& chromaticities) {
  return {.data = {0, 0, 0, 0},
          .display = {0, 0, 0, 0},
          .channels = {"B", "G", "R"},
          .values = bgr,
          .attributes = {{"chromaticities", chromaticities}}};
}

void expect_xyz(const std::vector<float>& rgb, const optics::Colour& xyz) {
  const optics::Colour found = optics::linear_srgb_to_xyz({double(rgb[0]), double(rgb[1]), double(rgb[2])});
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], xyz[c], 1e-3) << c; // four digits of sRGB's matrix
}

MATCHER_P(AreAbout, values, "") {
  return testing::ExplainMatchResult(Pointwise(FloatNear(2e-3f), values), arg, result_listener);
}

// The columns of the matrix from ACES to linear sRGB that others publish (with Bradford): its white is white. sRGB's
// primaries under another white are that, too, as a map under D50 (hdri of a city) has them.
TEST_F(PictureFiles, ChromaticitiesAreObeyed) {
  const std::vector<float> aces{0.7347f, 0.2653f, 0, 1, 0.0001f, -0.077f, 0.32168f, 0.33767f};
  const auto rgb = [&](const std::vector<float>& bgr, const std::vector<float>& chromaticities) {
    return rgb_of(read({coloured(bgr, chromaticities)}), "p").values;
  };
  EXPECT_THAT(rgb({0, 0, 1}, aces), AreAbout(std::vector{2.52169f, -0.27648f, -0.01538f}));
  EXPECT_THAT(rgb({0, 1, 0}, aces), AreAbout(std::vector{-1.13413f, 1.37272f, -0.15298f}));
  EXPECT_THAT(rgb({1, 0, 0}, aces), AreAbout(std::vector{-0.38756f, -0.09624f, 1.16835f}));
  const std::vector<float> under_d50{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3457f, 0.3585f};
  EXPECT_THAT(rgb({2, 2, 2}, under_d50), AreAbout(std::vector{2.0f, 2.0f, 2.0f}));
  const std::vector<float> xyz{1, 0, 0, 1, 0, 0, 1 / 3.0f, 1 / 3.0f};
  expect_xyz(rgb({0.3f, 0.4f, 0.5f}, xyz), {0.5, 0.4, 0.3});
  const std::vector<float> rec_709{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
  EXPECT_THAT(rgb({3, 2, 1}, rec_709), ElementsAre(1, 2, 3));
  for (const std::vector<float>& none : {std::vector<float>(8),
                                         {0.6f, 0.3f, 0.6f, 0.3f, 0.2f, 0.1f, 0.3f, 0.3f},
                                         {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3f, 0}})
    EXPECT_THAT(test::refusal_of([&] { rgb({3, 2, 1}, none); }), HasSubstr("p: has the chromaticities"));
}

// Green of ACES lies outside of sRGB: as an environment it is mixed with grey, and its luminance stays, which is that
// of sRGB's parts above.
TEST_F(PictureFiles, AnEnvironmentHasColoursThatSrgbHas) {
  const std::vector<float> aces{0.7347f, 0.2653f, 0, 1, 0.0001f, -0.077f, 0.32168f, 0.33767f};
  ExrPart sky = coloured({0, 1, 0, 1, 1, 1}, aces);
  sky.data = sky.display = {0, 0, 1, 0};
  sky.attributes.push_back({"whiteLuminance", {683}});
  preset::Environment environment{.file = folder.write("sky.exr", test::exr({sky})), .radiance = 2};
  std::vector<std::string> warnings;
  const scene::Environment map = scene::make_environment(environment, FileFinder(), "p.json", warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("sky.exr: its file says that white has 683 cd/m^2; a 'radiance' of 1 "
                                              "makes it so, and the preset has 2"),
                                    HasSubstr("sky.exr: 1 texel has a colour that sRGB does not have")));
  EXPECT_GE(*std::ranges::min_element(map.rgb), 0);
  const auto luminance = [&](std::size_t texel) {
    return optics::linear_srgb_to_xyz(
        {double(map.rgb[3 * texel]), double(map.rgb[3 * texel + 1]), double(map.rgb[3 * texel + 2])})[1];
  };
  EXPECT_NEAR(luminance(0), -1.13413 * 0.2126 + 1.37272 * 0.7152 - 0.15298 * 0.0722, 1e-3);
  EXPECT_NEAR(luminance(1), 1, 1e-3);
}

std::string radiance(const std::string& header, const std::string& size, const std::string& pixels) {
  return "#?RADIANCE\n" + header + "\n" + size + "\n" + pixels;
}
const std::string rgbe = "FORMAT=32-bit_rle_rgbe\n";

/// (m, 0, 0) of a mantissa of eight bits: m / 256.
std::string red(int mantissa) { return {static_cast<char>(mantissa), 0, 0, static_cast<char>(128)}; }

// The first axis is that across rows of the file; Y goes up, X to the right. Column x, row y from the top have 3 y + x.
TEST_F(PictureFiles, RadianceHasEightOrders) {
  for (const bool rows_first : {true, false})
    for (const bool up : {true, false})
      for (const bool right : {true, false}) {
        const std::string y_axis = up ? "+Y 2" : "-Y 2", x_axis = right ? "+X 3" : "-X 3";
        std::string pixels;
        const auto add = [&](int i, int j) {
          const int x = right ? i : 2 - i, y = up ? 1 - j : j;
          pixels += red(128 + 3 * y + x);
        };
        if (rows_first)
          for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 3; ++i) add(i, j);
        else
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 2; ++j) add(i, j);
        const std::string size = rows_first ? y_axis + " " + x_axis : x_axis + " " + y_axis;
        const Image image = read("p.hdr", radiance(rgbe, size, pixels));
        EXPECT_EQ(image.width, 3) << size;
        ASSERT_EQ(image.data.size(), 18u);
        for (std::size_t p = 0; p < 6; ++p) EXPECT_EQ(image.data[3 * p] * 256, 128 + static_cast<float>(p)) << size;
      }
}

TEST_F(PictureFiles, RadianceIsDividedByItsExposures) {
  const std::string pixel{char(128), char(64), char(32), char(129)}; // 1, .5, .25
  const std::string size = "-Y 1 +X 1";
  EXPECT_THAT(light("p.hdr", radiance("EXPOSURE= 2.0\n" + rgbe + "EXPOSURE=5e-1\r\nEXPOSURE=4\n", size, pixel)),
              ElementsAre(0.25f, 0.125f, 0.0625f));
  EXPECT_THAT(light("p.hdr", radiance(rgbe + "COLORCORR= 1 2 4\nCOLORCORR=2 1 1\n\tEXPOSURE=9\n", size, pixel)),
              ElementsAre(0.5f, 0.25f, 0.0625f));
  EXPECT_THAT(read("p.hdr", radiance(rgbe + "GAMMA=2.2\n", size, pixel)).notes, ElementsAre(HasSubstr("GAMMA=2.2")));
  expect_xyz(light("p.hdr", radiance("FORMAT=32-bit_rle_xyze\n", size, pixel)), {1, 0.5, 0.25});
  expect_xyz(light("p.hdr", radiance(rgbe + "PRIMARIES= 1 0 0 1 0 0 .333333 .333333\n", size, pixel)), {1, 0.5, 0.25});
}

// Ten pixels in runs of each channel; the same in runs of whole pixels, of which the second counts 256-fold.
TEST_F(PictureFiles, RadianceHasTwoKindsOfRuns) {
  std::string by_channel{2, 2, 0, 10};
  by_channel += {char(128 + 7), char(200), 3, char(128), char(129), char(130)};
  for (const int value : {0, 0, 128}) by_channel += {char(128 + 10), char(value)};
  const std::vector<float> values = light("p.hdr", radiance(rgbe, "-Y 1 +X 10", by_channel));
  for (std::size_t x = 0; x < 10; ++x) EXPECT_EQ(values[3 * x] * 256, x < 7 ? 200 : 121 + static_cast<float>(x)) << x;
  const std::string by_pixel = red(200) + std::string{1, 1, 1, 3, 1, 1, 1, 1} + red(7);
  const std::vector<float> run = light("p.hdr", radiance(rgbe, "-Y 1 +X 261", by_pixel));
  EXPECT_EQ(run[3 * 259] * 256, 200);
  EXPECT_EQ(run[3 * 260] * 256, 7);
}

TEST_F(PictureFiles, RadianceIsRefusedWhereItsHeaderMakesNoSense) {
  const auto refusal = [&](const std::string& header, const std::string& size, const std::string& pixels) {
    return test::refusal_of([&] { read("p.hdr", radiance(header, size, pixels)); });
  };
  const std::string size = "-Y 1 +X 1", pixel = red(1);
  EXPECT_THAT(refusal("", size, pixel), HasSubstr("its header has no FORMAT"));
  EXPECT_THAT(refusal("FORMAT=rgb\n", size, pixel), HasSubstr("its header says FORMAT=rgb"));
  EXPECT_THAT(refusal(rgbe + "EXPOSURE=0\n", size, pixel), HasSubstr("EXPOSURE=0, by which nothing can be divided"));
  EXPECT_THAT(refusal(rgbe + "EXPOSURE=a\n", size, pixel), HasSubstr("EXPOSURE=a, and a number is expected"));
  EXPECT_THAT(refusal(rgbe + "PRIMARIES=1 2\n", size, pixel), HasSubstr("8 numbers are expected"));
  EXPECT_THAT(refusal(rgbe, "+X 1 -X 1", pixel), HasSubstr("its size is '+X 1 -X 1'"));
  EXPECT_THAT(refusal(rgbe, "-Y 0 +X 1", pixel), HasSubstr("its size is '-Y 0 +X 1'"));
  EXPECT_THAT(refusal(rgbe, "-Y 1 +X 1000000000", pixel), HasSubstr("its rows have 1000000000 pixels"));
  EXPECT_THAT(refusal(rgbe, size, "abc"), HasSubstr("its end is missing"));
  EXPECT_THAT(refusal(rgbe, "-Y 1 +X 8", std::string{2, 2, 0, 9} + pixel), HasSubstr("another width"));
  EXPECT_THAT(refusal(rgbe, "-Y 1 +X 8", std::string{2, 2, 0, 8, char(255), 1}), HasSubstr("longer than their row"));
  EXPECT_THAT(refusal(rgbe, "-Y 1 +X 8", std::string{1, 1, 1, 8}), HasSubstr("has none before it"));
}

std::string bytes_of(std::string_view hexadecimal) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2)
    bytes.push_back(static_cast<char>(std::stoi(std::string(hexadecimal.substr(i, 2)), nullptr, 16)));
  return bytes;
}

// White of alpha 128, then opaque grey 128. Integers are not multiplied by alpha, whatever the file does: a TIFF with
// associated alpha, and OpenImageIO with every WebP.
TEST_F(PictureFiles, ColoursOfIntegersAreNotMultipliedByAlpha) {
  const std::string webp =
      bytes_of("5249464624000000574542505650384c170000002f010000100ff0c0ff07fe3ff0ff7f80f1800a44f43f0000");
  const std::pair<std::string, std::string> files[] = {{"a.webp", webp},
                                                       {"associated.tif", test::tiff(2, 1, 1, "\x80\x80\x80\xff", 1)},
                                                       {"straight.tif", test::tiff(2, 1, 1, "\xff\x80\x80\xff", 2)}};
  for (const auto& [name, bytes] : files) {
    const Rgb rgb = rgb_of(read(name, bytes), name);
    EXPECT_THAT(rgb.alpha, ElementsAre(FloatNear(128 / 255.0f, 1e-6f), 1)) << name;
    EXPECT_NEAR(rgb.values[0], 1, 1e-6) << name;
    EXPECT_NEAR(rgb.values[3], decoded_srgb(128 / 255.0), 1e-5) << name;
  }
}

// 6 says that the first row is the right column of what was seen; transposed pictures have 5 or 7.
TEST_F(PictureFiles, AreTurnedAsTheirFileSays) {
  const auto greys = [&](int orientation) {
    std::vector<long> codes;
    for (const float value : read("p.tif", test::tiff(3, 2, orientation, std::string("\0\1\2\3\4\5", 6))).data)
      codes.push_back(std::lround(value * 255));
    return codes;
  };
  EXPECT_THAT(greys(2), ElementsAre(2, 1, 0, 5, 4, 3));
  EXPECT_THAT(greys(5), ElementsAre(0, 3, 1, 4, 2, 5));
  EXPECT_THAT(greys(6), ElementsAre(3, 0, 4, 1, 5, 2));
  EXPECT_THAT(greys(7), ElementsAre(5, 2, 4, 1, 3, 0));
  EXPECT_THAT(greys(8), ElementsAre(2, 5, 1, 4, 0, 3));
}

// Black, grey, white in a row; its Exif says 6, and its profile is seven letters.
TEST_F(PictureFiles, AWebpSaysHowItWasHeldAndWhoseItsColoursAre) {
  const Image image = read(
      "p.webp", bytes_of("524946467200000057454250565038580a00000028000000020000000000494343500700000070726f66696c6500"
                         "5650384c210000002f0200000017201048529f7c0d0141d175cb09088aae5b6efe037f151423a2ff010045584946"
                         "1a0000004d4d002a00000008000101120003000000010006000000000000"));
  EXPECT_EQ(image.width, 1);
  EXPECT_THAT(image.data, ElementsAre(0, 0, 0, FloatNear(128 / 255.0f, 1e-6f), FloatNear(128 / 255.0f, 1e-6f),
                                      FloatNear(128 / 255.0f, 1e-6f), 1, 1, 1));
  EXPECT_THAT(image.notes, ElementsAre("its colour profile is not obeyed; its colours are taken as sRGB's"));
}

/// Big-endian, as ICC.1 wants numbers.
std::string big(double value, int bytes) {
  std::string text;
  const auto bits = static_cast<std::uint32_t>(std::llround(value));
  for (int i = bytes - 1; i >= 0; --i) text.push_back(static_cast<char>(bits >> (8 * i) & 255));
  return text;
}

/// A profile (ICC.1:2022) of one curve, a power, and these columns of XYZ under D50; of none of them, a grey one.
std::string profile_of(double gamma, const std::vector<std::array<double, 3>>& columns) {
  const std::string curve = "curv" + std::string(4, '\0') + big(1, 4) + big(256 * gamma, 2) + std::string(2, '\0');
  const auto xyz = [](const std::array<double, 3>& values) {
    std::string text = "XYZ " + std::string(4, '\0');
    for (const double value : values) text += big(65536 * value, 4);
    return text;
  };
  std::vector<std::pair<std::string, std::string>> tags{{"wtpt", xyz({0.9642, 1, 0.8249})}};
  if (columns.empty()) tags.emplace_back("kTRC", curve);
  for (std::size_t c = 0; c < columns.size(); ++c)
    tags.emplace_back(std::string(1, "rgb"[c]) + "XYZ", xyz(columns[c])),
        tags.emplace_back(std::string(1, "rgb"[c]) + "TRC", curve);
  std::string table = big(static_cast<double>(tags.size()), 4), data;
  for (const auto& [name, bytes] : tags) {
    table += name + big(static_cast<double>(132 + 12 * tags.size() + data.size()), 4) +
             big(static_cast<double>(bytes.size()), 4);
    data += bytes;
  }
  const std::string size = big(static_cast<double>(128 + table.size() + data.size()), 4);
  return size + std::string(4, '\0') + big(0x04300000, 4) + "mntr" + (columns.empty() ? "GRAY" : "RGB ") + "XYZ " +
         std::string(12, '\0') + "acsp" + std::string(28, '\0') + xyz({0.9642, 1, 0.8249}).substr(8) +
         std::string(48, '\0') + table + data;
}

// Red, green and grey 128 of a linear profile that has sRGB's green where sRGB has red, and the other way round; then
// of sRGB's own columns and a power of 1.8.
TEST_F(PictureFiles, AProfileIsObeyed) {
  const std::array<double, 3> red{0.43607, 0.22249, 0.01392}, green{0.38515, 0.71687, 0.09708},
      blue{0.14307, 0.06061, 0.7141};
  const auto webp = [&](const std::string& profile) {
    const auto chunk = [](const std::string& name, const std::string& bytes) {
      const std::string size = big(static_cast<double>(bytes.size()), 4);
      return name + std::string(size.rbegin(), size.rend()) + bytes + std::string(bytes.size() % 2, '\0');
    };
    return chunk("RIFF", "WEBP" + chunk("VP8X", bytes_of("20000000020000000000")) + chunk("ICCP", profile) +
                             chunk("VP8L", bytes_of("2f020000001720904d76f3ccd31010145db7dc00ce7f4c53a12111fd0f00")));
  };
  const Image image = read("p.webp", webp(profile_of(1, {green, red, blue})));
  EXPECT_THAT(image.notes, IsEmpty());
  const float grey = 128 / 255.0f;
  EXPECT_THAT(rgb_of(image, "p").values, AreAbout(std::vector{0.0f, 1.0f, 0.0f, 1.0f, 0.0f, 0.0f, grey, grey, grey}));
  const float dark = std::pow(grey, 1.8f);
  EXPECT_THAT(light("g.webp", webp(profile_of(1.8, {red, green, blue}))),
              AreAbout(std::vector{1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, dark, dark, dark}));
  EXPECT_THAT(read("k.webp", webp(profile_of(1, {}))).notes,
              ElementsAre(HasSubstr("its colour profile is not obeyed")));
  const std::string tiff = test::tiff(1, 1, 1, "\x80", 0, profile_of(1, {}));
  EXPECT_THAT(light("p.tif", tiff), AreAbout(std::vector{grey, grey, grey}));
}

// Behind the header of a PNG, a gamma of 1 with its check sum.
TEST_F(PictureFiles, APngHasTheGammaThatItSays) {
  write_png_bytes(folder.path() / "p.png", 1, 1, {128, 128, 128, 255});
  std::string bytes = read_file(folder.path() / "p.png");
  EXPECT_NEAR(light("plain.png", bytes)[0], decoded_srgb(128 / 255.0), 1e-6);
  bytes.insert(33, bytes_of("0000000467414d41000186a031e8965f"));
  EXPECT_NEAR(light("linear.png", bytes)[0], 128 / 255.0, 1e-5);
}

// In the same place, a profile p of two letters that are no zlib stream.
TEST_F(PictureFiles, APngWithADamagedProfileSaysIt) {
  write_png_bytes(folder.path() / "p.png", 1, 1, {128, 128, 128, 255});
  std::string bytes = read_file(folder.path() / "p.png");
  EXPECT_THAT(read("plain.png", bytes).notes, IsEmpty());
  bytes.insert(33, bytes_of("00000005694343507000007a7a546468dd"));
  const Image image = read("damaged.png", bytes);
  EXPECT_THAT(image.notes, ElementsAre("its colour profile cannot be read; its colours are taken as sRGB's"));
  EXPECT_NEAR(rgb_of(image, "p").values[0], decoded_srgb(128 / 255.0), 1e-6);
}

TEST(PixelOrders, AreMirroredAndTurned) {
  const PixelOrder upright = pixel_order(1);
  EXPECT_EQ(mirrored(upright), pixel_order(2));
  PixelOrder turned = upright;
  for (const int orientation : {8, 3, 6, 1}) EXPECT_EQ(turned = turned_left(turned), pixel_order(orientation));
  EXPECT_EQ(mirrored(pixel_order(5)), pixel_order(6));
  EXPECT_EQ(mirrored(pixel_order(7)), pixel_order(8));
}

} // namespace nephroid::picture_files_test
