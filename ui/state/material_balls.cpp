// SPDX-License-Identifier: Apache-2.0
#include "ui/state/material_balls.h"

#include "photons/settings.h"
#include "preset/read.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <condition_variable>

namespace nephroid::ui {
namespace {

/// While the run in hand works, a ball that has a picture rests so many times as long as it worked.
constexpr int rest_a_slice = 5;
/// The run in hand has the device for itself so long, at most, until it shows its first picture.
constexpr std::chrono::milliseconds patience{120};

/// A lamp for highlights and caustics; the sun and a sky, which mirrors show, are added. Of the first engine, whose
/// pictures are of all materials.
constexpr const char* scene_text = R"({
  "white": 50,
  "scene": {
    "camera": {"position": [0, 3, 5.6], "target": [0, 0.8, 0], "fov_deg": 24},
    "materials": {
      "ground": {
        "type": "diffuse",
        "texture": {"type": "checkerboard", "colour0": [0.5, 0.5, 0.5], "scale": [4, 4]}
      }
    },
    "objects": [
      {"name": "ground", "shape": {"type": "quad", "size": [8, 1, 8]}, "material": "ground"},
      {
        "name": "ball",
        "shape": {"type": "sphere", "radius": 1},
        "material": "ground",
        "transform": {"translate": [0, 1.001, 0]}
      }
    ],
    "lights": [{"type": "directional", "irradiance_w_m2": 80, "direction": [-0.9, -0.8, -0.6]}]
  },
  "stop": {"seconds": 1}
})";

/// A job that leaves most of the device to others once it has shown a picture.
class Unhurried : public job::Job {
public:
  Unhurried(std::unique_ptr<job::Job> job, const std::atomic<bool>& device_is_wanted, std::stop_token stop)
      : job_(std::move(job)), device_is_wanted_(device_is_wanted), stop_(std::move(stop)) {}
  void advance() override {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    job_->advance();
    if (!shown_ || !device_is_wanted_) return;
    std::unique_lock lock(mutex_);
    resting_.wait_for(lock, stop_, rest_a_slice * (Clock::now() - begin), [] { return false; });
  }
  bool finished() const override { return job_->finished(); }
  job::Progress progress() const override { return job_->progress(); }
  job::Snapshot snapshot() override {
    job::Snapshot snapshot = job_->snapshot();
    shown_ = shown_ || snapshot.progress.whole;
    return snapshot;
  }
  void save(ByteSink& to) override { job_->save(to); }
  void load(ByteSource& from) override { job_->load(from); }

private:
  std::unique_ptr<job::Job> job_;
  const std::atomic<bool>& device_is_wanted_;
  std::stop_token stop_; ///< ends a rest
  bool shown_ = false;
  std::mutex mutex_;
  std::condition_variable_any resting_;
};

} // namespace

/// A ball on a chequered ground in the sun. What a picture is on is a cylinder, for a ball has no u, v.
preset::Preset MaterialBalls::scene_of(const Subject& subject) {
  preset::Json scene = preset::Json::parse(scene_text);
  scene["engine"] = preset::Settings().engine();
  preset::Preset preset = preset::read_json(std::move(scene), subject.source);
  auto& settings = preset.settings.as<photons::Settings>();
  const preset::Material& material = subject.material;
  // One way for a whole cluster leaves no coloured noise, and bends light wrong by less than a pixel.
  settings.jitter = false;
  settings.indirect = false;
  settings.threshold_deg = 0.2;
  settings.effort = photons::Settings::Effort::power; // measuring first would take as long as the picture
  settings.photons_per_pass = 1 << 15;
  preset::Environment& sky = preset.scene.environment.emplace();
  sky.type = preset::Environment::Type::sky;
  sky.sun_direction = {-0.6, 0.75, 0.5};
  sky.turbidity = 7; // in clear air metals would mirror much blue
  preset.unit = subject.unit;
  preset.scene.camera.resolution = {edge, edge};
  preset.scene.materials["ball"] = material;
  preset::Object& ball = preset.scene.objects.back();
  ball.material = "ball";
  if (material.texture || material.roughness_texture || material.tint_texture || material.normal_map) {
    ball.shape->type = preset::Shape::Type::cylinder;
    ball.shape->height = 1.6;
    ball.normals = preset::Object::Normals::smooth;
    ball.transform.translate[1] = ball.shape->height / 2;
  }
  return preset;
}

