// SPDX-License-Identifier: Apache-2.0
// Picture files as light a cell, and what is said of them before a run: the best that facets could cast, and notes.
#include "image/image.h"
#include "inverse/assign/cost.h"
#include "inverse/engine.h"
#include "inverse/job.h"
#include "inverse/pictures/preview.h"
#include "inverse/pictures/target.h"
#include "preset/read.h"
#include "tests/inverse/drawn.h"
#include "tests/support/jpeg.h"
#include "tests/support/render.h"
#include "tests/support/test.h"
#include "tests/support/tiff.h"

#include <glm/gtc/constants.hpp>

namespace nephroid::photographs_test {

using namespace inverse;

Layout cells(int across, int down) { return {.receiver = glm::dvec2(across, down), .cells = {across, down}}; }

class Photographs : public testing::Test {
protected:
  Target made(const Picture& picture, const Layout& layout) {
    return make_target(picture, layout, FileFinder(), "p", file_notes);
  }
  std::string write(int width, int height, const std::vector<float>& greys) {
    image::write_exr(folder.path() / "p.exr", {width, height, {"Y"}, greys});
    return (folder.path() / "p.exr").string();
  }
  test::TemporaryFolder folder;
  std::vector<std::string> file_notes;
};

TEST_F(Photographs, ToneIsAnExponent) {
  Picture picture{.type = Picture::Type::file, .file = write(2, 1, {2, 4}), .tone = 2};
  const Target target = made(picture, cells(2, 1));
  EXPECT_NEAR(target[0], 0.2, 1e-9); // (1/2)^2 of 1 + (1/2)^2
  EXPECT_NEAR(target[1], 0.8, 1e-9);
}

// Of .2, .5 and 1 of the brightest, levels from .2 to .8 make 0, .5 and 1.
TEST_F(Photographs, LevelsAreContrast) {
  Picture picture{.type = Picture::Type::file, .file = write(3, 1, {0.4f, 1, 2}), .levels = {0.2, 0.8}};
  const Target target = made(picture, cells(3, 1));
  for (const auto& [cell, part] : {std::pair<std::size_t, double>(0, 0), {1, 1 / 3.0}, {2, 2 / 3.0}})
    EXPECT_NEAR(target[cell], part, 1e-7);
  picture.levels = {0.2, 0.2};
  EXPECT_THAT(test::refusal_of([&] {
                preset::parse_preset(
                    R"({"engine": "inverse", "scene": {"camera": {}}, "inverse": {"receivers": [{"distance_mm": 100,
                  "picture": {"type": "file", "file": "p.exr", "levels": [0.5, 0.5]}}]}})",
                    "p.json");
              }),
              HasSubstr("levels: is [0.5, 0.5]; expected the darker one first"));
}

// A picture of 4 x 2 on 8 x 8 cells is 8 x 4: its edge fades over half of 2 cells. The cells' middles are .5, 1.5 and
// more from the edge.
TEST_F(Photographs, AVignetteFadesTowardsThePicturesOwnEdge) {
  Picture picture{.type = Picture::Type::file, .file = write(4, 2, {1, 1, 1, 1, 1, 1, 1, 0.999f}), .vignette = 1};
  const Target target = made(picture, cells(8, 8));
  const auto at = [&](std::size_t x, std::size_t y) { return target[y * 8 + x]; };
  const auto fade = [](double from_edge) { return 0.5 - 0.5 * std::cos(glm::pi<double>() * from_edge / 2); };
  EXPECT_EQ(at(3, 1), 0);
  EXPECT_NEAR(at(0, 2) / at(3, 3), fade(0.5) * fade(0.5) / fade(1.5), 1e-6);
  EXPECT_NEAR(at(1, 3) / at(3, 3), fade(1.5), 1e-6);
  EXPECT_NEAR(at(0, 2), at(7, 2), 1e-6);
}

