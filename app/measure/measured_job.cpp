// SPDX-License-Identifier: Apache-2.0
#include "measure/measured_job.h"

#include "measure/error_estimate.h"
#include "measure/run_curves.h"
#include "preset/choices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::measure {
namespace {

/// A history in a checkpoint, before the job's own bytes, so that a resumed run goes on with one history. How it lies
/// there is part of the checkpoint's format (run/checkpoint.cpp). `from` is what is read; null where the history is
/// written. Throws bad_input where the checkpoint is cut.
void history_state(Archive archive, const ByteSource* from, job::History& history, double& wall_seconds) {
  // Items of at least so many bytes each, which the rest of the checkpoint must hold: no wrong count takes all memory.
  const auto sized = [&](auto& items, std::size_t bytes_each) {
    std::uint64_t count = items.size();
    archive.value(count);
    if (from && count > from->left() / bytes_each)
      throw bad_input("checkpoint", "is cut", "", "delete it and start again");
    items.resize(static_cast<std::size_t>(count));
  };
  archive.value(wall_seconds);
  archive.value(history.measuring_seconds);
  sized(history.columns, sizeof(std::uint64_t));
  for (std::string& column : history.columns) {
    sized(column, 1);
    archive.items(std::span(column));
  }
  sized(history.rows, (4 + history.columns.size()) * sizeof(double));
  for (job::HistoryRow& row : history.rows) {
    archive.value(row.seconds);
    archive.value(row.wall_seconds);
    archive.value(row.step);
    archive.value(row.work);
    row.errors.resize(history.columns.size());
    archive.items(row.errors);
  }
}

/// The rows with other columns, NaN where there is no value: a resumed run may have got a reference.
std::vector<job::HistoryRow> rows_in_columns(const job::History& history, const std::vector<std::string>& columns) {
  std::vector<job::HistoryRow> rows = history.rows;
  for (job::HistoryRow& row : rows) {
    std::vector<double> errors;
    for (const std::string& column : columns) errors.push_back(job::error_in(history, row, column));
    row.errors = std::move(errors);
  }
  return rows;
}

using Clock = std::chrono::steady_clock;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Measurements are this factor of time apart: twelve and a half a decade, enough to see a slope.
constexpr double spacing = 1.2;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// The metrics of which a run has columns: those that it estimates, or those against a reference.
std::vector<const Metric*> noted_metrics(bool are_estimates, bool perceptual) {
  std::vector<const Metric*> metrics;
  for (const Metric& metric : all_metrics())
    if (are_estimates ? metric.kind == Metric::Kind::estimated : perceptual || metric.kind != Metric::Kind::perceptual)
      metrics.push_back(&metric);
  return metrics;
}

std::string names_of_estimates() {
  std::vector<std::string_view> names;
  for (const Metric* metric : noted_metrics(true, false)) names.push_back(metric->name);
  return fmt::format("{}", fmt::join(names, ", "));
}

class MeasuredJob final : public job::Job, public job::SpectrumSource {
public:
  MeasuredJob(std::unique_ptr<job::Job> job, const preset::Preset& preset, std::shared_ptr<const Reference> reference,
              Clock::time_point began, std::vector<double> times)
      : job_(std::move(job)), settings_(preset.measure), reference_(std::move(reference)), times_(std::move(times)),
        began_(began) {
    if (!job_->estimates_error()) settings_.estimate = false;
    if (reference_) {
      against_.emplace(reference_->pixels());
      if (!reference_->mask.empty()) masked_.emplace(reference_->pixels(), reference_->mask);
    }
    const std::string metric(preset::word(preset.stop.metric));
    is_mean_square_ = metric_text(metric).is_mean_square();
    history_.target = preset.stop.error;
    name_columns();
    for (const std::string& column : {metric, "estimated_" + metric, std::string("estimated_lab_mean")})
      if (history_.error_column.empty() && std::count(history_.columns.begin(), history_.columns.end(), column) > 0)
        history_.error_column = column;
    if (history_.target && !history_.error_column.ends_with(metric))
      throw bad_input(Location(preset.source) / "stop" / "error", "nothing measures the error of this run in " + metric,
                      settings_.estimate
                          ? "expected a 'reference', or a 'stop.metric' that can be estimated: " + names_of_estimates()
                          : "expected a 'reference', or 'measure.estimate' true");
    show();
  }

  bool estimates_error() const override { return job_->estimates_error(); }
  void begin_with(const job::Beginning& beginning) override { job_->begin_with(beginning); }
  bool finished() const override { return target_reached() || (job_->finished() && !is_due()); }

