// SPDX-License-Identifier: Apache-2.0
// Whole runs of engine 3: files, figures, and that a run that was cut goes on with the same bits; every shipped preset
// with few facets; the shipped QR codes read by zbar; the finished object as glass, rendered by engine 1.
#include "image/image.h"
#include "inverse/job.h"
#include "preset/read.h"
#include "tests/support/program_test.h"
#include "tests/support/render.h"
#include "tests/support/x_display.h"

namespace nephroid::run_test {

using nlohmann::json;
using preset::Camera;

class InverseRun : public ProgramTest {
protected:
  /// The shipped shapes, small enough for a test: facets are half a cell, as shipped. The judge sends a fourth of the
  /// rays through 16 x 16 facets that it sends through 64 x 64.
  Ended run_to(const std::string& name, std::vector<std::string> more = {}, const Environment& environment = {},
               int facets = 16) const {
    more.insert(more.begin(),
                {"run", "inverse/shapes", "-o", name, "--set", fmt::format("inverse.facets=[{0}, {0}]", facets),
                 "--set", fmt::format("inverse.cells=[{0}, {0}]", facets / 2), "--set",
                 "scene.camera.resolution=[200, 200]"});
    Ended ended = run(more, environment);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return ended;
  }
};

TEST_F(InverseRun, CastsTheShapes) {
  EXPECT_THAT(run_to("out", {}, {}, 64).out, HasSubstr("sweeps"));
  const json all = of("out/run.json");
  const double judged = all.at("judged").at("cost").get<double>(),
               believed = all.at("believed").at("cost").get<double>();
  EXPECT_LT(judged, 0.15); // the aim for this set
  EXPECT_NEAR(judged, believed, 0.02);
  EXPECT_GT(judged, 0.03); // three pictures of one surface are never all right
  // What a picture keeps is there for the sake of the others: three shapes, all in conflict, none much.
  for (const char* name : {"1_2", "1_3", "2_3", "floor_1", "floor_2", "floor_3"}) {
    EXPECT_GT(all.at("conflicts").at(name).get<double>(), 0.001) << name;
    EXPECT_LT(all.at("conflicts").at(name).get<double>(), 0.2) << name;
  }
  const image::Image slopes = image::read_image(folder / "out/slopes.exr");
  EXPECT_EQ(slopes.width, 64);
  EXPECT_LE(*std::max_element(slopes.data.begin(), slopes.data.end()), 1.07); // the limit; light straight on is 1
  const image::Image conflict = image::read_image(folder / "out/conflict.exr");
  EXPECT_EQ(conflict.height, 64);
  const auto [least, most] = std::minmax_element(conflict.data.begin(), conflict.data.end());
  EXPECT_GE(*least, 0);
  EXPECT_LE(*most, 1);
  const json& receivers = all.at("inverse").at("receivers");
  ASSERT_EQ(receivers.size(), 3);
  double sum = 0;
  for (const json& receiver : receivers) sum += receiver.at("cost").get<double>();
  EXPECT_NEAR(sum / 3, judged, 1e-9);
  EXPECT_EQ(receivers[1].at("distance_mm"), 150);
  EXPECT_EQ(receivers[1].at("height_mm"), 100);
  for (const char* name : {"width_mm", "cost_all", "rel_l2", "missed", "believed_cost"})
    EXPECT_TRUE(receivers[2].contains(name)) << name;
  const json light = all.at("light");
  EXPECT_NEAR(light.at("sent").get<double>() + light.at("reflected").get<double>() + light.at("lost").get<double>(), 1,
              1e-6);
  EXPECT_THAT(bytes("out/cost.csv"), StartsWith("sweep,seconds,cost,cost_all,rel_l2,missed\n0,"));
  for (const char* file : {"receiver_3.exr", "target_1.png", "difference_2.png", "object.obj", "object.stl",
                           "object.ply", "object.3mf", "facets.json", "heights.exr", "heights.png", "workshop.md"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
  const image::Image receiver = image::read_image(folder / "out/receiver_1.exr");
  EXPECT_EQ(receiver.width, 32);
  const double triangles = all.at("object").at("triangles").get<double>();
  EXPECT_EQ(static_cast<double>(bytes("out/object.stl").size()), 84 + 50 * triangles);
}

// What the plan said of a lens comes to be: its triangles within a third, and that it becomes too deep.
TEST_F(InverseRun, ALensIsAsForetoldAndKeepsItsPicturesWhereItIsTooDeep) {
  std::vector<std::string> words{"run", "inverse/lens", "-o", "out"};
  for (const char* set : {"inverse.facets=[48, 48]", "inverse.cells=[24, 24]", "scene.camera.resolution=[200, 200]"})
    words.insert(words.end(), {"--set", set});
  ASSERT_EQ(run(words).exit_code, 0);
  const json plan = of("out/plan.json"), made = of("out/run.json");
  const auto solid = std::ranges::find_if(
      plan.at("buffers"), [](const json& buffer) { return buffer.at("name") == "the solid and its tree (host)"; });
  ASSERT_NE(solid, plan.at("buffers").end());
  EXPECT_NEAR(solid->at("bytes").get<double>() / 145 / made.at("object").at("triangles").get<double>(), 1, 0.33);
  words.insert(words.end(), {"--set", "inverse.max_relief_mm=3"});
  const Ended ended = run(words);
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("and 'max_relief_mm' is 3; the run is refused"),
                               HasSubstr("#/inverse: the lens's relief is ")));
  EXPECT_TRUE(fs::exists(folder / "out/receiver_1.png"));
  EXPECT_FALSE(fs::exists(folder / "out/object.stl")) << "of the run before";
}

// Three receivers and three frames between each two: the first, the fifth and the last are the receivers.
TEST_F(InverseRun, ShowsWhatAScreenSeesThatMoves) {
  run_to("out", {"--passes", "1", "--set", "inverse.frames=3"});
  EXPECT_EQ(bytes("out/frames.csv"),
            "frame,distance_mm\n1,100\n2,112.5\n3,125\n4,137.5\n5,150\n6,162.5\n7,175\n8,187.5\n9,200\n");
  const auto picture = [&](const std::string& name) {
    return image::read_image(folder / "out" / (name + ".exr")).data;
  };
  EXPECT_EQ(picture("frame_0001"), picture("receiver_1"));
  EXPECT_EQ(picture("frame_0005"), picture("receiver_2"));
  EXPECT_EQ(picture("frame_0009"), picture("receiver_3"));
  EXPECT_NE(picture("frame_0004"), picture("frame_0005"));
  EXPECT_FALSE(fs::exists(folder / "out/frame_0010.exr"));
}

// A person would mill the object of the run before.
TEST_F(InverseRun, LeavesNothingOfTheRunBefore) {
  run_to("out", {"--passes", "1", "--set", "inverse.frames=1"});
  EXPECT_TRUE(fs::exists(folder / "out/receiver_3.png"));
  const auto files = of("out/run.json").at("files").get<std::vector<std::string>>();
  EXPECT_THAT(files, IsSupersetOf({"object.stl", "workshop.md", "frame_0002.exr", "frames.csv", "image.png"}));
  for (const std::string& file : files) EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
  const std::string one = R"(inverse.receivers=[{"distance_mm": 100, "picture": {"type": "disc"}}])";
  run_to("out", {"--passes", "1", "--set", one, "--set", R"(inverse.light={"type": "point"})"});
  for (const char* file : {"receiver_3.png", "target_2.exr", "frame_0002.exr", "frames.csv", "view.json"})
    EXPECT_FALSE(fs::exists(folder / "out" / file)) << file;
}

// Walls that lean take a strip of each facet, whose light goes elsewhere; what errors do stands in two files.
TEST_F(InverseRun, SaysWhatAWorkshopMayGetWrong) {
  run_to("upright", {"--passes", "2"});
  run_to("out", {"--passes", "2", "--set", "inverse.draft_deg=5", "--set", "inverse.tolerances=true"});
  const json all = of("out/run.json");
  EXPECT_LE(all.at("object").at("steepest_wall_deg").get<double>(), 85.01);
  EXPECT_EQ(of("upright/run.json").at("object").at("steepest_wall_deg"), 90);
  EXPECT_GT(all.at("light").at("by_walls").get<double>(), 0.01);
  EXPECT_GT(all.at("judged").at("rel_l2").get<double>(),
            of("upright/run.json").at("judged").at("rel_l2").get<double>());
  EXPECT_THAT(bytes("out/tolerance.csv"),
              AllOf(StartsWith("error,receiver,cost,rel_l2\nnone,1,"), HasSubstr("\nheights off by 20 um,3,")));
  EXPECT_THAT(bytes("out/workshop.md"), AllOf(HasSubstr("walls between them that lean"), HasSubstr("## Tolerances")));
  EXPECT_THAT(bytes("out/print_object.svg"), HasSubstr("The object, "));
  EXPECT_THAT(bytes("out/print_3.svg"), HasSubstr("200 mm from the facets"));
  EXPECT_FALSE(fs::exists(folder / "upright/tolerance.csv"));
}

// The search gets what the judge leaves: nothing of a millisecond, and a part of three seconds.
TEST_F(InverseRun, LeavesTheJudgeItsTime) {
  const std::string note = "stop.seconds ended the search after sweep";
  EXPECT_THAT(run_to("none", {"--seconds", "0.001"}).err, HasSubstr(note + " 1,"));
  EXPECT_EQ(of("none/run.json").at("sweeps"), 1); // without one it would cast nothing
  EXPECT_THAT(run_to("all", {"--seconds", "1000"}).err, Not(HasSubstr(note)));
}

TEST_F(InverseRun, GoesOnWithTheSameBitsOnAnyThreads) {
  run_to("whole", {"--passes", "3"}, {{"POCL_MAX_PTHREAD_COUNT", "1"}});
  run_to("parts", {"--passes", "1"}, {{"POCL_MAX_PTHREAD_COUNT", "2"}});
  EXPECT_EQ(of("parts/run.json").at("sweeps"), 1);
  EXPECT_THAT(run_to("parts", {"--passes", "3", "--resume"}).err, HasSubstr("going on in"));
  EXPECT_EQ(of("parts/run.json").at("sweeps"), 3);
  EXPECT_EQ(of("whole/run.json").at("judged"), of("parts/run.json").at("judged"));
  for (const char* file : {"object.stl", "object.obj"})
    EXPECT_EQ(bytes(std::string("whole/") + file), bytes(std::string("parts/") + file));
  for (const char* picture : {"image.exr", "receiver_2.exr"})
    EXPECT_EQ(image::read_image(folder / "whole" / picture).data, image::read_image(folder / "parts" / picture).data);
}

// Cut in the first annealing and in the second.
TEST_F(InverseRun, GoesOnWithTheSameBitsByTheThesis) {
  const auto thesis = [&](const std::string& name, const std::string& trials, bool resume) {
    std::vector<std::string> more{"--set", "inverse.method=thesis",  "--set",    "inverse.thesis.cycles=2",
                                  "--set", "inverse.thesis.moves=3", "--passes", trials};
    if (resume) more.push_back("--resume");
    EXPECT_THAT(run_to(name, more, {}, 32).out, HasSubstr("trials"));
  };
  thesis("whole", "17", false);
  for (const char* trials : {"4", "9", "17"}) thesis("parts", trials, trials != std::string("4"));
  for (const char* group : {"thesis", "believed", "judged"})
    EXPECT_EQ(of("whole/run.json").at(group), of("parts/run.json").at(group));
  EXPECT_EQ(bytes("whole/annealing.csv"), bytes("parts/annealing.csv"));
  EXPECT_EQ(bytes("whole/object.stl"), bytes("parts/object.stl"));
  EXPECT_GT(of("whole/run.json").at("thesis").at("gain_annealing_2").get<double>(), 0);
}

// Free heights within a workshop's constraints: kept by the mesh, with walls that are smaller than flat ones, as
// believed, and resumed with the same bits.
TEST_F(InverseRun, KeepsAWorkshopsConstraints) {
  const std::vector<std::string> free{"--set", "inverse.heights=free",       "--set", "inverse.max_relief_mm=5",
                                      "--set", "inverse.min_thickness_mm=8", "--set", "inverse.max_slope_deg=33"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), free.begin(), free.end());
    return more;
  };
  run_to("free", with({"--passes", "4"}), {}, 64);
  run_to("parts", with({"--passes", "2"}), {}, 64);
  run_to("parts", with({"--passes", "4", "--resume"}), {}, 64);
  EXPECT_EQ(bytes("free/object.stl"), bytes("parts/object.stl"));
  run_to("flat", {"--passes", "4", "--set", "inverse.max_slope_deg=33"}, {}, 64);
  const json all = of("free/run.json"), flat = of("flat/run.json");
  EXPECT_EQ(all.at("judged"), of("parts/run.json").at("judged"));
  const auto figure = [](const json& run, const char* group, const char* name) {
    return run.at(group).at(name).get<double>();
  };
  EXPECT_LE(figure(all, "object", "relief_mm"), 4 * (1 + 1e-9)); // twice the 2 mm between the middle's 10 and 8
  EXPECT_GT(figure(all, "object", "relief_mm"), 3.9);
  EXPECT_GE(figure(all, "object", "thinnest_mm"), 8 - 1e-9);
  EXPECT_LE(figure(all, "object", "steepest_deg"), 33 + 1e-5);
  EXPECT_LT(figure(all, "object", "wall_area_mm2"), 0.9 * figure(flat, "object", "wall_area_mm2"));
  EXPECT_NEAR(figure(all, "judged", "cost"), figure(all, "believed", "cost"), 0.02);
  EXPECT_NEAR(figure(all, "judged", "cost"), figure(flat, "judged", "cost"), 0.02);
}

