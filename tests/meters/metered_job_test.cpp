// SPDX-License-Identifier: Apache-2.0
// Meters beside a run: its picture stays the same to the bit, and what they show is in snapshots, folders and
// checkpoints; where a picture shows their cells.
#include "meters/in_picture.h"
#include "run/meters.h"
#include "run/ready.h"
#include "run/recorder.h"
#include "tests/support/presets.h"
#include "tests/support/render.h"

#include <nlohmann/json.hpp>

namespace nephroid::metered_job_test {

using meters::Quantity;
using preset::Meter;

/// A watt in a closed room whose walls take half of what meets them: they meet two.
preset::Preset room() {
  preset::Preset p;
  p.source = "room.json";
  p.white = 1;
  p.scene.camera.position = {0.9, 0.5, 0.9};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.resolution = {32, 24};
  p.scene.materials = {{"wall", white(0.5)}, {"glass", glass(1.5)}};
  preset::Shape walls = box(2, 2, 2);
  walls.inwards = true;
  p.scene.objects = {object("room", walls, "wall"), object("ball", check::ball(0.4), "glass")};
  p.scene.lights = {{.position = {0.3, 0.7, 0.2}}};
  p.scene.meters = {{.type = Meter::Type::surface, .name = "walls", .object = "room", .cell = 0.25}};
  p.stop = {};
  p.stop.passes = 4;
  auto& settings = std::any_cast<photons::Settings&>(p.settings.value());
  settings.photons_per_pass = settings.indirect_photons_per_pass = 1 << 14;
  return p;
}

const meters::Numbers& watts(const job::Snapshot& snapshot) {
  return snapshot.meters->meters.at(0).reading->all().numbers(Quantity::irradiance);
}

/// Runs it to its end.
job::Snapshot finished(job::Job& job) {
  while (!job.finished()) job.advance();
  return job.snapshot();
}

std::unique_ptr<job::Job> job_of(const preset::Preset& preset) {
  const run::Prepared prepared = run::prepare(preset);
  return run::metered(run::make_job(prepared, {shared_context()}), prepared, {shared_context()}, nullptr);
}

TEST(MeteredJob, ThePictureHasTheSameBitsAndTheMeterItsNumbers) {
  preset::Preset without = room();
  without.scene.meters.clear();
  const auto plain = job_of(without), metered = job_of(room());
  const job::Snapshot before = finished(*plain), with = finished(*metered);
  EXPECT_EQ(before.picture->rgb, with.picture->rgb);
  EXPECT_EQ(before.meters, nullptr);
  ASSERT_NE(with.meters, nullptr);
  const meters::Interval& total = watts(with).total;
  EXPECT_NEAR(total.value, 2, 2 * total.half());
  EXPECT_LT(total.half(), 0.2);
  EXPECT_EQ(job::scalar(with, "meters/walls", "mean_w_m2"), watts(with).mean.value);
}

TEST(MeteredJob, AFolderHasTheMetersFilesAndAResumedRunGoesOn) {
  const TemporaryFolder scratch;
  const auto ready = [&](run::ReadyRun& run, bool resume) {
    preset::Preset p = room();
    p.scene.meters[0].name = "image"; // its files are in a folder of their own
    run::make_ready(run, p, {.folder = scratch.path() / "out", .resume = resume});
  };
  run::ReadyRun run([] { return shared_context(); });
  ready(run, false);
  {
    run::Recorder recorder(run, {.folder = scratch.path() / "out"});
    recorder.begun(*run.job);
    while (run.job->progress().step < 2) run.job->advance();
    while (!run.job->snapshot().meters) run.job->advance();
    recorder.ended(*run.job);
  }
  run.claimed.reset();
  run::ReadyRun again([] { return shared_context(); });
  ready(again, true);
  EXPECT_TRUE(again.resumed);
  run::Recorder recorder(again, {.folder = scratch.path() / "out"});
  run::drive(again, recorder, {});
  const auto json = nlohmann::json::parse(read_file(scratch.path() / "out/meters/measure.json"));
  const auto& total = json["meters"][0]["layers"]["all"]["W/m^2"]["total_w"];
  EXPECT_NEAR(total["value"].get<double>(), 2, total["high"].get<double>() - total["low"].get<double>());
  for (const char* file : {"meters/image.csv", "meters/image.exr", "meters/image.png", "image.exr", "meter-image.csv"})
    EXPECT_TRUE(is_there(scratch.path() / "out" / file)) << file;
  const auto run_json = nlohmann::json::parse(read_file(scratch.path() / "out/run.json"));
  EXPECT_GT(run_json["meters"]["image"]["mean_w_m2"], 0.07);

  preset::Preset whole = room();
  whole.scene.meters.clear();
  const auto plain = job_of(whole);
  EXPECT_EQ(finished(*again.job).picture->rgb, finished(*plain).picture->rgb);
}

TEST(MeteredJob, AnotherLightIsMeasuredAnew) {
  preset::Preset p = room();
  std::any_cast<photons::Settings&>(p.settings.value()).relight = true;
  const auto job = job_of(p);
  const double once = watts(finished(*job)).mean.value;
  p.scene.lights[0].power_w = 3;
  ASSERT_TRUE(job->adopt(p));
  EXPECT_EQ(job->snapshot().meters, nullptr) << "of the light before";
  EXPECT_NEAR(watts(finished(*job)).mean.value, 3 * once, 0.3 * once);
}

/// A job that takes on every preset, as engine 2 does where the camera moves.
class Adopting final : public job::Job {
public:
  explicit Adopting(std::unique_ptr<job::Job> job) : job_(std::move(job)) {}
  void advance() override { job_->advance(); }
  bool finished() const override { return job_->finished(); }
  job::Progress progress() const override { return job_->progress(); }
  job::Snapshot snapshot() override { return job_->snapshot(); }
  void save(ByteSink& to) override { job_->save(to); }
  void load(ByteSource& from) override { job_->load(from); }
  bool adopt(const preset::Preset&) override { return true; }

private:
  std::unique_ptr<job::Job> job_;
};

TEST(MeteredJob, WhereTheCameraMovesMetersKeepWhatTheyHave) {
  preset::Preset p = room();
  const run::Prepared prepared = run::prepare(p);
  const auto job = run::metered(std::make_unique<Adopting>(run::make_job(prepared, {shared_context()})), prepared,
                                {shared_context()}, nullptr);
  finished(*job);
  const auto before = job->snapshot().meters;
  p.scene.camera.position = {-0.9, 0.5, 0.9};
  ASSERT_TRUE(job->adopt(p));
  EXPECT_EQ(job->snapshot().meters, before);
  p.scene.lights[0].power_w = 3;
  ASSERT_TRUE(job->adopt(p));
  EXPECT_EQ(job->snapshot().meters, nullptr) << "the light is another one";
}

TEST(MeteredJob, AMeterThatCannotBeIsRefusedBeforeTheRun) {
  preset::Preset p = room();
  p.scene.meters[0].within = preset::Box{{5, 5, 5}, {6, 6, 6}};
  EXPECT_THAT(refusal_of([&] { job_of(p); }), HasSubstr("room.json#/scene/meters/0"));
}

// A camera straight above a square of 2 x 2 with a ball in the middle: its lower left pixel shows the square's corner.
TEST(CellsInPicture, AreWhereTheCameraSeesThem) {
  preset::Preset p;
  p.source = "p.json";
  p.scene.camera.position = {0, 4, 0};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.projection = preset::Camera::Projection::orthographic;
  p.scene.camera.height = 2;
  p.scene.camera.resolution = {8, 8};
  p.scene.materials = {{"floor", white(0.5)}, {"glass", glass(1.5)}};
  p.scene.objects = {object("floor", quad(2, 2), "floor"), object("ball", check::ball(0.3), "glass", at({0, 1, 0}))};
  p.scene.lights = {{.position = {0, 3, 0}}};
  p.scene.meters = {{.type = Meter::Type::surface, .name = "floor", .object = "floor", .cell = 0.5},
                    {.type = Meter::Type::plane, .name = "air", .position = {0, 2, 0}, .size = {1, 1}, .cell = 0.5}};
  const run::Prepared prepared = run::prepare(p);
  const scene::Scene& scene = prepared.loaded->scene;
  const auto seen = [&](std::size_t meter) {
    const scene::MeterSurface surface =
        scene::make_meter(p.scene.meters[meter], scene, Location(p.source) / static_cast<int>(meter));
    const std::vector<int> cells = meters::cells_in_picture(scene, *prepared.loaded->bvh, surface);
    std::vector<glm::dvec2> centres;
    for (const int cell : cells)
      centres.push_back(cell < 0 ? glm::dvec2(9)
                                 : glm::dvec2(surface.centres[static_cast<std::size_t>(cell)].x,
                                              surface.centres[static_cast<std::size_t>(cell)].z));
    return centres;
  };
  const std::vector<glm::dvec2> floor = seen(0), air = seen(1);
  for (std::size_t row = 0; row < 8; ++row)
    for (std::size_t column = 0; column < 8; ++column) {
      const glm::dvec2 place(-0.875 + 0.25 * double(column), -0.875 + 0.25 * double(row));
      const bool is_behind_ball = glm::length(place) < 0.3,
                 is_in_air = std::max(std::abs(place.x), std::abs(place.y)) < 0.5;
      const glm::dvec2 on_floor = floor[8 * row + column], in_air = air[8 * row + column];
      if (is_behind_ball)
        EXPECT_EQ(on_floor.x, 9) << row << " " << column;
      else
        EXPECT_LE(std::max(std::abs(on_floor.x - place.x), std::abs(on_floor.y - place.y)), 0.25 + 1e-6);
      if (is_in_air)
        EXPECT_LE(std::max(std::abs(in_air.x - place.x), std::abs(in_air.y - place.y)), 0.25 + 1e-6);
      else
        EXPECT_EQ(in_air.x, 9);
    }
}

} // namespace nephroid::metered_job_test