TEST_F(Photographs, AreDarkWhereTheyAreTransparent) {
  image::write_png_bytes(folder.path() / "cut.png", 2, 1, {255, 255, 255, 0, 255, 255, 255, 255});
  Picture picture{.type = Picture::Type::file, .file = (folder.path() / "cut.png").string()};
  EXPECT_THAT(made(picture, cells(2, 1)), ElementsAre(0, 1));
  image::write_png_bytes(folder.path() / "cut.png", 2, 1, {255, 255, 255, 0, 0, 255, 0, 0});
  EXPECT_THAT(
      test::refusal_of([&] { made(picture, cells(2, 1)); }),
      AllOf(HasSubstr("cut.png: is black all over or transparent"), HasSubstr("'ground'"), HasSubstr("'invert'")));
}

// A soft edge: white of alpha .5 is .5 of white, whether integers are multiplied by alpha or floats are.
TEST_F(Photographs, CountAlphaOnce) {
  const std::pair<std::string, std::string> files[] = {{"a.tif", test::tiff(2, 1, 1, "\xff\x80\xff\xff", 2)},
                                                       {"b.tif", test::tiff(2, 1, 1, "\x80\x80\xff\xff", 1)}};
  for (const auto& [name, bytes] : files) {
    const Target target = made({.type = Picture::Type::file, .file = folder.write(name, bytes)}, cells(2, 1));
    EXPECT_NEAR(target[0] / target[1], 128 / 255.0, 1e-6) << name;
  }
  image::write_exr(folder.path() / "c.exr", {2, 1, {"A", "Y"}, {0.5f, 0.5f, 1, 1}});
  Picture picture{.type = Picture::Type::file, .file = (folder.path() / "c.exr").string()};
  EXPECT_THAT(made(picture, cells(2, 1)), ElementsAre(DoubleNear(1 / 3.0, 1e-9), DoubleNear(2 / 3.0, 1e-9)));
  picture.ground = 0.5; // behind half of the first pixel
  EXPECT_THAT(made(picture, cells(2, 1)), ElementsAre(DoubleNear(3 / 7.0, 1e-9), DoubleNear(4 / 7.0, 1e-9)));
}

// Black beside a transparent pixel: on a ground that is bright, inverted it is. 188 is half of white, and 67 its
// negative.
TEST_F(Photographs, HaveAGroundAndANegative) {
  image::write_png_bytes(folder.path() / "p.png", 2, 1, {0, 0, 0, 255, 0, 0, 0, 0});
  Picture picture{.type = Picture::Type::file, .file = (folder.path() / "p.png").string(), .ground = 1};
  EXPECT_THAT(made(picture, cells(2, 1)), ElementsAre(0, 1));
  picture.invert = true;
  picture.ground = 0;
  EXPECT_THAT(made(picture, cells(2, 1)), ElementsAre(1, 0));
  image::write_png_bytes(folder.path() / "p.png", 2, 1, {188, 188, 188, 255, 0, 0, 0, 255});
  const Target target = made(picture, cells(2, 1));
  EXPECT_NEAR(target[0] / target[1], image::decoded_srgb(67 / 255.0), 1e-4);
}

// Two pixels above two: 0, 1 of 4, 2, 3.
TEST_F(Photographs, AreMirroredThenTurned) {
  Picture picture{.type = Picture::Type::file, .file = write(2, 2, {0, 1, 2, 3})};
  const auto order = [&] {
    std::vector<long> greys;
    for (const double light : made(picture, cells(2, 2))) greys.push_back(std::lround(6 * light));
    return greys;
  };
  picture.turn_deg = 90;
  EXPECT_THAT(order(), ElementsAre(1, 3, 0, 2));
  picture.turn_deg = -180;
  EXPECT_THAT(order(), ElementsAre(3, 2, 1, 0));
  picture.mirror = true;
  EXPECT_THAT(order(), ElementsAre(2, 3, 0, 1));
  picture.turn_deg = 450;
  EXPECT_THAT(order(), ElementsAre(0, 2, 1, 3));
}

// Of 4 x 1 pixels on 2 x 1 cells the middle two fill them; what is cropped does not count as the brightest either.
TEST_F(Photographs, FillTheReceiverWhereTheyCoverIt) {
  Picture picture{.type = Picture::Type::file, .file = write(4, 1, {9, 1, 3, 0}), .fit = Picture::Fit::cover};
  EXPECT_THAT(made(picture, cells(2, 1)), ElementsAre(DoubleNear(0.25, 1e-9), DoubleNear(0.75, 1e-9)));
  picture.levels = {0, 0.5}; // of 3
  EXPECT_THAT(made(picture, cells(2, 1)), ElementsAre(DoubleNear(0.4, 1e-9), DoubleNear(0.6, 1e-9)));
}

