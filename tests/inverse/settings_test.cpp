// SPDX-License-Identifier: Apache-2.0
// Bad input of engine 3: each a line that says what would work.
#include "image/image.h"
#include "inverse/bending.h"
#include "inverse/plan.h"
#include "preset/read.h"
#include "tests/support/test.h"

namespace nephroid::settings_test {

using inverse::Layout;

class InverseSettings : public testing::Test {
protected:
  test::TemporaryFolder folder;

  preset::Preset read(const preset::Overrides& overrides = {}) const {
    return preset::parse_preset(
        R"({"engine": "inverse", "inverse": {"receivers": [{"distance_mm": 100, "picture": {"type": "ring"}}]}})",
        "own.json", overrides);
  }
  /// Of reading, else of planning.
  std::string refusal(const preset::Overrides& overrides) const {
    return test::refusal_of([&] { inverse::make_plan(read(overrides)); });
  }
  /// Of a picture file of these greys.
  std::string refusal_of_picture(int width, int height, const std::vector<float>& greys) {
    image::Image picture{width, height, {"Y"}, greys};
    image::write_exr(folder.path() / "p.exr", picture);
    return refusal({"inverse.receivers.0.picture=" + (folder.path() / "p.exr").string()});
  }
};

TEST_F(InverseSettings, TakesADefault) { EXPECT_EQ(inverse::make_plan(read()).design->targets.size(), 1u); }

// 3 degrees were judged to take 4 % of the light of inverse/shapes, whose nearest receiver is as far: the estimate is 2
// tan(3 degrees) g, where g = .25 / (1.5 sqrt(1 + .25^2) - 1) is the gradient that sends light a quarter of the
// receiver aside: 4.8 %. A facet rises by .36 mm.
TEST_F(InverseSettings, AWorkshopIsWarnedBeforeTheRun) {
  const auto notes = [&](const preset::Overrides& overrides) {
    const preset::Preset preset = read(overrides);
    return fmt::format("{}", fmt::join(inverse::notes_of(preset, inverse::Design(preset)), "\n"));
  };
  EXPECT_THAT(notes({"inverse.draft_deg=3"}), HasSubstr("lean by 3 degrees take some 5 % of the light"));
  EXPECT_THAT(notes({"inverse.layer_mm=0.1"}), HasSubstr("rises by 0.36 mm, 3.6 layers of 0.1 mm"));
  EXPECT_THAT(notes({"inverse.draft_deg=1", "inverse.layer_mm=0.05"}),
              AllOf(Not(HasSubstr("lean")), Not(HasSubstr("layers"))));
}

TEST_F(InverseSettings, Distances) {
  EXPECT_THAT(refusal({"inverse.receivers.0.distance_mm=0"}), HasSubstr("expected a number from 0.01 to 1000000 mm"));
  EXPECT_THAT(refusal({"inverse.receivers.0.distance_mm=-5"}), HasSubstr("expected a number from 0.01"));
  const std::string two =
      R"(inverse.receivers=[{"distance_mm": 90, "picture": {"type": "disc"}}, {"distance_mm": %, "picture": {"type": "disc"}}])";
  const auto with = [&](const std::string& second) {
    return refusal({std::string(two).replace(two.find('%'), 1, second)});
  };
  EXPECT_THAT(with("50"),
              AllOf(HasSubstr("is 50 mm, and the receiver before stands at 90 mm"), HasSubstr("sort them")));
  EXPECT_THAT(with("90"), HasSubstr("is 90 mm, and the receiver before stands at the same place"));
  EXPECT_NO_THROW(inverse::make_plan(read({std::string(two).replace(two.find('%'), 1, "90, \"offset_mm\": [50, 0]")})));
  EXPECT_THAT(refusal({"inverse.receivers=[]"}), HasSubstr("expected a list of 1 to 16 items"));
  EXPECT_THAT(refusal({"inverse.receivers.0.distance_mm=0.2"}),
              AllOf(HasSubstr("can reach"), HasSubstr("free of the object")));
  EXPECT_THAT(refusal({"inverse.thickness_mm=0.2"}), AllOf(HasSubstr("can reach"), HasSubstr("choose more facets")));
}

/// What the plan says before any work.
std::string notes_of(const preset::Preset& preset) {
  return fmt::format("{}", fmt::join(inverse::notes_of(preset, inverse::Design(preset)), "\n"));
}

// A ring over 200 mm takes a lens some 11 mm deep.
TEST_F(InverseSettings, LimitsThatALensWillMissAreSaidBefore) {
  const auto notes = [&](const std::string& limit) {
    return notes_of(read({"inverse.method=lens", "inverse.facets=[32, 32]", "inverse.cells=[32, 32]",
                          "inverse.receivers.0.distance_mm=200", limit}));
  };
  EXPECT_THAT(notes("inverse.max_relief_mm=2"), HasSubstr("mm deep, and 'max_relief_mm' is 2; the run is refused"));
  EXPECT_THAT(notes("inverse.min_thickness_mm=8"), HasSubstr("left at its thinnest, where 'min_thickness_mm' is 8"));
  EXPECT_THAT(notes("inverse.max_slope_deg=5"), HasSubstr("degrees, and 'max_slope_deg' is 5; the run is refused"));
  for (const char* wide :
       {"inverse.max_relief_mm=20", "inverse.min_thickness_mm=1", "inverse.max_slope_deg=60", "inverse.layer_mm=0.01"})
    EXPECT_THAT(notes(wide), Not(HasSubstr("refused"))) << wide;
}

// 550 nm over 400 mm behind 10 / 64 mm: 1.408 mm, or 9.01 cells of that width, and so 64 / 9.01 = 7 facets. A lens
// lights a cell by a 64th of itself: 64 / sqrt(9.01) = 21 cells.
TEST_F(InverseSettings, LightThatIsAWaveIsSaidBefore) {
  const preset::Overrides small{"inverse.size_mm=[10, 10]", "inverse.facets=[64, 64]", "inverse.cells=[64, 64]",
                                "inverse.receivers.0.distance_mm=400"};
  EXPECT_THAT(notes_of(read(small)), AllOf(HasSubstr("550 nm over 9.01 cells"), HasSubstr("7 x 7 facets")));
  preset::Overrides lens = small;
  lens.push_back("inverse.method=lens");
  EXPECT_THAT(notes_of(read(lens)), AllOf(HasSubstr("550 nm over 9.01 cells"), HasSubstr("21 x 21 cells")));
  EXPECT_THAT(notes_of(read()), Not(HasSubstr("wave")));
}

TEST_F(InverseSettings, ALensCastsOnePicture) {
  EXPECT_THAT(
      refusal(
          {"inverse.method=lens",
           R"(inverse.receivers=[{"distance_mm": 90, "picture": {"type": "disc"}}, {"distance_mm": 99, "picture": {"type": "disc"}}])"}),
      AllOf(HasSubstr("is \"lens\", and there are 2 receivers"), HasSubstr("choose \"assign\"")));
  EXPECT_THAT(refusal({"inverse.method=lens", "inverse.heights=free"}), HasSubstr("a surface without steps"));
  EXPECT_THAT(refusal({"inverse.method=lens", "inverse.draft_deg=3"}), HasSubstr("a surface without walls"));
  EXPECT_THAT(refusal({"inverse.outline=round"}),
              AllOf(HasSubstr("is \"round\", and the method \"assign\" makes rows of facets"),
                    HasSubstr("choose the method \"lens\"")));
  EXPECT_NO_THROW(inverse::make_plan(read({"inverse.method=lens", "inverse.outline=round"})));
  EXPECT_NO_THROW(
      inverse::make_plan(read({"inverse.method=lens", R"(inverse.light={"type": "parallel", "tilt_deg": 5})"})));
  EXPECT_NO_THROW(
      inverse::make_plan(read({"inverse.method=lens", R"(inverse.light={"type": "point", "distance_mm": 500})"})));
  EXPECT_THAT(refusal({"inverse.method=lens", "inverse.facets=[512, 512]", "inverse.cells=[512, 512]",
                       "inverse.mesh_error=0.001"}),
              AllOf(StartsWith("own.json#/inverse/mesh_error: is 0.001, for which the lens takes some "),
                    HasSubstr("million triangles, an STL of "),
                    HasSubstr("choose a larger mesh_error or fewer cells")));
}

TEST_F(InverseSettings, Index) {
  EXPECT_THAT(refusal({"inverse.index=1"}),
              HasSubstr("is 1, which bends no light; expected another index, such as 1.5"));
  EXPECT_THAT(refusal({R"(inverse.index={"type": "cauchy", "coefficients": [1.0005]})"}),
              HasSubstr("bends hardly any light"));
  EXPECT_THAT(refusal({"inverse.index=materials/no-such.yml"}), HasSubstr("no-such.yml"));
  EXPECT_NEAR(inverse::make_plan(read({"inverse.index=PMMA-Szczurowski"})).design->layout.n, 1.49, 0.01);
}

TEST_F(InverseSettings, Lights) {
  EXPECT_THAT(refusal({R"(inverse.light={"type": "point", "distance_mm": -300})"}),
              HasSubstr("own.json#/inverse/light/distance_mm: is -300 mm, and the light would stand behind the front"));
  EXPECT_THAT(refusal({R"(inverse.light={"type": "point", "distance_mm": 5})"}),
              AllOf(HasSubstr("so near"), HasSubstr("expected at least")));
  EXPECT_THAT(refusal({R"(inverse.light={"type": "parallel", "tilt_deg": 120})"}),
              HasSubstr("would not enter through the front"));
  EXPECT_THAT(refusal({"inverse.band_nm=400"}),
              AllOf(HasSubstr("the light would have 350 to 750 nm"), HasSubstr("wavelength_nm of 580")));
  EXPECT_THAT(refusal({"inverse.size_mm=[10, 10]", "inverse.thickness_mm=40",
                       R"(inverse.light={"type": "parallel", "tilt_deg": 30})"}),
              AllOf(HasSubstr("/inverse/light: comes so much from the side"), HasSubstr("a smaller thickness_mm")));
  // Straight on it may also be that some facets reach no receiver: others do.
  EXPECT_NO_THROW(inverse::make_plan(read({"inverse.receiver_mm=[10, 10]", "inverse.receivers.0.distance_mm=30"})));
  const Layout parallel = inverse::make_plan(read()).design->layout,
               tilted =
                   inverse::make_plan(read({R"(inverse.light={"type": "parallel", "tilt_deg": 10, "turn_deg": 90})"}))
                       .design->layout,
               lamp =
                   inverse::make_plan(read({R"(inverse.light={"type": "point", "distance_mm": 500})"})).design->layout;
  EXPECT_FALSE(parallel.light.facets); // left out: one direction for all
  EXPECT_NEAR(tilted.incoming()[0].sines.y, std::sin(3.14159265 / 18), 1e-6);
  EXPECT_LT(lamp.incoming()[0].sines.x, -0.05);
  // A constant index has no colours; a dispersive one has them only where the light has a band.
  EXPECT_FALSE(inverse::make_plan(read({"inverse.band_nm=100"})).design->layout.spectrum);
  EXPECT_FALSE(inverse::make_plan(read({"inverse.index=N-SF11"})).design->layout.spectrum);
  EXPECT_TRUE(inverse::make_plan(read({"inverse.index=N-SF11", "inverse.band_nm=100"})).design->layout.spectrum);
}

// A receiver of 600 mm over 50 mm: the corners of its ring are 0.3 * 600 - 50 mm beside an object of 100 mm.
TEST_F(InverseSettings, SlopesThatNoRefractionReaches) {
  const std::string line = refusal({"inverse.receiver_mm=[600, 600]", "inverse.receivers.0.distance_mm=50"});
  EXPECT_THAT(line, AllOf(HasSubstr("own.json#/inverse/receivers/0/distance_mm: light must reach"),
                          HasSubstr("an index of 1.5 bends it by a slope of 1.06 at most"),
                          HasSubstr("choose a distance of at least")));
  EXPECT_NO_THROW(inverse::make_plan(read({"inverse.receiver_mm=[600, 600]", "inverse.receivers.0.distance_mm=200"})));
}

TEST_F(InverseSettings, ToolsThatDoNotFit) {
  const auto of_tool = [&](const char* radius) {
    return refusal({"inverse.facets=[50, 40]", std::string("inverse.tool_radius_mm=") + radius});
  };
  EXPECT_THAT(
      of_tool("51"),
      HasSubstr("own.json#/inverse/tool_radius_mm: is 51 mm, a tool that is wider than the object of 100 x 100 mm"));
  EXPECT_THAT(of_tool("1.5"),
              AllOf(HasSubstr("wider than a facet of 2 x 2.5 mm; expected at most 1 mm"), HasSubstr("33 x 33 facets")));
  EXPECT_NO_THROW(inverse::make_plan(read({"inverse.facets=[50, 40]", "inverse.tool_radius_mm=1"})));
}

TEST_F(InverseSettings, Drawings) {
  EXPECT_THAT(refusal({"inverse.receivers.0.picture.inner=0.4"}), HasSubstr("is 0.4, and the outer radius 0.3"));
  EXPECT_THAT(refusal({R"(inverse.receivers.0.picture={"type": "star", "count": 1})"}),
              HasSubstr("a star of at least 2 points"));
  EXPECT_THAT(refusal({R"(inverse.receivers.0.picture={"type": "square"})"}), HasSubstr("square"));
  EXPECT_THAT(refusal({R"(inverse.receivers.0.picture={"type": "ring", "inner": 1.5, "radius": 1.9})"}),
              HasSubstr("leaves every cell of the receiver dark"));
}

TEST_F(InverseSettings, WordsThatTheFontIsNotAskedFor) {
  for (const char* text : {"Grüße", "two\\nlines"})
    EXPECT_THAT(refusal({fmt::format(R"(inverse.receivers.0.picture={{"type": "text", "text": "{}"}})", text)}),
                AllOf(HasSubstr(": is \""), HasSubstr("only printable ASCII is drawn")));
}

TEST_F(InverseSettings, WhatTheChosenMethodHasNot) {
  EXPECT_THAT(refusal({"inverse.method=thesis", "inverse.receivers.0.weight=2"}),
              HasSubstr("weight=2: is 2, and the method 'thesis'"));
  EXPECT_THAT(refusal({R"(inverse.receivers=[{"distance_mm": 100, "picture": {"type": "disc"}}])", "inverse.frames=2"}),
              HasSubstr("frames=2: is 2, and there is one receiver"));
}

TEST_F(InverseSettings, PictureFiles) {
  EXPECT_THAT(refusal({"inverse.receivers.0.picture=no-such.png"}), HasSubstr("no-such.png"));
  EXPECT_THAT(refusal_of_picture(4, 4, std::vector<float>(16, 0.0f)), HasSubstr("p.exr: is black all over"));
  EXPECT_THAT(refusal_of_picture(4, 4, std::vector<float>(16, 1.0f)), HasSubstr("p.exr: is one grey all over"));
  EXPECT_THAT(refusal_of_picture(1, 1, {1.0f}), HasSubstr("is one grey all over"));
  EXPECT_THAT(refusal_of_picture(2, 1, {1.0f, -1.0f}), HasSubstr("negative or not a number"));
  EXPECT_THAT(refusal_of_picture(2, 1, {1.0f, std::numeric_limits<float>::quiet_NaN()}),
              HasSubstr("negative or not a number"));
}

TEST_F(InverseSettings, ConstantsOfTheThesis) {
  EXPECT_THAT(refusal({"inverse.thesis.draws=0"}), HasSubstr("expected a whole number from 1 to 1024"));
  EXPECT_THAT(refusal({"inverse.thesis.cooling=1.5"}), HasSubstr("expected a number from 0 to 1"));
  EXPECT_THAT(refusal({"inverse.thesis.temperature=-1"}), HasSubstr("expected a number from 0 to 1"));
  EXPECT_THAT(refusal({"inverse.thesis.size_limit=1"}), HasSubstr("expected a number from 0 to 0.9"));
  EXPECT_THAT(refusal({"inverse.thesis.ratio_limit=0.5"}), HasSubstr("expected a number from 1 to 1000"));
  EXPECT_THAT(refusal({"inverse.thesis.adjust=all"}), AllOf(HasSubstr("convergence"), HasSubstr("each")));
  EXPECT_THAT(refusal({"inverse.thesis.coling=0.5"}), HasSubstr("cooling"));
  EXPECT_THAT(refusal({"inverse.method=theses"}), HasSubstr("thesis"));
}

// Facets of 0.78 mm; a cell of 1.56 mm over 100 mm is a slope of 0.0156, which takes a gradient of 0.0312 and 0.0345 mm
// of relief.
TEST_F(InverseSettings, ConstraintsOfAWorkshop) {
  EXPECT_THAT(refusal({"inverse.min_thickness_mm=10"}),
              AllOf(HasSubstr("/inverse/min_thickness_mm: is 10 mm, and the object is 10 mm thick"),
                    HasSubstr("a thickness_mm above 10")));
  EXPECT_THAT(
      refusal({"inverse.max_relief_mm=0.03"}),
      AllOf(HasSubstr("/inverse/max_relief_mm: lets facets of 0.7812 x 0.7812 mm move light by 1.36 mm over 100 mm"),
            HasSubstr("less than a cell of 1.56 mm"), HasSubstr("a relief of at least 0.0345 mm")));
  EXPECT_NO_THROW(inverse::make_plan(read({"inverse.max_relief_mm=0.0346"})));
  EXPECT_THAT(refusal({"inverse.min_thickness_mm=9.99"}), HasSubstr("/inverse/min_thickness_mm: lets facets"));
  EXPECT_THAT(refusal({"inverse.max_slope_deg=1.7"}),
              AllOf(HasSubstr("/inverse/max_slope_deg: lets facets"), HasSubstr("expected at least 1.79 degrees")));
  EXPECT_NO_THROW(inverse::make_plan(read({"inverse.max_slope_deg=1.8"})));
  EXPECT_THAT(
      refusal(
          {"inverse.receiver_mm=[200, 200]", "inverse.receivers.0.picture.radius=0.49", "inverse.max_slope_deg=10"}),
      AllOf(HasSubstr("light must reach"), HasSubstr("the constraints on the facets let it have a slope of 0.08")));
  EXPECT_THAT(refusal({"inverse.heights=high"}), HasSubstr("flat"));
  EXPECT_THAT(refusal({"inverse.smoothing_normals=1", "inverse.method=thesis"}),
              HasSubstr("choose the method 'assign'"));
  EXPECT_THAT(refusal({"inverse.heights=free", "inverse.method=thesis"}), HasSubstr("choose the method 'assign'"));
}

// A tilt of 20 degrees bends light by asin(1.5 sin 20) - 20 = 10.87 degrees; half a relief of 0.4 mm over half a
// diagonal of 0.552 mm.
TEST_F(InverseSettings, ConstraintsLimitTheSlopes) {
  const auto limit = [&](const preset::Overrides& set) {
    return usable_slope(inverse::make_plan(read(set)).design->layout);
  };
  EXPECT_NEAR(limit({"inverse.max_slope_deg=20"}), std::tan(10.866 * 3.14159265 / 180), 1e-5);
  const double tilt = std::atan(0.2 / (0.78125 * std::sqrt(0.5)));
  EXPECT_NEAR(limit({"inverse.max_relief_mm=0.4"}), std::tan(std::asin(1.5 * std::sin(tilt)) - tilt), 1e-9);
  EXPECT_NEAR(limit({"inverse.min_thickness_mm=9.8"}), limit({"inverse.max_relief_mm=0.4"}), 1e-9);
  EXPECT_NEAR(limit({}), inverse::usable_slope(1.5), 1e-12);
}

TEST_F(InverseSettings, WhatThisEngineHasNot) {
  EXPECT_THAT(refusal({R"(scene.lights=[{"type": "point"}])"}), HasSubstr("has no meaning for the engine 'inverse'"));
  EXPECT_THAT(refusal({"stop.error=0.1"}), HasSubstr("makes no estimate of its error"));
  EXPECT_THAT(refusal({"inverse.facets=[2000, 10]"}), HasSubstr("from 1 to 1024"));
}

// A file's pixels fall into cells by their parts, and keep their aspect: 2 x 1 pixels on a square receiver of 4 x 4
// cells fill its two middle rows.
TEST_F(InverseSettings, APictureFileFitsTheReceiver) {
  image::Image picture{2, 1, {"Y"}, {0.5f, 1.5f}};
  image::write_exr(folder.path() / "p.exr", picture);
  const auto plan = inverse::make_plan(
      read({"inverse.receivers.0.picture=" + (folder.path() / "p.exr").string(), "inverse.cells=[4, 4]"}));
  const double low = 0.5 / 8, high = 1.5 / 8;
  const std::vector<double> rows{0, 0, 0, 0, low, low, high, high, low, low, high, high, 0, 0, 0, 0};
  ASSERT_EQ(plan.design->targets[0].size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_NEAR(plan.design->targets[0][i], rows[i], 1e-6) << i;
}

// A disc of radius r covers pi r^2 of a receiver, and a gradient's mean is half its end.
TEST_F(InverseSettings, DrawingsCoverWhatTheyShould) {
  const auto lit = [&](const std::string& picture) {
    const auto target = inverse::make_plan(read({"inverse.receivers.0.picture=" + picture})).design->targets[0];
    double most = 0;
    for (const double t : target) most = std::max(most, t);
    return 1 / (most * 4096); // the mean where the brightest cell is 1
  };
  EXPECT_NEAR(lit(R"({"type": "disc", "radius": 0.25})"), 3.14159 / 16, 1e-3);
  EXPECT_NEAR(lit(R"({"type": "ring", "radius": 0.4, "inner": 0.2})"), 3.14159 * 0.12, 1e-3);
  EXPECT_NEAR(lit(R"({"type": "cross", "length": 0.7, "width": 0.15})"), 2 * 0.7 * 0.15 - 0.15 * 0.15, 3e-3);
  EXPECT_NEAR(lit(R"({"type": "bars", "length": 0.5, "width": 0.1, "count": 3, "turn_deg": 90})"), 0.15, 3e-3);
  EXPECT_NEAR(lit(R"({"type": "gradient"})"), 0.5 / (127.0 / 128), 1e-3);
  EXPECT_NEAR(lit(R"({"type": "star", "count": 4, "radius": 0.4, "inner": 0.2})"),
              8 * 0.5 * 0.4 * 0.2 * std::sin(3.14159 / 4), 1e-3);
  EXPECT_NEAR(lit(R"({"type": "disc", "radius": 0.25, "background": 0.5})"), 0.5 + 0.5 * 3.14159 / 16, 1e-3);
}

} // namespace nephroid::settings_test