  void advance() override {
    if (unnoted_)
      note(*std::exchange(unnoted_, std::nullopt));
    else if (is_due())
      measure();
    else
      job_->advance();
  }

  job::Progress progress() const override {
    job::Progress progress = job_->progress();
    if (finished())
      progress.fraction = 1;
    else if (const std::optional<double> at = target_seconds())
      progress.fraction = std::max(progress.fraction, std::min(progress.work_seconds / *at, 0.999));
    return progress;
  }

  job::Snapshot snapshot() override {
    job::Snapshot snapshot = job_->snapshot();
    if (may_note(snapshot.progress)) {
      const bool is_asked_for = !times_.empty() && times_.front() <= snapshot.progress.work_seconds;
      if (history_.rows.empty() && !is_asked_for)
        unnoted_ = snapshot;
      else
        note(snapshot);
    }
    snapshot.progress = progress();
    snapshot.history = history();
    return snapshot;
  }

  std::shared_ptr<const job::History> history() const override { return shown_; }

  std::shared_ptr<const job::PixelSpectrum> spectrum(const std::array<int, 2>& pixel) override {
    auto* source = dynamic_cast<job::SpectrumSource*>(job_.get());
    return source ? source->spectrum(pixel) : nullptr;
  }

  void save(ByteSink& to) override {
    double wall = wall_seconds();
    history_state(Archive(to), nullptr, history_, wall);
    job_->save(to);
  }

  /// The history starts anew: its rows are of the old light's picture, and so is the reference. Where stop.error hangs
  /// on the reference, the run has to start again to get another one.
  bool adopt(const preset::Preset& preset) override {
    const bool stops_by_reference = history_.target && !history_.error_column.starts_with("estimated_");
    if (stops_by_reference || !job_->adopt(preset)) return false;
    if (reference_) {
      reference_.reset();
      against_.reset();
      masked_.reset();
      history_.columns.clear();
      history_.noise_floor.clear();
      name_columns();
      if (!history_.error_column.starts_with("estimated_"))
        history_.error_column = history_.columns.empty() ? "" : "estimated_lab_mean";
    }
    history_.rows.clear();
    unnoted_.reset();
    history_.measuring_seconds = 0;
    measurements_ = 0;
    if (job_->progress().work_seconds == 0) began_ = Clock::now(), wall_before_ = 0; // it begins anew
    next_ = wanted_ = 0;
    last_seconds_ = 0;
    shown_.reset();
    show();
    return true;
  }

  void load(ByteSource& from) override {
    job::History saved;
    history_state(Archive(from), &from, saved, wall_before_);
    job_->load(from);
    began_ = Clock::now();
    history_.measuring_seconds = saved.measuring_seconds;
    history_.rows = rows_in_columns(saved, history_.columns);
    measurements_ = history_.rows.size();
    for (const job::HistoryRow& row : history_.rows) last_seconds_ = row.seconds;
    plan_next();
    show();
  }

private:
  void name_columns() {
    const auto add = [&](const char* prefix, const std::optional<Metrics>& floor, bool are_estimates) {
      for (const Metric* metric : noted_metrics(are_estimates, settings_.perceptual)) {
        history_.columns.push_back(fmt::format("{}{}", prefix, metric->name));
        history_.noise_floor.push_back(floor ? metric->of(*floor) : none);
      }
    };
    if (against_) add("", reference_->noise_floor, false);
    if (masked_) add("masked_", reference_->masked_noise_floor, false);
    if (settings_.estimate) add("estimated_", {}, true);
  }

  double wall_seconds() const { return wall_before_ + seconds_since(began_); }

  /// The first whole picture is the first that is worth a row; the end is always one.
  bool is_due() const {
    if (history_.columns.empty()) return false;
    const job::Progress progress = job_->progress();
    if (job_->finished()) return progress.work_seconds > last_seconds_;
    return progress.whole && progress.work_seconds > last_seconds_ && progress.work_seconds >= next_;
  }

  double share() const { return history_.target ? measuring_share_to_stop : measuring_share; }

  void measure() {
    const auto begin = Clock::now();
    const job::Snapshot snapshot = job_->snapshot();
    history_.measuring_seconds += seconds_since(begin);
    note(snapshot);
  }

  /// Whether a picture that somebody else asked for shall have a row: that costs little.
  bool may_note(const job::Progress& progress) const {
    return !history_.columns.empty() && progress.whole && progress.work_seconds > last_seconds_ &&
           progress.work_seconds >= wanted_ &&
           progress.work_seconds >= (history_.measuring_seconds + noting_seconds_) / share();
  }