// A radiance picture whose pixels are twice as high as wide.
TEST_F(Photographs, HaveThePixelsThatTheySay) {
  const std::string file = folder.write("p.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nPIXASPECT=2\n\n-Y 1 +X 2\n" +
                                                     std::string("\x80\x80\x80\x80\xff\xff\xff\x80", 8));
  const Target target = made({.type = Picture::Type::file, .file = file}, cells(2, 2));
  EXPECT_EQ(target[0], target[2]);
  EXPECT_NEAR(target[0] / target[1], 128 / 255.0, 1e-6);
}

TEST_F(Photographs, AreTurnedByQuarters) {
  EXPECT_THAT(test::refusal_of([&] {
                preset::parse_preset(
                    R"({"engine": "inverse", "scene": {"camera": {}}, "inverse": {"receivers": [{"distance_mm": 100,
                  "picture": {"type": "file", "file": "p.exr", "turn_deg": 45}}]}})",
                    "p.json");
              }),
              HasSubstr("turn_deg: is 45, and a file is turned by quarters; expected a multiple of 90"));
}

TEST_F(Photographs, SayWhatOfAFileIsNotObeyed) {
  const std::string file = folder.write("p.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nGAMMA=2\n\n-Y 1 +X 2\n" +
                                                     std::string("\x80\x80\x80\x80\xff\xff\xff\x80", 8));
  made({.type = Picture::Type::file, .file = file}, cells(2, 2));
  EXPECT_THAT(file_notes, ElementsAre(HasSubstr("picture p.hdr: its header says GAMMA=2, which is not obeyed")));
}

// 1700 x 1300 pixels of three channels are read in two bands. Row y has the byte y / 6, column x adds nothing: a row of
// cells is the mean of the rows that it covers, decoded.
TEST_F(Photographs, AreReadInBands) {
  const int width = 1700, height = 1300;
  std::vector<unsigned char> bytes;
  std::vector<double> rows;
  for (int y = 0; y < height; ++y) {
    const auto byte = static_cast<unsigned char>(y / 6);
    rows.push_back(image::decoded_srgb(byte / 255.0));
    for (int x = 0; x < width; ++x)
      for (const unsigned char value : {byte, byte, byte, static_cast<unsigned char>(255)}) bytes.push_back(value);
  }
  image::write_png_bytes(folder.path() / "p.png", width, height, bytes);
  int bands = 0;
  image::read_bands(folder.path() / "p.png", [&](const image::Band&) { ++bands; });
  EXPECT_GT(bands, 1);
  Picture picture{.type = Picture::Type::file, .file = (folder.path() / "p.png").string()};
  const Target target = made(picture, cells(17, 13));
  double sum = 0;
  for (const double row : rows) sum += row;
  for (std::size_t y = 0; y < 13; ++y) {
    double wanted = 0;
    for (std::size_t i = 0; i < 100; ++i) wanted += rows[100 * y + i];
    for (const std::size_t x : {0u, 8u, 16u}) EXPECT_NEAR(target[y * 17 + x] * 17, wanted / sum, 1e-6) << y;
  }
}

// Three bytes in a row: 6 says that the row is the right column of what was seen, 8 that it is the left one from below.
TEST_F(Photographs, AreTurnedAsTheirFileSays) {
  const auto seen = [&](int orientation, int across, int down) {
    const std::string file = (folder.path() / "p.tif").string();
    write_file_whole(file, test::tiff(3, 1, orientation, std::string("\x00\x80\xff", 3)));
    const Target target = made({.type = Picture::Type::file, .file = file}, cells(across, down));
    std::vector<int> order;
    for (const double light : target) order.push_back(light == 0 ? 0 : light < 0.5 ? 1 : 2);
    return order;
  };
  EXPECT_THAT(seen(1, 3, 1), ElementsAre(0, 1, 2));
  EXPECT_THAT(seen(2, 3, 1), ElementsAre(2, 1, 0));
  EXPECT_THAT(seen(3, 3, 1), ElementsAre(2, 1, 0));
  EXPECT_THAT(seen(4, 3, 1), ElementsAre(0, 1, 2));
  EXPECT_THAT(seen(5, 1, 3), ElementsAre(0, 1, 2));
  EXPECT_THAT(seen(6, 1, 3), ElementsAre(0, 1, 2));
  EXPECT_THAT(seen(7, 1, 3), ElementsAre(2, 1, 0));
  EXPECT_THAT(seen(8, 1, 3), ElementsAre(2, 1, 0));
}

