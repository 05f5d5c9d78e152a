// SPDX-License-Identifier: Apache-2.0
// Smooth surfaces for one picture, against maps that are known.
#include "inverse/bending.h"
#include "inverse/judge.h"
#include "inverse/lens/lens.h"
#include "inverse/light.h"
#include "tests/support/render.h"
#include "tests/support/saved_jobs.h"

#include <glm/gtc/constants.hpp>

namespace nephroid::lens_test {

using inverse::Grid;

const Location own = Location("p.json") / "inverse";

TEST(Poisson, SolvesForACosine) {
  const int columns = 24, rows = 16;
  const glm::dvec2 spacing{0.5, 0.25};
  Grid wave(rows, columns);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      wave(y, x) =
          std::cos(glm::pi<double>() * 3 * (x + 0.5) / columns) * std::cos(glm::pi<double>() * 2 * (y + 0.5) / rows);
  const double value = 2 * (1 - std::cos(glm::pi<double>() * 3 / columns)) / 0.25 +
                       2 * (1 - std::cos(glm::pi<double>() * 2 / rows)) / 0.0625;
  const Grid solved = inverse::Poisson(columns, rows, spacing).solve(wave * value + Grid::Constant(rows, columns, 7));
  EXPECT_LT((solved - wave).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Conjugate, IsTheLeastOverAllCells) {
  const int columns = 13, rows = 9;
  const double cell = 0.1;
  Grid f(rows, columns);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) f(y, x) = 0.3 * std::sin(1.7 * x * y) + 0.05 * x;
  const Grid found = inverse::conjugate(f, cell);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      double least = 1e9;
      for (int v = 0; v < rows; ++v)
        for (int u = 0; u < columns; ++u)
          least = std::min(least, cell * cell * ((x - u) * (x - u) + (y - v) * (y - v)) / 2 - f(v, u));
      EXPECT_NEAR(found(y, x), least, 1e-12);
    }
}

/// A rectangle of light goes into a smaller one by a map that is linear: the shortest way.
TEST(Transport, ShrinksARectangle) {
  Grid from = Grid::Ones(64, 96), to = Grid::Zero(64, 96);
  to.block(16, 24, 32, 48).setOnes();
  inverse::Transport transport(from, to);
  for (int i = 0; i < 40; ++i) transport.advance();
  double farthest = 0, sum = 0;
  for (int y = 1; y < 64; ++y)
    for (int x = 1; x < 96; ++x) {
      const glm::dvec2 expected{48 + (x - 48) / 2.0, 32 + (y - 32) / 2.0};
      const double off = glm::length(transport.map({x, y}) - expected);
      sum += off;
      if (x > 3 && x < 93 && y > 3 && y < 61)
        farthest = std::max(farthest, off); // the rim's corner is off by three cells
    }
  EXPECT_LT(farthest, 0.15) << "cells, where light moves by up to 29";
  EXPECT_LT(sum / (63 * 95), 0.02);
}

inverse::Target disc(const inverse::Layout& layout) {
  inverse::Target target;
  for (int y = 0; y < layout.cells.y; ++y)
    for (int x = 0; x < layout.cells.x; ++x) target.push_back(std::hypot(x - 14.5, y - 9.5) < 6 ? 1 : 0.1);
  const double sum = std::accumulate(target.begin(), target.end(), 0.0);
  for (double& t : target) t /= sum;
  return target;
}

class Lens : public testing::Test {
protected:
  static void advance_to(inverse::Lens& method, int steps) {
    while (method.steps() < steps) method.advance();
  }
  struct Designed {
    inverse::Cost believed, judged;
    double light;  ///< all that the judge has counted, of what enters
    double relief; ///< the relief that is asked for by the solid's
  };
  Designed designed(const inverse::Layout& lit) const {
    inverse::Lens method(lit, target, 0.3, own);
    while (!method.finished() && method.steps() < method.most()) method.advance();
    const inverse::Solid solid = method.solid();
    inverse::Judge judge(test::shared_context(), lit, solid, 1);
    while (!judge.finished()) judge.advance();
    const inverse::RayOutcomes outcomes = judge.outcomes();
    return {method.costs().front(), judge.costs({target}).front(), outcomes.sent + outcomes.reflected + outcomes.lost,
            method.relief() / solid.relief()};
  }

