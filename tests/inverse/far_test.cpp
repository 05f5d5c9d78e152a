// SPDX-License-Identifier: Apache-2.0
// Intensities over directions: targets, units, the surface that makes them, files and refusals.
#include "inverse/far/cast.h"
#include "inverse/far/intensity.h"
#include "inverse/judge.h"
#include "inverse/lens/lens.h"
#include "inverse/plan.h"
#include "preset/read.h"
#include "scene/photometry.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

#include <glm/gtc/constants.hpp>

#include <numeric>

namespace nephroid::far_test {

using namespace inverse;

class Far : public testing::Test {
protected:
  test::TemporaryFolder folder;

  static preset::Preset read(const std::string& far, const std::string& more = "",
                             const preset::Overrides& overrides = {}) {
    const std::string lamp =
        more.find("\"light\"") == std::string::npos ? R"(, "light": {"type": "point", "distance_mm": 300})" : "";
    return preset::parse_preset(R"({"engine": "inverse", "inverse": {"far": )" + far +
                                    R"(, "method": "lens", "size_mm": [60, 60], "facets": [64, 64], "cells": [32, 32],
                                     "thickness_mm": 20, "index": 1.5, "mesh_error": 0.2)" +
                                    lamp + more + "}}",
                                "own.json", overrides);
  }
  static std::string refusal(const std::string& far, const std::string& more = "",
                             const preset::Overrides& overrides = {}) {
    return test::refusal_of([&] { make_plan(read(far, more, overrides)); });
  }
  static std::vector<double> judged(const Layout& layout, const Solid& solid) {
    Judge judge(test::shared_context(), layout, solid, 1);
    while (!judge.finished()) judge.advance();
    return judge.light(0);
  }
  static std::string bytes(const job::Snapshot& made, const std::string& name) {
    ByteStore all;
    for (const auto& file : made.files)
      if (file.name == name) file.write(all);
    return {reinterpret_cast<const char*>(all.bytes().data()), all.bytes().size()};
  }
  /// An IES file whose light is in a spot at gamma = 20, C = `c`.
  std::string spot(double c, double sign = 1) {
    std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 91 73 1 2 0 0 0\n1 1 0\n";
    for (int i = 0; i <= 90; ++i) text += fmt::format("{} ", i);
    for (int i = 0; i <= 72; ++i) text += fmt::format("\n{}", 5 * i);
    for (int i = 0; i <= 72; ++i)
      for (int g = 0; g <= 90; ++g) {
        const double away = std::hypot(g - 20, std::remainder(5.0 * i - c, 360) * std::sin(glm::radians(1.0 * g)));
        text += fmt::format("\n{}", away < 6 ? sign * 500 : 0);
      }
    return folder.write("spot.ies", text);
  }
};

TEST_F(Far, CellsSeeAllDirectionsOnce) {
  const Layout layout = make_layout(read(R"({"type": "rectangle", "size_deg": [120, 80]})"));
  double sum = 0;
  for (std::size_t c = 0; c < layout.cell_count(); ++c) sum += steradians(layout, c);
  const glm::dvec2 half = glm::atan(layout.receiver / 2.0 / layout.distances.front());
  EXPECT_NEAR(sum, 4 * std::asin(std::sin(half.x) * std::sin(half.y)), 1e-6) << "of a pyramid";
}

TEST_F(Far, AnEvenRectangleIsEvenInIntensity) {
  const preset::Preset preset = read(R"({"type": "rectangle", "size_deg": [60, 40]})");
  const Layout layout = make_layout(preset);
  std::vector<std::string> notes;
  const Target target = far_target(preset, layout, notes);
  EXPECT_NEAR(std::accumulate(target.begin(), target.end(), 0.0), 1, 1e-9);
  std::vector<double> within;
  for (std::size_t c = 0; c < target.size(); ++c) {
    const glm::dvec2 angle = glm::degrees(glm::atan(layout.middle_of_cell(c) / layout.distances.front()));
    if (std::abs(angle.x) < 27 && std::abs(angle.y) < 17) within.push_back(target[c] / steradians(layout, c));
    if (std::abs(angle.x) > 33 || std::abs(angle.y) > 23) {
      EXPECT_EQ(target[c], 0);
    }
  }
  const auto [least, most] = std::ranges::minmax(within);
  EXPECT_NEAR(least, most, 1e-9 * most);
}