// A strip of 30000 x 2 grows brighter to the right; on 8 x 8 cells it is less than a thousandth of a cell high.
TEST_F(Photographs, MayBeVeryWide) {
  std::vector<float> greys(60000);
  for (std::size_t i = 0; i < greys.size(); ++i) greys[i] = static_cast<float>(i % 30000) / 30000;
  const Target target = made({.type = Picture::Type::file, .file = write(30000, 2, greys)}, cells(8, 8));
  for (std::size_t x = 0; x < 8; ++x)
    EXPECT_NEAR(target[3 * 8 + x], (2 * static_cast<double>(x) + 1) / 128,
                1e-5); // the strip is on the line between two rows
  EXPECT_EQ(target[0], 0);
}

TEST_F(Photographs, AreRefusedWhereTheyAreHuge) {
  const std::string file = (folder.path() / "p.hdr").string();
  std::ofstream(file, std::ios::binary) << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n";
  EXPECT_THAT(
      test::refusal_of([&] { made({.type = Picture::Type::file, .file = file}, cells(8, 8)); }),
      AllOf(HasSubstr("p.hdr"), HasSubstr("60000 x 60000 pixels of 3 channels, and at most 2^32 values are read")));
}

// A JPEG without its second half, whose pixels a decoder makes grey.
TEST_F(Photographs, AreRefusedWithoutTheirEnd) {
  const std::string whole = test::jpeg(), file = (folder.path() / "p.jpg").string();
  write_file_whole(file, whole);
  EXPECT_EQ(made({.type = Picture::Type::file, .file = file}, cells(8, 8)).size(), 64u);
  write_file_whole(file, whole.substr(0, whole.size() - 100));
  const std::string said = test::refusal_of([&] { made({.type = Picture::Type::file, .file = file}, cells(8, 8)); });
  EXPECT_THAT(said, AllOf(HasSubstr("p.jpg: is no picture that can be read"), HasSubstr("Premature end of JPEG file")));
}

/// Facets of a cell's size and light that rough surfaces do not scatter: every picture can be cast.
Layout layout_with(double scatter) {
  return {.facets = {32, 32}, .cells = {32, 32}, .distances = {200}, .scatter = scatter};
}

TEST(BestPossible, IsThePictureWhereFacetsAreSmall) {
  const Layout layout = layout_with(0);
  const Target target = drawn({.type = Picture::Type::star}, layout);
  EXPECT_EQ(best_possible(layout, target, 0), target);
}

// With a rough surface nothing is sharper than its blur. What the search finds is better by a tenth at most: it aims
// finer than at cells' middles, and the smear is kept along the axes alone.
TEST(BestPossible, IsAsSoftAsTheLightOfAFacet) {
  const Layout layout = layout_with(0.02); // 4 mm, cells are 3.1 mm
  const Target target = drawn({.type = Picture::Type::ring}, layout);
  const Target best = best_possible(layout, target, 0);
  EXPECT_NEAR(std::accumulate(best.begin(), best.end(), 0.0), 1, 1e-12);
  EXPECT_GE(*std::min_element(best.begin(), best.end()), 0);
  preset::Preset p =
      preset::parse_preset(R"({"engine": "inverse", "scene": {"camera": {}}, "inverse": {"facets": [32, 32],
    "cells": [32, 32], "index": 1.5, "receivers": [{"distance_mm": 200, "picture": {"type": "ring"}}]}})",
                           "p.json");
  settings(p).scatter_deg = glm::degrees(std::atan(0.02));
  const auto job = make_job(p, make_plan(p), test::shared_context());
  while (!job->finished()) job->advance();
  const double found = job::scalar(job->snapshot(), "believed", "rel_l2"), possible = cost_of(target, best, 1).rel_l2;
  EXPECT_GT(possible, 0.1);
  EXPECT_GT(found, 0.7 * possible);
  EXPECT_LT(found, 1.3 * possible);
}