  void note(const job::Snapshot& snapshot) {
    const auto begin = Clock::now();
    const job::Progress& progress = snapshot.progress;
    const bool tells = !snapshot.stands_in && (reference_ || !snapshot.picture->error_draw.empty());
    ++measurements_;
    last_seconds_ = progress.work_seconds;
    if (!tells) return plan_next(); // there is no picture of what was asked for yet, or nothing is known of its error
    job::HistoryRow row{progress.work_seconds, 0, progress.step, progress.work, errors_of(*snapshot.picture)};
    row.wall_seconds = wall_seconds();
    history_.rows.push_back(std::move(row));
    noting_seconds_ = seconds_since(begin);
    history_.measuring_seconds += noting_seconds_;
    plan_next();
    show();
  }

  /// What others see: a copy that is made when there is a new row, not at every step that asks.
  void show() {
    if (!history_.columns.empty()) shown_ = std::make_shared<const job::History>(history_);
  }

  /// One a column, in their order.
  std::vector<double> errors_of(const job::Picture& picture) const {
    const Pixels pixels{picture.width, picture.height, picture.rgb, "the run"};
    std::vector<double> errors;
    const auto add = [&](const std::optional<Metrics>& metrics, bool are_estimates) {
      for (const Metric* metric : noted_metrics(are_estimates, settings_.perceptual))
        errors.push_back(metrics ? metric->of(*metrics) : none);
    };
    if (against_) add(metrics_against(pixels, {}, *against_), false);
    if (masked_) add(metrics_against(pixels, reference_->mask, *masked_), false);
    if (settings_.estimate)
      add(picture.error_draw.empty() ? std::nullopt : std::optional(estimate_error(picture)), true);
    return errors;
  }

  Metrics metrics_against(const Pixels& pixels, Mask mask, const QuickComparison& quick) const {
    return settings_.perceptual ? compare(pixels, reference_->pixels(), mask) : quick.against(pixels);
  }

  /// The newest value of the error column; NaN before the first row.
  double error() const {
    if (history_.rows.empty()) return none;
    return job::error_in(history_, history_.rows.back(), history_.error_column);
  }

  bool target_reached() const { return history_.target && error() <= *history_.target; }

  /// The work after which the target should be reached: errors fall as 1 / sqrt(work), those of squares as 1 / work.
  std::optional<double> target_seconds() const {
    const double now = error();
    if (!history_.target || !(now > 0)) return std::nullopt;
    const double ratio = now / *history_.target;
    return last_seconds_ * (is_mean_square_ ? ratio : ratio * ratio);
  }

  void plan_next() {
    const double mean_cost = history_.measuring_seconds / static_cast<double>(std::max<std::size_t>(measurements_, 1));
    const double affordable = (history_.measuring_seconds + mean_cost) / share();
    wanted_ = last_seconds_ * spacing;
    if (const std::optional<double> at = target_seconds()) wanted_ = std::min(wanted_, *at);
    next_ = std::max(wanted_, affordable);
    if (const auto time = std::upper_bound(times_.begin(), times_.end(), last_seconds_); time != times_.end())
      next_ = std::min(next_, *time);
  }

  std::unique_ptr<job::Job> job_;
  preset::Measure settings_;
  std::shared_ptr<const Reference> reference_;
  std::optional<QuickComparison> against_, masked_;
  bool is_mean_square_ = false; ///< the error that may stop the run
  job::History history_;
  std::shared_ptr<const job::History> shown_;
  std::optional<job::Snapshot> unnoted_; ///< the first whole picture, which somebody waits for: noted in the next step
  std::vector<double> times_;            ///< to measure at whatever it takes
  Clock::time_point began_;
  double wall_before_ = 0;       ///< a resumed run's earlier parts
  std::size_t measurements_ = 0; ///< with those that told nothing, and have no row
  double last_seconds_ = 0;      ///< work at the newest measurement
  double next_ = 0;              ///< work when the next row is due
  double wanted_ = 0;            ///< when it would be if measuring took no time
  double noting_seconds_ = 0;    ///< what the newest row took, without the picture that it is of
};

} // namespace

std::unique_ptr<job::Job> measured(std::unique_ptr<job::Job> job, const preset::Preset& preset,
                                   std::shared_ptr<const Reference> reference,
                                   std::chrono::steady_clock::time_point began, std::vector<double> times) {
  return std::make_unique<MeasuredJob>(std::move(job), preset, std::move(reference), began, std::move(times));
}

} // namespace nephroid::measure
