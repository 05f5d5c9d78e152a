// SPDX-License-Identifier: Apache-2.0
#include "inverse/job.h"

#include "engine/engine.h"
#include "inverse/diffraction.h"
#include "inverse/report.h"
#include "inverse/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace nephroid::inverse {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

constexpr double slice_seconds = 0.025;
/// The judge's part of a run's work, for its progress only.
constexpr double judge_part = 0.1;

class InverseJob final : public job::Job {
public:
  InverseJob(const preset::Preset& preset, const InversePlan& plan, const mpi::RankContext& context)
      : context_(context), preset_(preset), layout_(plan.design->layout), targets_(plan.design->targets),
        best_(plan.design->best()), search_(preset_, layout_, targets_, plan.triangles, context) {}

  void advance() override {
    const Clock::time_point begin = Clock::now();
    while (!finished() && context_.communicator().broadcast(since(begin) < slice_seconds)) advance_stage();
    if (judgement_)
      judge_seconds_ += since(begin);
    else
      search_.add_seconds(since(begin));
  }

  bool finished() const override { return judgement_ && judgement_->finished(); }
  bool estimates_error() const override { return false; }

  job::Progress progress() const override {
    job::Progress p;
    p.step = search_.method().steps();
    p.steps = judgement_ ? p.step : search_.last_step();
    p.work = search_.method().tried();
    p.work_seconds = search_.seconds() + judge_seconds_;
    p.fraction = judgement_ ? 1 - judge_part + judge_part * judgement_->fraction_done()
                            : std::min(1.0, search_.fraction_done()) * (1 - judge_part);
    p.units = search_.method().units();
    return p;
  }

  job::Snapshot snapshot() override {
    const RunState run{preset_, layout_, targets_, best_, search_.method(), judgement_ ? &*judgement_ : nullptr};
    job::Snapshot snapshot;
    const auto receivers = add_pictures(snapshot, run);
    if (conflict_) snapshot.pictures.push_back({"conflict", conflict_});
    is_watched_ = true;
    snapshot.in_view = object_.of(run, receivers);
    snapshot.progress = progress();
    add_figures(snapshot, run, conflicts_);
    search_.show(snapshot);
    snapshot.phases = {{"slopes", search_.seconds()}, {"judge", judge_seconds_}};
    if (finished()) {
      add_files(snapshot, run);
      add_frames(snapshot, run);
      for (std::size_t j = 0; j < targets_.size(); ++j)
        if (const double cells = diffraction_cells(settings(preset_), layout_, j); cells > 1 && !layout_.diffracts)
          snapshot.warnings.push_back(
              fmt::format("picture {} is judged by rays; light is a wave, and spreads each place's over {:.3g} cells",
                          j + 1, cells));
      if (search_.has_steps_left())
        snapshot.warnings.push_back(
            fmt::format("stop.seconds ended the search after {} {}, to leave time for the judge; with more seconds the "
                        "pictures become better",
                        search_.method().units().step, search_.method().steps()));
    }
    return snapshot;
  }

  /// The stop counts from here.
  bool adopt(const preset::Preset& preset) override {
    if (!engine::adoptable(preset_, preset)) return false;
    if (settings(preset) != settings(preset_) || preset.stop != preset_.stop) {
      const Design design(preset);
      stop_judging();
      layout_ = design.layout;
      targets_ = design.targets;
      best_ = design.best();
      search_.go_on();
      find_conflicts();
      object_.clear();
    }
    preset_ = preset;
    return true;
  }

  void save(ByteSink& to) override {
    Archive saved(to);
    serialize(saved);
  }
  void load(ByteSource& from) override {
    Archive saved(from);
    serialize(saved);
    find_conflicts();
  }

private:
  /// A run that ended at its stop goes on where it is given more steps or time; what it had judged then counts no more.
  void serialize(Archive& archive) {
    search_.state_of_method(archive);
    archive.value(judge_seconds_);
    search_.state_of_count(archive);
    bool judged = judgement_.has_value();
    archive.value(judged);
    if (!judged) return;
    if (archive.is_read()) begin_judging();
    judgement_->serialize(archive);
    if (archive.is_read() && !search_.is_over()) stop_judging();
  }

  void advance_stage() {
    if (judgement_) return judgement_->advance();
    if (search_.is_over()) {
      begin_judging();
      find_conflicts();
    } else if (search_.advance() && std::exchange(is_watched_, false)) {
      find_conflicts();
    }
  }

  /// The relief's highest points come onto the sheet's face: the front is moved. Facets then are bent for the light
  /// that a lamp sends through that much glass, which moves the relief a little.
  Solid solid_in_sheet() {
    Solid solid = search_.method().solid();
    const std::optional<double> stock = settings(preset_).stock_mm;
    constexpr int most_moves = 4;
    for (int i = 0; stock && i < most_moves && std::abs(layout_.thickness - solid.lowest - *stock) > 1e-6; ++i) {
      layout_ = make_layout(preset_, *stock + solid.lowest);
      solid = search_.method().solid();
    }
    return solid;
  }

  void begin_judging() { judgement_.emplace(preset_, context_, layout_, targets_, solid_in_sheet()); }

  void stop_judging() {
    if (judgement_ && settings(preset_).stock_mm) layout_ = make_layout(preset_);
    judgement_.reset();
    conflicts_.reset();
  }

  /// Which facets' light falls where it is not wanted; which pictures fight once the slopes are found.
  void find_conflicts() {
    const Method& method = search_.method();
    std::vector<std::vector<double>> light;
    for (std::size_t j = 0; j < targets_.size(); ++j) light.push_back(method.light(j));
    const std::vector<double> heights = method.heights();
    const ConflictSearch search(layout_, targets_, method.slopes(), heights, light);
    conflict_ = grey_picture(search.facet_conflicts(), 1, layout_.facets);
    if (judgement_) conflicts_ = search.picture_conflicts();
  }

  mpi::RankContext context_;
  preset::Preset preset_;
  Layout layout_;
  std::vector<Target> targets_, best_;
  Search search_;
  std::optional<Judgement> judgement_; ///< from when the slopes are found
  double judge_seconds_ = 0;
  ObjectPicture object_;
  bool is_watched_ = false;                      ///< since the last search for conflicts
  std::shared_ptr<const job::Picture> conflict_; ///< how much each facet's pictures fight, as last looked at
  std::optional<Conflicts> conflicts_;           ///< how the pictures fight, once the slopes are found
};

} // namespace

std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const InversePlan& plan,
                                   const mpi::RankContext& context) {
  return std::make_unique<InverseJob>(preset, plan, context);
}

} // namespace nephroid::inverse