/// A plane lit by a batwing gets E = I cos^3 / h^2, the same everywhere.
TEST_F(Far, ABatwingLightsAPlaneEvenly) {
  const preset::Preset preset = read(R"({"type": "batwing", "size_deg": [70, 70]})");
  const Layout layout = make_layout(preset);
  std::vector<std::string> notes;
  const Target target = far_target(preset, layout, notes); // cells are parts of such a plane
  std::vector<double> within;
  for (std::size_t c = 0; c < target.size(); ++c)
    if (glm::length(layout.middle_of_cell(c)) / layout.distances.front() < 0.6) within.push_back(target[c]);
  const auto [least, most] = std::ranges::minmax(within);
  EXPECT_NEAR(least, most, 2e-3 * most);
}

TEST_F(Far, ALuminaireIsAsItsFileSays) {
  const auto brightest = [&](double c) {
    const preset::Preset preset = read(R"({"type": "luminaire", "file": ")" + spot(c) + "\"}");
    const Layout layout = make_layout(preset);
    std::vector<std::string> notes;
    const Target target = far_target(preset, layout, notes);
    glm::dvec2 mean(0);
    for (std::size_t i = 0; i < target.size(); ++i)
      mean += target[i] * glm::degrees(glm::atan(layout.middle_of_cell(i) / layout.distances.front()));
    return mean;
  };
  EXPECT_NEAR(brightest(0).x, 20, 0.7) << "C = 0 is to the right";
  EXPECT_NEAR(brightest(0).y, 0, 0.1);
  EXPECT_NEAR(brightest(90).y, 20, 0.7) << "C = 90 is up";
  EXPECT_NEAR(brightest(90).x, 0, 0.1);
}

/// A gradient rises by equal steps of the angle, from nothing at the left edge.
TEST_F(Far, APictureIsEvenInAngles) {
  const preset::Preset preset =
      read(R"({"type": "picture", "size_deg": [80, 60], "picture": {"type": "gradient"}})", "", {"inverse.index=2"});
  const Layout layout = make_layout(preset);
  std::vector<std::string> notes;
  const Target target = far_target(preset, layout, notes);
  const auto intensity = [&](std::size_t column) {
    const std::size_t c = 16 * 32 + column;
    const double angle = glm::degrees(std::atan(layout.middle_of_cell(c).x / layout.distances.front()));
    return std::pair(angle, target[c] / steradians(layout, c));
  };
  const auto [a, dim] = intensity(8);
  const auto [b, bright] = intensity(24);
  EXPECT_NEAR(bright / dim, (b + 40) / (a + 40), 0.06 * bright / dim);
}

/// From a point, through a square front and into a small rectangle: light is even on both, so the map is linear.
TEST_F(Far, APointInARectangleIsMappedLinearly) {
  const preset::Preset preset = read(R"({"type": "rectangle", "size_deg": [24, 12]})");
  const Layout layout = make_layout(preset);
  std::vector<std::string> notes;
  const Target target = far_target(preset, layout, notes);
  Lens lens(layout, target, 0.3, Location("own.json") / "inverse");
  while (!lens.finished() && lens.steps() < lens.most()) lens.advance();
  const glm::dvec2 edge = glm::tan(glm::radians(glm::dvec2(12, 6)));
  double worst = 0, squares = 0;
  for (std::size_t i = 0; i < layout.facet_count(); ++i) {
    const glm::dvec2 expected = edge * layout.middle(i) / 30.0;
    const double off = glm::length((lens.slopes()[i] - expected) / edge);
    if (glm::length(layout.middle(i)) < 25) worst = std::max(worst, off);
    squares += off * off;
  }
  EXPECT_LT(worst, 0.06) << "of half the rectangle";
  EXPECT_LT(std::sqrt(squares / static_cast<double>(layout.facet_count())), 0.05);
}