TEST_F(InverseRun, IsPlannedWithItsReasons) {
  const Ended planned = run({"plan", "inverse/shapes", "--json", "--set", "inverse.facets=[64, 64]"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  const json plan = json::parse(planned.out);
  EXPECT_EQ(plan.at("passes").at(0).at("reason"), "64 x 64 facets, 3 receivers, slopes up to 1.06");
  for (const std::size_t i : {1u, 2u, 3u, 4u, 5u, 6u}) EXPECT_EQ(plan.at("passes").at(i).at("runs"), false);
  EXPECT_EQ(plan.at("passes").at(2).at("reason"), "inverse.method is 'assign'");
  EXPECT_EQ(plan.at("passes").at(5).at("reason"), "inverse.smoothing_normals is 0: no term");
  EXPECT_EQ(plan.at("passes").at(6).at("reason"), "inverse.heights is flat: nothing is solved");
  EXPECT_THAT(plan.at("notes").at(0), HasSubstr("are larger than half a cell"));
  const json thesis = json::parse(run({"plan", "inverse/shapes", "--json", "--set", "inverse.method=thesis"}).out);
  EXPECT_EQ(thesis.at("passes").at(0).at("reason"), "inverse.method is 'thesis'");
  for (const std::size_t i : {1u, 2u, 3u}) EXPECT_EQ(thesis.at("passes").at(i).at("runs"), true);
  const json lens = json::parse(run({"plan", "inverse/lens", "--json"}).out);
  for (const std::size_t i : {0u, 1u, 2u, 3u})
    EXPECT_EQ(lens.at("passes").at(i).at("reason"), "inverse.method is 'lens'");
  EXPECT_EQ(lens.at("passes").at(7).at("name"), "transport");
  EXPECT_EQ(lens.at("passes").at(7).at("runs"), true);
  EXPECT_EQ(thesis.at("notes").at(0),
            "the thesis' pipeline takes up to 251 trials and stops after 12: a 'stop.passes' of 251 lets it end");
}

TEST(InversePresets, AreDesignedAndJudged) {
  int count = 0;
  for (const preset::ShippedPreset& shipped : preset::shipped_presets()) {
    preset::Preset p = preset::read_presets(shipped.name).front();
    if (&p.settings.type() != &inverse::settings_type()) continue;
    SCOPED_TRACE(shipped.name);
    ++count;
    inverse::settings(p).facets = {24, 24};
    p.stop.passes = 2;
    const inverse::InversePlan plan = inverse::make_plan(p);
    const auto job = inverse::make_job(p, plan, test::shared_context());
    const double before = job::scalar(job->snapshot(), "believed", "rel_l2");
    while (!job->finished()) job->advance();
    const job::Snapshot made = job->snapshot();
    EXPECT_LT(job::scalar(made, "judged", "rel_l2"), before);
    EXPECT_NEAR(job::scalar(made, "light", "sent") + job::scalar(made, "light", "reflected") +
                    job::scalar(made, "light", "lost"),
                1, plan.design->layout.has_area() ? 5e-3 : 1e-4); // places of a lamp see the front each otherwise
    for (const job::NamedPicture& one : made.pictures)
      for (const float value : one.picture->rgb) ASSERT_TRUE(std::isfinite(value)) << one.name;
  }
  EXPECT_GE(count, 13);
}

class Codes : public ProgramTest {
protected:
  /// What zbar reads in a picture of the run, without its end of line; empty where it reads nothing.
  std::string read(const std::string& picture) const {
    Child child({"--quiet", "--raw", "--nodbus", picture}, folder / "out", logs, {}, "zbarimg");
    std::string text = child.wait().out;
    while (text.ends_with('\n')) text.pop_back();
    return text;
  }
};

/// How much lighter the cells of a picture are where another one is light than where it is dark; mirrored: the other
/// one's columns.
double contrast(const image::Image& picture, const image::Image& wanted, bool mirrored) {
  double light = 0, dark = 0;
  int lit = 0;
  const auto value = [](const image::Image& of, int x, int y) {
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
TEST_F(Codes, AreReadAtTheirOwnDistance) {
  const Ended ended = run({"run", "inverse/qr", "-o", "out"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const std::string j : {"1", "2"}) {
    const auto picture = image::read_image(folder / ("out/receiver_" + j + ".exr"));
    const auto wanted = image::read_image(folder / ("out/target_" + j + ".exr"));
    EXPECT_GT(contrast(picture, wanted, false), 0.5);
    EXPECT_LT(contrast(picture, wanted, true), 0.8 * contrast(picture, wanted, false));
  }
  if (!there_is("zbarimg")) GTEST_SKIP() << "needs zbarimg, of the package zbar-tools";
  for (const char* picture : {"target_1.png", "receiver_1.png"}) EXPECT_EQ(read(picture), "NEPHROID") << picture;
  for (const char* picture : {"target_2.png", "receiver_2.png"}) EXPECT_EQ(read(picture), "CAUSTICS") << picture;
}

glm::dvec3 vec(const preset::Vec3& v) { return {v[0], v[1], v[2]}; }

/// The pixel that a pinhole camera sees a point in.
glm::dvec2 pixel(const Camera& camera, const glm::dvec3& point) {
  const glm::dvec3 ahead = glm::normalize(vec(camera.target) - vec(camera.position)),
                   right = glm::normalize(glm::cross(ahead, vec(camera.up))), up = glm::cross(right, ahead),
                   to = point - vec(camera.position);
  const double height = camera.resolution[1], per_slope = height / 2 / std::tan(glm::radians(camera.fov_deg / 2));
  return {camera.resolution[0] / 2.0 + per_slope * glm::dot(to, right) / glm::dot(to, ahead),
          height / 2 - per_slope * glm::dot(to, up) / glm::dot(to, ahead)};
}

class GlassView : public ProgramTest {
protected:
  /// Mean grey of the pixels about a point of the scene.
  static double grey(const image::Image& picture, const Camera& camera, const glm::dvec3& point) {
    const glm::dvec2 at = pixel(camera, point);
    double sum = 0;
    constexpr int reach = 9;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        sum += picture.data.at(
            picture.channels.size() *
            static_cast<std::size_t>((static_cast<int>(at.y) + y) * picture.width + static_cast<int>(at.x) + x));
    return sum / ((2 * reach + 1) * (2 * reach + 1));
  }
};

// Both pictures grow brighter to the right and to the top: the four corners tell mirrored and upside down ones apart.
TEST_F(GlassView, ShowsThePicturesAsAPersonSeesThem) {
  write("two.json", R"({
    "engine": "inverse", "unit": "mm", "scene": {"camera": {"resolution": [64, 64]}},
    "inverse": {"facets": [64, 64], "cells": [24, 24], "receivers": [
      {"distance_mm": 150, "picture": {"type": "gradient", "turn_deg": 45}},
      {"distance_mm": 300, "picture": {"type": "gradient", "turn_deg": 45}}]},
    "stop": {"passes": 3}})");
  Ended ended = run({"run", "two.json", "-o", "out"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  ended = run({"run", "out/view.json", "-o", "view", "--passes", "2"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, Not(HasSubstr("hole"))) << "the glass is closed";
  const preset::Preset view = preset::read_preset((folder / "out/view.json").string());
  const image::Image picture = image::read_image(folder / "view/image.exr");
  const auto at = [&](std::size_t receiver, double x, double y) {
    for (const preset::Object& object : view.scene.objects)
      if (object.name == "receiver " + std::to_string(receiver))
        return grey(picture, view.scene.camera, vec(object.transform.translate) + glm::dvec3(x, y, 0));
    throw std::out_of_range("no receiver " + std::to_string(receiver));
  };
  for (const std::size_t receiver : {1u, 2u}) {
    const double bright = at(receiver, 33, 33), right = at(receiver, 33, -33), left = at(receiver, -33, 33),
                 dark = at(receiver, -33, -33);
    EXPECT_GT(bright, 1.2 * std::max(right, left)) << receiver;
    EXPECT_LT(dark, std::min(right, left) / 1.2) << receiver;
  }
}

} // namespace nephroid::run_test
