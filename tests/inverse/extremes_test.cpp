// SPDX-License-Identifier: Apache-2.0
// Extreme objects, lights and receivers of engine 3. docs/notebook/extremes.md sums it up.
#include "inverse/job.h"
#include "inverse/report.h"
#include "tests/support/extremes.h"

#include <nlohmann/json.hpp>

namespace nephroid::extremes_test {

using Json = nlohmann::json;

/// A ring and a disc by 32 x 32 facets.
Json ring_and_disc() {
  return Json::parse(
      R"({"size_mm": [100, 100], "thickness_mm": 10, "facets": [32, 32], "cells": [16, 16], "index": 1.5, "receivers": [
    {"distance_mm": 100, "picture": {"type": "ring", "radius": 0.4, "inner": 0.2}}, {"distance_mm": 200, "picture": {"type": "disc"}}]})");
}
Json with(const std::string& merged) {
  Json settings = ring_and_disc();
  settings.merge_patch(Json::parse(merged));
  return settings;
}
/// One receiver.
Json alone(const std::string& receiver, const std::string& merged = "{}") {
  Json settings = with(merged);
  settings["receivers"] = {Json::parse(receiver)};
  return settings;
}

inverse::InversePlan plan_of(const Json& settings, preset::Preset& p) {
  const Json whole{
      {"engine", "inverse"}, {"unit", "mm"}, {"scene", {{"camera", Json::object()}}}, {"inverse", settings}};
  p = preset::parse_preset(whole.dump(), "p.json");
  return inverse::make_plan(p);
}
job::Snapshot design(const Json& settings) {
  preset::Preset p;
  const inverse::InversePlan plan = plan_of(settings, p);
  const auto job = inverse::make_job(p, plan, test::shared_context());
  while (!job->finished()) job->advance();
  return job->snapshot();
}
double judged(const Json& settings, const char* what = "cost") { return job::scalar(design(settings), "judged", what); }

Outcome refuses(const Json& settings, const std::string& line) {
  preset::Preset p;
  return refused([&] { plan_of(settings, p); }, line);
}
/// Every length is `factor` times as large, but for that of waves, which are left out.
Outcome same_picture_at(double factor) {
  Json settings = with(R"({"diffraction": false})");
  settings["size_mm"] = {100 * factor, 100 * factor};
  settings["thickness_mm"] = 10 * factor;
  for (Json& receiver : settings["receivers"]) receiver["distance_mm"] = receiver["distance_mm"].get<double>() * factor;
  return near(judged(settings, "rel_l2"), judged(with(R"({"diffraction": false})"), "rel_l2"),
              2e-3); // single precision finds other slopes
}
/// The traced mesh casts what the search believes.
Outcome as_believed(const Json& settings, double tolerance) {
  const job::Snapshot made = design(settings);
  return near(job::scalar(made, "judged", "rel_l2"), job::scalar(made, "believed", "rel_l2"), tolerance);
}
/// All light that is sent arrives: none is beside the receivers, none is lost.
Outcome loses_at_most(const Json& settings, double part) {
  const job::Snapshot made = design(settings);
  return at_most(job::scalar(made, "judged", "missed") + job::scalar(made, "light", "lost"), part);
}