/// A plate with parallel faces leaves a lamp's directions: 1000 lm over 4 pi, less what both faces reflect.
TEST_F(Far, APlateKeepsALampsCandela) {
  const preset::Preset preset = read(R"({"type": "rectangle", "size_deg": [8, 8]})");
  const Layout layout = make_layout(preset);
  std::vector<std::string> notes;
  const Target target = far_target(preset, layout, notes);
  const Lens flat(layout, target, 0.3, Location("own.json") / "inverse");
  const CastIntensity cast = cast_of(preset, layout, target, judged(layout, flat.solid()), 1);
  const double through = 0.96 * 0.96, expected = 1000 / (4 * glm::pi<double>()) * through;
  EXPECT_NEAR(at_tangent(layout, cast.cast, {0, 0}), expected, 0.04 * expected) << "noise of one cell";
  const double mean = std::accumulate(cast.cast.begin(), cast.cast.end(), 0.0) / static_cast<double>(target.size());
  EXPECT_NEAR(mean, expected, 5e-3 * expected);
  EXPECT_NEAR(cast.on_front, 4 * std::asin(30 * 30 / (30.0 * 30 + 300 * 300)) / (4 * glm::pi<double>()), 1e-6);
  EXPECT_NEAR(cast.on_target, 4 * std::asin(std::pow(std::sin(glm::radians(4.0)), 2)) * mean / (1000 * cast.on_front),
              0.04 * cast.on_target)
      << "the target is whole cells";
}

/// A lamp by Lambert's law, small and on the axis of a round front, sends sin^2 of the angle to its rim into it.
TEST_F(Far, LambertsLawOnTheFront) {
  const preset::Preset preset = read(R"({"type": "ellipse", "size_deg": [20, 20]})",
                                     R"(, "outline": "round", "light": {"type": "area", "size_mm": [0.1, 0.1],
                                       "distance_mm": 60})");
  EXPECT_NEAR(part_on_front(make_layout(preset), settings(preset)), 30.0 * 30 / (30.0 * 30 + 60 * 60), 2e-3);
}

TEST_F(Far, FilesReadAsTheyWereCast) {
  const preset::Preset preset = read(R"({"type": "ellipse", "size_deg": [40, 20], "edge_deg": 6, "lumens": 500})");
  const Layout layout = make_layout(preset);
  std::vector<std::string> notes;
  const Target target = far_target(preset, layout, notes);
  std::vector<double> light;
  for (const double t : target) light.push_back(0.8 * t * static_cast<double>(layout.facet_count()));
  const CastIntensity cast = cast_of(preset, layout, target, light, 0.8);
  EXPECT_NEAR(cast.rms, 0, 1e-9);
  EXPECT_NEAR(cast.uniformity, 1, 1e-9);
  EXPECT_NEAR(cast.on_target, 0.8, 2e-3);
  EXPECT_NEAR(cast.of_sent, 1, 3e-3);
  job::Snapshot made;
  add_intensity_files(made, cast, "an ellipse");
  for (const char* name : {"intensity.ies", "intensity.ldt"}) {
    const scene::Photometry read = scene::load_photometry(folder.write(name, bytes(made, name)));
    const double lumens = 500 * cast.on_front * 0.8, unit = std::string(name).ends_with("ldt") ? 1000 / lumens : 1;
    EXPECT_NEAR(read.lumens, lumens, 0.01 * lumens) << name;
    for (const auto& [gamma, c] : {std::pair{0.0, 0.0}, {15.0, 0.0}, {15.0, 180.0}, {8.0, 90.0}, {8.0, 270.0}}) {
      const double turn = glm::radians(c), t = std::tan(glm::radians(gamma)),
                   right = at_tangent(layout, cast.cast, t * glm::dvec2(std::cos(turn), std::sin(turn)));
      EXPECT_NEAR(scene::intensity(read, gamma, c) / unit, right, 0.02 * *std::ranges::max_element(cast.cast))
          << name << gamma << ' ' << c;
    }
  }
  EXPECT_THAT(bytes(made, "intensity.md"), HasSubstr("| `lumens` | 500 lm | of the lamp |"));
  EXPECT_THAT(bytes(made, "intensity.svg"), HasSubstr("dashed: wanted"));
}