  inverse::Layout layout{.size = {60, 40},
                         .thickness = 12,
                         .facets = {120, 80},
                         .receiver = {60, 40},
                         .cells = {30, 20},
                         .distances = {150}};
  inverse::Target target = disc(layout);
  inverse::Lens lens{layout, target, 0.3, own};
};

TEST_F(Lens, IsJudgedAsItBelievesAndHasNoWalls) {
  const double flat = lens.costs().front().rel_l2;
  advance_to(lens, 1);
  const double transported = lens.costs().front().rel_l2;
  while (!lens.finished() && lens.steps() < lens.most()) lens.advance();
  const double believed = lens.costs().front().rel_l2;
  EXPECT_GT(flat, 0.5);
  EXPECT_LT(transported, 0.1);
  EXPECT_LT(believed, 0.85 * transported) << "corrected by the surface's own light";
  const inverse::Solid solid = lens.solid();
  EXPECT_EQ(solid.highest_wall, 0);
  EXPECT_EQ(std::count(solid.parts.begin(), solid.parts.end(), inverse::Part::wall), 0);
  inverse::Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  EXPECT_NEAR(judge.costs({target}).front().rel_l2, believed, 0.03);
  EXPECT_NEAR(judge.outcomes().sent + judge.outcomes().reflected + judge.outcomes().lost, 1, 1e-6);
}

// Cut within the transport, and between corrections.
TEST_F(Lens, GoesOnWithTheSameBits) {
  advance_to(lens, 4);
  for (const int cut : {10, 42}) {
    inverse::Lens first(layout, target, 0.3, own), second(layout, target, 0.3, own);
    for (int i = 0; i < cut; ++i) first.advance();
    ASSERT_TRUE(test::load<Archive>(second, test::saved<Archive>(first)));
    EXPECT_EQ(first.light(0), second.light(0));
    advance_to(second, 4);
    EXPECT_EQ(lens.light(0), second.light(0)) << cut;
  }
}

TEST_F(Lens, IsRefusedWhereItReachesTheFront) {
  layout.thickness = 0.2;
  advance_to(lens, 2);
  EXPECT_THAT(refusal_of([&] { lens.solid(); }),
              StartsWith("p.json#/inverse/thickness_mm: is 0.2 mm, and half of the lens's relief is "));
}

// What a workshop is told is the steepest of its triangles.
TEST_F(Lens, IsAsSteepAsItsTriangles) {
  advance_to(lens, 2);
  const inverse::Solid solid = lens.solid();
  double steepest = 0;
  for (std::size_t t = 0; t < solid.parts.size(); ++t)
    if (solid.parts[t] == inverse::Part::facet) {
      const auto corner = [&](int i) { return glm::dvec3(solid.mesh.positions[solid.mesh.triangles[t][i]]); };
      const glm::dvec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
      steepest = std::max(steepest, glm::degrees(std::atan2(glm::length(glm::dvec2(across)), std::abs(across.z))));
    }
  EXPECT_NEAR(solid.steepest_deg, steepest, 1e-3);
  layout.steepest = std::tan(glm::radians(solid.steepest_deg - 0.01));
  EXPECT_THROW(lens.solid(), Error) << "max_slope_deg";
}

// Both bend the light that they get to the same picture: tilted light falls beside the receiver, were it not bent back.
TEST_F(Lens, IsLitFromTheSideAndByALamp) {
  using inverse::Light;
  for (const Light& light :
       {Light{.tilt_deg = 5, .turn_deg = 30}, Light{.type = Light::Type::point, .distance_mm = 300},
        Light{.type = Light::Type::point, .distance_mm = 400, .offset_mm = {30, -20}}}) {
    inverse::Layout lit = layout;
    lit.thickness = 20;
    lit.light = inverse::make_illumination(lit, light, own);
    const Designed found = designed(lit);
    EXPECT_LT(found.judged.rel_l2, 0.07) << light.tilt_deg << " " << light.distance_mm;
    EXPECT_LT(found.judged.missed, 0.02);
    EXPECT_NEAR(found.judged.rel_l2, found.believed.rel_l2, 0.02);
  }
}