const std::vector<Extreme> objects{
    {"Micrometres", "an object of 0.1 mm", "scale invariance: the pictures of 100 mm",
     [] { return same_picture_at(1e-3); }},
    {"Metres", "an object of 100 m", "the same", [] { return same_picture_at(1e3); }},
    {"IndexNextToOne", "n = 1.001", "facets so steep need a thicker object",
     [] {
       return refuses(
           with(R"({"index": 1.001})"),
           "p.json#/inverse/thickness_mm: is 10 mm, and facets of 3.125 x 3.125 mm can reach 31.16 mm from their "
           "middle; "
           "expected more than "
           "that, so that the object holds together; choose more facets, a larger value here or another index");
     }},
    {"IndexOne", "n = 1", "nothing is there",
     [] {
       return refuses(with(R"({"index": 1})"),
                      "p.json#/inverse/index: is 1, which bends no light; expected another index, such as 1.5");
     }},
    {"IndexOfFour", "n = 4", "footprints beside rays", [] { return as_believed(with(R"({"index": 4})"), 0.005); }},
    {"IndexBelow", "n = 0.7, a hole in a block", "footprints, which know no walls, beside rays",
     [] { return as_believed(with(R"({"index": 0.7, "thickness_mm": 40, "facets": [64, 64]})"), 0.05); }},
    {"TallFacets", "128 x 16 facets, 8 times as high as wide", "footprints beside rays",
     [] { return as_believed(with(R"({"facets": [128, 16]})"), 0.005); }},
    {"ThinRelief", "a relief of at most 1 um", "no facet fits that sends light to the picture",
     [] {
       return refuses(
           with(R"({"max_relief_mm": 0.001})"),
           "p.json#/inverse/max_relief_mm: lets facets of 3.125 x 3.125 mm move light by 0.0226 mm over 200 mm, less "
           "than a "
           "cell of 6.25 mm; expected room for a relief of at least 0.276 mm; choose a deeper relief or more facets");
     }},
};
const std::vector<Extreme> screens{
    {"NextToTheFacets", "a receiver at 0.01 mm", "facets reach beyond it",
     [] {
       return refuses(alone(R"({"distance_mm": 0.01, "picture": {"type": "disc"}})"),
                      "p.json#/inverse/receivers/0/distance_mm: is 0.01 mm, and facets of 3.125 x 3.125 mm can reach "
                      "1.975 mm from their "
                      "middle; expected more than that, so that the receiver is free of the object; choose more "
                      "facets, a larger value "
                      "here or another index");
     }},
    {"FiftyMetresAway", "a receiver of 100 mm at 50 m: slopes up to 1e-3", "footprints beside rays",
     [] {
       return as_believed(alone(R"({"distance_mm": 5e4, "picture": {"type": "disc"}})", R"({"diffraction": false})"),
                          0.06);
     }},
    {"AKilometreAway", "the same at 1 km: slopes of 5e-5", "the solid cannot aim so well",
     [] {
       return refuses(alone(R"({"distance_mm": 1e6, "picture": {"type": "disc"}})"),
                      "p.json#/inverse/receivers/0/distance_mm: is 1000000 mm, where 5e-05 in its slope, the finest "
                      "that facets are made, moves light "
                      "by 50 mm over a cell of 6.25 mm; expected at most 62500 mm; choose a nearer receiver, a larger "
                      "receiver_mm or fewer cells");
     }},
    {"AllWhite", "a picture that is white everywhere", "a window casts it",
     [] {
       return at_most(judged(alone(R"({"distance_mm": 100, "picture": {"type": "disc", "radius": 2}})"), "rel_l2"),
                      0.05);
     }},
    {"OneCell", "all light wanted in four cells of 256", "geometry: facets and cells leave room for it",
     [] { return loses_at_most(alone(R"({"distance_mm": 200, "picture": {"type": "disc", "radius": 0.05}})"), 0.03); }},
    {"SixteenAlike", "16 discs from 100 to 101.5 mm", "the slopes of one serve all: its own error",
     [] {
       Json settings = with(R"({"receivers": []})");
       for (int j = 0; j < 16; ++j)
         settings["receivers"].push_back({{"distance_mm", 100 + 0.1 * j}, {"picture", {{"type", "disc"}}}});
       return near(judged(settings, "rel_l2"),
                   judged(alone(R"({"distance_mm": 100, "picture": {"type": "disc"}})"), "rel_l2"), 0.01);
     }},
    {"WeightOfNothing", "a weight of 0.01 beside 100", "no worse than the heavy picture alone",
     [] {
       Json settings = ring_and_disc();
       settings["receivers"][0]["weight"] = 100;
       settings["receivers"][1]["weight"] = 0.01;
       Json ring = settings;
       ring["receivers"].erase(1);
       const auto ring_of = [](const Json& of) {
         return job::scalar(design(of), inverse::receiver_group(0), "rel_l2");
       };
       return at_most(ring_of(settings), ring_of(ring));
     }},
};
const std::vector<Extreme> lights{
    {"LampFarAway", "a lamp at 1 km", "parallel light",
     [] {
       return near(judged(with(R"({"light": {"type": "point", "distance_mm": 1e6}})"), "rel_l2"),
                   judged(ring_and_disc(), "rel_l2"), 0.01);
     }},
    {"LampAtTheFront", "a lamp 20 mm before the front", "the same",
     [] {
       return refuses(
           with(R"({"light": {"type": "point", "distance_mm": 20}})"),
           "p.json#/inverse/light/distance_mm: is 20 mm, so near that facets at the rim, to bend its light to the "
           "receivers, "
           "stand in each other's shadow; expected at least 68.76 mm; move the light away, or make the object smaller");
     }},
    {"TiltedBy60", "light tilted by 60 degrees", "facets that bend it back are steep",
     [] {
       return refuses(with(R"({"light": {"type": "parallel", "tilt_deg": 60}})"),
                      "p.json#/inverse/light/tilt_deg: is 60 degrees, and facets that bend such light to the receivers "
                      "stand in each "
                      "other's shadow; expected at most 42.6; tilt it less, or move the receivers away");
     }},
    {"TiltedBy90", "light along the front", "it never enters",
     [] {
       return refuses(with(R"({"light": {"type": "parallel", "tilt_deg": 90}})"),
                      "p.json#/inverse/light/tilt_deg: is 90 degrees, and light would not enter through the front; "
                      "expected less than 90");
     }},
    {"SunOf20Degrees", "a disc of 20 degrees", "rays beside footprints, whose blur is a box",
     [] { return as_believed(with(R"({"sun_deg": 20})"), 0.04); }},
    {"RoughBy10Degrees", "a surface that scatters by 10 degrees", "the same: a box has no tails",
     [] { return as_believed(with(R"({"scatter_deg": 10})"), 0.12); }},
};

class Inverse : public testing::TestWithParam<Extreme> {};
TEST_P(Inverse, IsRight) { expect_right(GetParam()); }
std::string name_of(const testing::TestParamInfo<Extreme>& tested) { return tested.param.name; }
INSTANTIATE_TEST_SUITE_P(ExtremesOfObjects, Inverse, testing::ValuesIn(objects), name_of);
INSTANTIATE_TEST_SUITE_P(ExtremesOfScreens, Inverse, testing::ValuesIn(screens), name_of);
INSTANTIATE_TEST_SUITE_P(ExtremesOfLights, Inverse, testing::ValuesIn(lights), name_of);

} // namespace nephroid::extremes_test