std::shared_ptr<const job::Picture> MaterialBalls::of(const std::string& material) {
  Ball& ball = balls_[material];
  ball.wanted = true;
  return ball.picture;
}

void MaterialBalls::update(const preset::Preset* preset, const RunInHand& run) {
  const job::State state = run.status().state;
  device_is_wanted_ = state == job::State::preparing || state == job::State::running;
  take_newest();
  follow(preset, run.readings());
  start_next(device_is_wanted_ && !run.snapshot_is_current());
}

void MaterialBalls::take_newest() {
  if (in_hand_.empty()) return;
  const job::Status status = worker_.status(); // first: the last snapshot is there before a run is over
  const std::shared_ptr<const job::Snapshot> newest = worker_.snapshot();
  Ball& ball = balls_.at(in_hand_);
  const bool is_of_subject = ball.subject == subject_;
  if (newest && newest != before_start_ && newest->progress.whole) {
    shown_ = true;
    if (!is_of_subject || newest->progress.work_seconds > ball.work_seconds) ball.picture = newest->picture;
    if (is_of_subject) ball.work_seconds = std::max(ball.work_seconds, newest->progress.work_seconds);
  }
  if (status.state == job::State::preparing || status.state == job::State::running) return;
  if (status.state == job::State::failed && is_of_subject) ball.picture.reset();
  if (is_of_subject) ball.done = true;
  worker_.cancel(); // it would keep the device's memory
  in_hand_.clear();
}

/// Takes over what the preset says of the materials. Those that nobody shows keep the picture that they have.
void MaterialBalls::follow(const preset::Preset* preset, std::uint64_t readings) {
  for (auto entry = balls_.begin(); entry != balls_.end();) {
    auto& [name, ball] = *entry;
    const bool exists = preset && preset->scene.materials.contains(name);
    if (name == in_hand_ && (!exists || !ball.wanted)) end_run();
    if (!exists) {
      entry = balls_.erase(entry);
      continue;
    }
    if (Subject now{preset->source, preset->unit, preset->scene.materials.at(name), readings}; ball.subject != now) {
      if (ball.work_seconds >= 0 || ball.done) ball.outdated = Clock::now();
      if (name == in_hand_ && shown_) end_run(); // else there would be no picture while a number is dragged
      ball.subject = std::move(now);
      ball.work_seconds = -1;
      ball.done = false;
    }
    ++entry;
  }
}

/// First pictures come before better ones.
void MaterialBalls::start_next(bool run_shows_nothing) {
  const auto is_next = [&](const auto& entry) { return entry.second.wanted && !entry.second.done; };
  const Clock::time_point waiting_since = run_shows_nothing ? Clock::now() - patience : Clock::time_point::max();
  const auto has_none = [&](const auto& entry) {
    return is_next(entry) && entry.second.work_seconds < 0 && entry.second.outdated <= waiting_since;
  };
  auto next = in_hand_.empty() || shown_ ? std::ranges::find_if(balls_, has_none) : balls_.end();
  if (next == balls_.end() && in_hand_.empty() && !run_shows_nothing) next = std::ranges::find_if(balls_, is_next);
  if (next != balls_.end()) start(next->first, next->second);
  works_ = std::ranges::any_of(balls_, is_next);
  for (auto& [name, ball] : balls_) ball.wanted = false;
}

void MaterialBalls::end_run() {
  making_.request_stop();
  worker_.cancel();
  in_hand_.clear();
}

void MaterialBalls::start(const std::string& material, const Ball& ball) {
  making_.request_stop();
  making_ = {};
  in_hand_ = material;
  subject_ = ball.subject;
  shown_ = false;
  before_start_ = worker_.start([this, subject = subject_, stop = making_.get_token()]() -> std::unique_ptr<job::Job> {
    return std::make_unique<Unhurried>(source_.make_beside(scene_of(subject), {stop, {}}), device_is_wanted_, stop);
  });
}

} // namespace nephroid::ui