// A picture that is dropped on the window: what can come of it is there before any step.
TEST_F(Photographs, ArePreviewedAtOnce) {
  preset::Preset p =
      preset::parse_preset(R"({"engine": "inverse", "scene": {"camera": {}}, "inverse": {"facets": [32, 32],
    "cells": [8, 8], "index": 1.5, "receivers": [{"distance_mm": 200, "picture": {"type": "ring"}}]}})",
                           "p.json");
  const auto job = make_job(p, make_plan(p), test::shared_context());
  std::vector<float> greys(64);
  for (std::size_t i = 0; i < 64; ++i) greys[i] = static_cast<float>(i) / 63;
  engine::engine_of(p).take_picture(p, write(8, 8, greys));
  ASSERT_TRUE(job->adopt(p));
  const job::Snapshot made = job->snapshot();
  const auto best = std::ranges::find(made.pictures, "best_1", &job::NamedPicture::name)->picture;
  for (std::size_t i = 0; i < 64; ++i) EXPECT_NEAR(best->rgb[3 * i], greys[i], 1e-6);
}

class PictureNotes : public Photographs {
protected:
  /// Of one picture, 1 / 16 of it white.
  std::vector<std::string> notes(const std::string& more) {
    std::vector<float> greys(64);
    for (const std::size_t i : {27u, 28u, 35u, 36u}) greys[i] = 1;
    const std::string text =
        R"({"engine": "inverse", "scene": {"camera": {}}, "inverse": {"facets": [64, 64], "cells": [32, 32],
      "index": 1.5, "receivers": [{"distance_mm": 200, "picture": {"type": "file", "file": ")" +
        write(8, 8, greys) + "\"" + more + "}";
    const preset::Preset preset = preset::parse_preset(text + "}", "p.json");
    return notes_of(preset, Design(preset));
  }
};

TEST_F(PictureNotes, SayWhatAPhotographComesTo) {
  EXPECT_THAT(notes("}}]"),
              ElementsAre(AllOf(HasSubstr("picture 1 is dark"), HasSubstr("gets 16 times that of an even picture"),
                                HasSubstr("a 'background' of 0.20 more makes that 4")),
                          HasSubstr("choose the method 'lens'")));
  // The background that it asks for leaves the other note alone.
  EXPECT_THAT(notes(R"(, "background": 0.2}}])"), ElementsAre(HasSubstr("choose the method 'lens'")));
  EXPECT_THAT(notes(R"(, "background": 0.2}}], "scatter_deg": 1)"), Contains(HasSubstr("comes hardly closer than")));
}

// What is said of a photograph is said of a drawing that has greys, or that a lens makes of little light.
TEST_F(PictureNotes, SayItOfDrawingsToo) {
  const auto said = [](const std::string& method, const std::string& picture) {
    const preset::Preset p = preset::parse_preset(
        fmt::format(R"({{"engine": "inverse", "scene": {{"camera": {{}}}}, "inverse": {{"method": "{}",
      "facets": [64, 64], "cells": [32, 32], "index": 1.5, "thickness_mm": 40,
      "receivers": [{{"distance_mm": 300, "picture": {}}}]}}}})",
                    method, picture),
        "p.json");
    return notes_of(p, Design(p));
  };
  const std::string spot = R"({"type": "disc", "radius": 0.1)";
  EXPECT_THAT(said("assign", spot + "}"), IsEmpty());
  EXPECT_THAT(said("assign", spot + R"(, "background": 0.3})"), ElementsAre(HasSubstr("which greys show as grain")));
  EXPECT_THAT(said("assign", R"({"type": "gradient"})"), ElementsAre(HasSubstr("which greys show as grain")));
  EXPECT_THAT(said("lens", spot + "}"), Contains(HasSubstr("picture 1 is dark")));
  EXPECT_THAT(said("lens", spot + R"(, "background": 0.3})"), IsEmpty());
}