// A sun at 30 degrees, and the receiver where its light goes: the lens turns light as little as one straight before it.
TEST_F(Lens, MayHaveItsReceiverBeside) {
  inverse::Layout lit = layout;
  lit.offsets = {{150 * std::tan(glm::radians(30.0)), 0}};
  lit.light = inverse::make_illumination(lit, inverse::Light{.tilt_deg = 30}, own);
  const Designed found = designed(lit);
  EXPECT_LT(found.judged.rel_l2, 0.1);
  EXPECT_LT(found.judged.missed, 0.05);
  EXPECT_NEAR(found.judged.rel_l2, found.believed.rel_l2, 0.03);
}

// A round lens gets the light of a disc alone: what falls on its corners is not there. Receivers are smaller and larger
// than the object.
TEST_F(Lens, MayBeRoundAndOfAnotherSizeThanItsReceiver) {
  using inverse::Light;
  for (const auto& [round, light, receiver] :
       {std::tuple(true, Light{}, glm::dvec2(60, 40)),
        {true, Light{.tilt_deg = 5, .turn_deg = 30}, {60, 40}},
        {true, Light{.type = Light::Type::point, .distance_mm = 400, .offset_mm = {10, -5}}, {60, 40}},
        {true, Light{}, {40, 30}},
        {false, Light{}, {40, 30}},
        {false, Light{}, {90, 60}},
        {true, Light{}, {90, 60}}}) {
    inverse::Layout lit = layout;
    lit.thickness = 20;
    lit.round = round;
    lit.receiver = receiver;
    lit.light = inverse::make_illumination(lit, light, own);
    const Designed found = designed(lit);
    const std::string what = fmt::format("{} {} {} {}", round, light.tilt_deg, light.distance_mm, receiver.x);
    EXPECT_LT(found.judged.rel_l2, 0.1) << what;
    EXPECT_LT(found.judged.missed, 0.02) << what;
    EXPECT_NEAR(found.judged.rel_l2, found.believed.rel_l2, 0.03) << what;
    EXPECT_NEAR(found.light, 1, light.type == Light::Type::point ? 1e-3 : 1e-4) << what;
    EXPECT_NEAR(found.relief, 1, 0.05) << what;
  }
}

// The ellipse within 60 x 40.
TEST(PartWithin, IsAnEllipsesArea) {
  const inverse::Layout layout{.size = {60, 40}, .round = true, .facets = {33, 20}};
  double area = 0;
  for (std::size_t i = 0; i < layout.facet_count(); ++i)
    area += inverse::part_within(layout, layout.middle(i), layout.facet()) * layout.facet().x * layout.facet().y;
  EXPECT_NEAR(area / (glm::pi<double>() * 30 * 20), 1, 2e-3);
}

TEST_F(Lens, IsRefusedWhereItsMeshIsTooLarge) {
  inverse::Lens fine(layout, target, 0.001, own);
  advance_to(fine, 1);
  const std::string said = refusal_of([&] { fine.solid(); });
  EXPECT_THAT(said, StartsWith("p.json#/inverse/mesh_error: is 0.001, for which the lens takes some "));
  EXPECT_THAT(said, HasSubstr(" million triangles, an STL of "));
}

TEST_F(Lens, KeepsAWorkshopsRelief) {
  layout.band = 0.1;
  advance_to(lens, 2);
  EXPECT_THROW(lens.solid(), Error);
}

// Of such an object the grid would have less than a row; and of so fine a picture it has no cell's middle in the only
// one that is lit.
TEST_F(Lens, HasNarrowObjectsAndFinePictures) {
  layout.size = layout.receiver = {600, 0.5};
  layout.facets = {120, 1};
  layout.cells = {1000, 2};
  target.assign(2000, 0);
  target[500] = 1;
  inverse::Lens narrow(layout, target, 0.3, own);
  advance_to(narrow, 2);
  EXPECT_TRUE(std::isfinite(narrow.costs().front().rel_l2));
}

TEST(FacetSlope, TakesBackFacetGradient) {
  for (const double n : {1.5, 2.4, 0.7})
    for (const glm::dvec2& slope : {glm::dvec2(0.1, -0.3), glm::dvec2(0), glm::dvec2(-0.4, 0.2)})
      EXPECT_LT(glm::length(inverse::facet_slope(inverse::facet_gradient(slope, n), n) - slope), 1e-12) << n;
}

} // namespace nephroid::lens_test