/// The size of a lamp blurs the intensity, and the lens makes up for some of it.
TEST_F(Far, ALargeLampIsAllowedFor) {
  const preset::Preset preset = read(R"({"type": "ellipse", "size_deg": [50, 40], "edge_deg": 10})",
                                     R"(, "light": {"type": "area", "size_mm": [12, 12], "distance_mm": 150})");
  const Layout layout = make_layout(preset);
  std::vector<std::string> notes;
  const Target target = far_target(preset, layout, notes);
  Lens lens(layout, target, 0.3, Location("own.json") / "inverse");
  while (lens.steps() < 1) lens.advance();
  const double first = lens.costs().front().rel_l2;
  while (!lens.finished() && lens.steps() < lens.most()) lens.advance();
  EXPECT_LT(lens.costs().front().rel_l2, 0.6 * first);
  const CastIntensity cast = cast_of(preset, layout, target, judged(layout, lens.solid()), 1);
  EXPECT_LT(cast.rms, 0.06);
  EXPECT_GT(cast.on_target, 0.75) << "the sides of an object 20 mm thick stop a sixth, both faces reflect 8 %";
}

TEST_F(Far, Refusals) {
  const std::string plain = R"({"type": "rectangle", "size_deg": [20, 20]})";
  EXPECT_NO_THROW(make_plan(read(plain)));
  EXPECT_THAT(refusal(plain, R"(, "light": {"type": "area", "size_mm": [61, 10]})"),
              AllOf(HasSubstr("#/inverse/light/size_mm: is 61 x 10 mm, and the object 60 x 60 mm"),
                    HasSubstr("choose a smaller lamp")));
  EXPECT_THAT(refusal(plain, R"(, "receivers": [{"distance_mm": 100, "picture": {"type": "ring"}}])"),
              HasSubstr("#/inverse/receivers: stand beside 'far'"));
  EXPECT_THAT(refusal(plain, R"(, "receiver_mm": [50, 50])"), HasSubstr("#/inverse/receiver_mm"));
  EXPECT_THAT(refusal(plain, "", {"inverse.method=thesis"}), HasSubstr("choose the method 'lens' or 'assign'"));
  EXPECT_THAT(refusal(R"({"type": "rectangle", "size_deg": [120, 20]})"),
              AllOf(HasSubstr("#/inverse/far: light must go"), HasSubstr("choose a narrower target")));
  EXPECT_THAT(refusal(R"({"type": "rectangle", "size_deg": [0.1, 0.1]})"), HasSubstr("choose fewer cells"));
  EXPECT_THAT(refusal(R"({"type": "rectangle", "candela": 10})"), HasSubstr("#/inverse/far/lumens: is not given"));
  EXPECT_THAT(refusal(R"({"type": "rectangle", "candela": 1e5, "lumens": 1000})"),
              AllOf(HasSubstr("#/inverse/far/candela: asks for "), HasSubstr("of the lamp's 1000 lm 3."),
                    HasSubstr("expected at most ")));
  EXPECT_THAT(refusal(R"({"type": "luminaire", "file": ")" + spot(0, -1) + "\"}"),
              HasSubstr("has an intensity of -500"));
  EXPECT_THAT(refusal(R"({"type": "luminaire", "lumens": 100, "file": ")" + spot(0) + "\"}"),
              AllOf(HasSubstr("#/inverse/far/file: asks for "), HasSubstr("remove 'lumens'")));
  const std::string cut = folder.write("cut.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 10 1 1 2");
  EXPECT_THAT(refusal(R"({"type": "luminaire", "file": ")" + cut + "\"}"), HasSubstr("the file ends before"));
  EXPECT_THAT(refusal(R"({"type": "luminaire", "file": "none.ies"})"), HasSubstr("none.ies"));
  EXPECT_THAT(refusal(R"({"type": "picture", "size_deg": [20, 20], "picture": {"type": "ring", "radius": 0.1}})"),
              HasSubstr("#/inverse/far/picture/inner"));
}

} // namespace nephroid::far_test
