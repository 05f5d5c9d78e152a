// SPDX-License-Identifier: Apache-2.0
// A run of engine 2: the object is baked, or its bake is read.
#include "base/error.h"
#include "base/hash.h"
#include "environment/bake/bake_file.h"
#include "environment/engine.h"
#include "environment/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::environment {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t checkpoint_version = 1;

class EnvironmentJob final : public job::Job {
public:
  EnvironmentJob(const preset::Preset& preset, const EnvironmentPlan& plan, const compute::Context& context)
      : task_(plan.task), context_(context),
        file_(plan.bake_file), identity_{plan.key, hash_of(compute::kernel_source(context, "environment/bake.cl"))},
        width_(preset.scene.camera.resolution[0]), height_(preset.scene.camera.resolution[1]), white_(preset.white), stop_(preset.stop)
  {
    if (!plan.bakes) read();
    if (!bake_) baker_.emplace(*task_, context_);
  }

  void step() override
  {
    const auto begin = Clock::now();
    baker_->step();
    const bool complete = baker_->finished();
    if (complete) {
      photons_ = baker_->photons();
      bake_ = baker_->take();
    }
    work_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
    if (!complete) return;
    baker_.reset(); // its device memory is for others
    keep();
  }

  bool finished() const override
  {
    if (bake_) return true;
    if (stop_.seconds && work_seconds_ >= *stop_.seconds) return true;
    return stop_.passes && directions_done() >= *stop_.passes;
  }
  bool estimates_error() const override { return false; }

  job::Progress progress() const override
  {
    job::Progress p;
    const auto all = static_cast<std::int64_t>(task_->directions.size());
    p.steps = stop_.passes ? std::min<std::int64_t>(all, *stop_.passes) : all;
    p.step = directions_done();
    p.work = bake_ ? photons_ : baker_->photons();
    p.work_seconds = work_seconds_;
    const double done = bake_ ? 1 : (static_cast<double>(p.step) + baker_->part()) / static_cast<double>(p.steps);
    p.fraction = finished() ? 1 : std::min(1.0, std::max(done, stop_.seconds ? work_seconds_ / *stop_.seconds : 0));
    p.units = {.step = "direction", .steps = "directions", .work = "photon", .works = "photons"};
    return p;
  }

  job::Snapshot snapshot() override
  {
    const Bake& bake = bake_ ? *bake_ : baker_->bake();
    job::Snapshot made;
    show(bake);
    made.picture = sheet_;
    made.pictures = spheres_;
    made.progress = progress();
    made.warnings = warnings_;
    made.phases = {{"bake", work_seconds_}};
    add_figures(bake, made);
    return made;
  }

  void save(ByteSink& sink) override
  {
    tracing::StateWriter to(sink);
    to.value(checkpoint_version);
    to.value(work_seconds_);
    const std::uint8_t complete = bake_ ? 1 : 0;
    to.value(complete);
    if (baker_) baker_->save(to);
  }

  /// A bake that was complete is in its file, or is baked again.
  void load(ByteSource& source) override
  {
    tracing::StateReader from(source);
    std::uint32_t version = 0;
    std::uint8_t complete = 0;
    from.value(version);
    if (version != checkpoint_version)
      throw bad_input("checkpoint", fmt::format("is of version {}", version),
                      fmt::format("this program writes version {}", checkpoint_version), "delete it and start again");
    double seconds = 0;
    from.value(seconds);
    from.value(complete);
    if (complete == 0) {
      bake_.reset();
      if (!baker_) baker_.emplace(*task_, context_);
      baker_->load(from);
      work_seconds_ = seconds;
    } else if (bake_)
      work_seconds_ = seconds;
    if (!from.at_end()) throw bad_input("checkpoint", "is too long", "expected one of this preset", "delete it and start again");
  }

private:
  std::int64_t directions_done() const { return static_cast<std::int64_t>((bake_ ? *bake_ : baker_->bake()).baked.size()); }

  void read()
  {
    try {
      bake_ = read_bake(file_, identity_);
      from_file_ = true;
    } catch (const Error& error) {
      warnings_.push_back(error.line() + "; it is baked again");
    }
  }

  void keep()
  {
    try {
      write_bake(file_, identity_, *bake_);
    } catch (const Error& error) {
      warnings_.push_back(error.line() + "; the bake is not kept, and the next start bakes again");
    }
  }

  /// Makes what shows the directions that were baked since it was last made.
  void show(const Bake& bake)
  {
    const Shown shown = choose_shown(bake, width_, height_);
    const auto baked = static_cast<std::size_t>(
        std::ranges::count_if(shown.directions, [&](std::size_t direction) { return direction < bake.baked.size(); }));
    if (sheet_ && baked == spheres_.size()) return;
    if (baked < spheres_.size()) spheres_.clear(); // an earlier state was loaded
    sheet_ = sheet(bake, shown, width_, height_, white_);
    for (std::size_t i = spheres_.size(); i < baked; ++i)
      spheres_.push_back(
          {fmt::format("direction_{:03}", shown.directions[i] + 1), spheres_picture(bake, shown.directions[i], shown.spheres, white_)});
  }

  void add_figures(const Bake& bake, job::Snapshot& made) const
  {
    made.curves.push_back({"directions", {"direction", "x", "y", "z", "met", "sent", "absorbed", "lost"}, {}});
    BakedDirection sum;
    for (std::size_t i = 0; i < bake.baked.size(); ++i) {
      const BakedDirection& d = bake.baked[i];
      const glm::dvec3& way = bake.directions[i];
      made.curves.back().rows.push_back({static_cast<double>(i + 1), way.x, way.y, way.z, d.met, d.sent, d.absorbed, d.lost});
      sum.met += d.met;
      sum.sent += d.sent;
      sum.absorbed += d.absorbed;
      sum.lost += d.lost;
    }
    made.scalars = {{"bake", "from_file", from_file_ ? 1.0 : 0.0},
                    {"bake", "size", bake.size},
                    {"bake", "smallest_radius", bake.radii.front()},
                    {"bake", "largest_radius", bake.radii.back()},
                    {"bake", "channels", static_cast<double>(bake.channels)},
                    {"bake", "bytes", static_cast<double>(bake.halves.size() * sizeof(std::uint16_t))}};
    if (sum.met <= 0) return;
    made.scalars.insert(made.scalars.end(), {{"energy", "met", sum.met / static_cast<double>(bake.baked.size())},
                                             {"energy", "sent", sum.sent / sum.met},
                                             {"energy", "absorbed", sum.absorbed / sum.met},
                                             {"energy", "lost", sum.lost / sum.met}});
  }

  std::shared_ptr<const BakeTask> task_;
  compute::Context context_;
  std::filesystem::path file_;
  BakeIdentity identity_;
  int width_, height_;
  double white_;
  preset::Stop stop_;
  std::optional<Baker> baker_; ///< while it bakes
  std::optional<Bake> bake_;   ///< when that is done
  bool from_file_ = false;
  std::uint64_t photons_ = 0; ///< that the finished bake took here
  double work_seconds_ = 0;
  std::shared_ptr<const job::Picture> sheet_; ///< of the directions in spheres_
  std::vector<job::NamedPicture> spheres_;    ///< of each direction that is shown and baked
  std::vector<std::string> warnings_;
};

} // namespace

std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const EnvironmentPlan& plan, const compute::Context& context)
{
  return std::make_unique<EnvironmentJob>(preset, plan, context);
}

} // namespace nephroid::environment