// In every light the coarse lens is as deep as the one that is made.
TEST_F(PictureNotes, ALensIsAsDeepInLightFromTheSide) {
  for (const char* light :
       {R"({"type": "parallel", "tilt_deg": 5, "turn_deg": 30})", R"({"type": "point", "distance_mm": 500})"})
    for (const char* outline : {"rectangle", "round"}) {
      const preset::Preset p =
          preset::parse_preset(fmt::format(R"({{"engine": "inverse", "scene": {{"camera": {{}}}}, "inverse": {{
        "method": "lens", "facets": [64, 64], "cells": [32, 32], "index": 1.5, "thickness_mm": 40, "light": {}, "outline": "{}",
        "receivers": [{{"distance_mm": 300, "picture": {{"type": "ring"}}}}]}}}})",
                                           light, outline),
                               "p.json");
      const InversePlan plan = make_plan(p);
      const auto job = make_job(p, plan, test::shared_context());
      while (!job->finished()) job->advance();
      const double deep = job::scalar(job->snapshot(), "object", "relief_mm");
      EXPECT_NEAR(plan.design->lens().relief_mm / deep, 1, 0.1) << light << outline;
    }
}

// A lens gathers the light of its facets: it is not sharper where they are smaller than half a cell.
TEST_F(PictureNotes, ALensHasNoGrain) {
  preset::Preset p =
      preset::parse_preset(R"({"engine": "inverse", "scene": {"camera": {}}, "inverse": {"method": "lens",
    "facets": [128, 128], "cells": [64, 64], "index": 1.5, "thickness_mm": 40, "receivers": [{"distance_mm": 300, "picture": {"type": "ring"}}]}})",
                           "p.json");
  EXPECT_THAT(notes_of(p, Design(p)), IsEmpty());
  settings(p).scatter_deg = 1;
  EXPECT_THAT(notes_of(p, Design(p)), ElementsAre(HasSubstr("picture 1 comes hardly closer than")));
  settings(p).scatter_deg = 0;
  settings(p).facets = {127, 127};
  EXPECT_THAT(notes_of(p, Design(p)), ElementsAre(AllOf(HasSubstr("are larger than half a cell"),
                                                        HasSubstr("even grey shows them as a pattern"))));
  settings(p).method = Settings::Method::assign;
  EXPECT_THAT(notes_of(p, Design(p)), Contains(HasSubstr("half a cell of 1.562 x 1.562 mm: the pictures become soft")));
}

// The coarse lens is as deep as the one that is made.
TEST_F(PictureNotes, ALensIsAsDeepAsTheySay) {
  EXPECT_THAT(notes(R"(, "background": 0.2}}], "method": "lens", "thickness_mm": 40)"), IsEmpty());
  const preset::Preset p =
      preset::parse_preset(R"({"engine": "inverse", "scene": {"camera": {}}, "inverse": {"method": "lens",
    "facets": [96, 96], "cells": [48, 48], "index": 1.5, "thickness_mm": 4, "receivers": [{"distance_mm": 300, "picture": {"type": "ring"}}]}})",
                           "p.json");
  const InversePlan plan = make_plan(p);
  const double estimated = plan.design->lens().relief_mm;
  EXPECT_THAT(notes_of(p, *plan.design),
              Contains(HasSubstr(
                  fmt::format("the lens becomes some {:.2g} mm deep, and the object is 4 mm thick", estimated))));
  const auto job = make_job(p, plan, test::shared_context());
  while (job->progress().step < 40 && !job->finished()) job->advance();
  const job::Snapshot made = job->snapshot();
  const auto slopes = std::ranges::find(made.pictures, "slopes", &job::NamedPicture::name)->picture;
  double low = 0, high = 0;
  for (std::size_t i = 2; i < slopes->rgb.size(); i += 3) {
    low = std::min<double>(low, slopes->rgb[i]);
    high = std::max<double>(high, slopes->rgb[i]);
  }
  EXPECT_NEAR(estimated, high - low, 0.1 * (high - low));
}

} // namespace nephroid::photographs_test
